#include "commands.hpp"
#include "guarded_reading.hpp"
#include "report/json_outputs.hpp"
#include "report/print.hpp"
#include "report/result_remarks.hpp"
#include "report/sidecar.hpp"

#include "overturn/file/stored_result.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/quoting.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace overturn {

namespace {

/// In the order of FileKind.
constexpr std::array<const char*, 4> contents{"a spectrum", "a boundary",
                                              "the history of one block", "an accuracy study"};

void print_origin(const std::string& path, const FileOrigin& origin)
{
    if (!origin.title.empty()) {
        fmt::print("{}\n\n", printable(origin.title));
    }
    print_row("file", fmt::format("{}, {}", path, human_bytes(double(origin.bytes))));
    print_row("contains", contents[std::size_t(origin.kind)]);
    print_motion_of("motion", origin.motion_of);
    print_row("made by", printable(fmt::format("overturn {} (commit {})", origin.program_version,
                                               origin.program_commit)));
}

/// The extents of a tile, without those of the slowest dimensions along which it is 1.
std::string tile_text(const Shape& shape)
{
    const auto first = std::ranges::find_if(shape, [](std::int64_t size) { return size > 1; });
    return first == shape.end() ? "1" : fmt::format("{}", fmt::join(first, shape.end(), " x "));
}

/// Of a file that lacks tiles.
std::string progress_line(const FileProgress& file, const std::optional<LastRun>& run)
{
    if (file.state == RunState::stopped) {
        return "no run writes this file";
    }
    if (file.state == RunState::unknown) {
        return "unknown whether a run writes this file: " +
               (run ? fmt::format("the last report of a run is {} old", human_duration(run->age))
                    : "there is no report of a run");
    }
    return fmt::format("a run on {} {} writes this file: {}", run->ranks,
                       noun_of(run->ranks, "ranks"), progress_text(file.progress));
}

/// Of a spectrum or a boundary.
void print_axes_and_tiles(const StoredResult& stored)
{
    const TilesSummary& tiles = stored.tiles();
    for (const auto& axes : {tiles.axes, tiles.numbers}) {
        for (const AxisSummary& axis : axes) {
            print_axis(axis.name, axis.size, axis.first, axis.last,
                       axis.units == "1" ? "" : fmt::format(" {}", printable(axis.units)));
        }
    }
    if (const auto damaged = stored.damaged_coordinates(); !damaged.empty()) {
        print_row("damaged",
                  fmt::format("the values of {} have changed", fmt::join(damaged, ", ")));
    }
    for (const Field field : tiles.fields) {
        const bool is_single = field.precision == Precision::single_precision;
        print_row("field", fmt::format("{}, {}", name_of(field),
                                       is_single ? "float32" : name_of(traits_of(field).type)));
    }
    const bool is_boundary = stored.origin().kind == FileKind::boundary;
    const std::string tile = tile_text(tiles.tile_shape);
    print_row("tiles", fmt::format("{} of {} done, {} {} each", tiles.tiles_done, tiles.tiles, tile,
                                   noun_of(tile == "1" ? 1 : 2, is_boundary ? "flips" : "points")));
    for (const std::string& remark : remarks_on(stored)) {
        print_row(is_boundary ? "lines" : "audit", remark);
    }
    if (tiles.part) {
        print_row("part",
                  fmt::format("{} of {}, with {} of the {} tiles of the job", tiles.part->number,
                              tiles.part->count, tiles.tiles, tiles.tiles_of_job));
    }
    if (tiles.tiles_done < tiles.tiles) {
        const auto run = last_run_of(stored.path());
        const FileProgress progress = progress_of(stored, run);
        print_row("progress", progress_line(progress, run));
        const bool is_running = progress.state == RunState::running;
        print_row("unfinished",
                  (is_running ? "If that run ends early, resume with " : "Resume with ") +
                      command_to_complete(stored));
    } else if (tiles.part) {
        print_row("unfinished", "Join all parts with overturn merge");
    }
}

/// Throws Error if a run has not yet created the file.
void expect_created(const std::string& path)
{
    std::error_code none;
    const std::string part = path + ".part";
    if (!std::filesystem::exists(path, none) && std::filesystem::exists(part, none)) {
        throw Error(exit_code::output,
                    "\"{}\" does not exist yet: a run is creating \"{}\" ({} so far), or was "
                    "killed meanwhile. It computes nothing before.",
                    path, part, human_bytes(double(std::filesystem::file_size(part, none))));
    }
}

} // namespace

int info(const InfoOptions& options)
{
    expect_created(options.path);
    const GuardedReading guarded(options.path);
    const StoredResult stored(options.path);
    if (options.json) {
        fmt::print("{}", json_of(stored, last_run_of(options.path)));
        return exit_code::complete;
    }
    print_origin(options.path, stored.origin());
    if (stored.origin().has_tiles()) {
        print_axes_and_tiles(stored);
    }
    fmt::print("\nThe job with all defaults:\n\n{}", printable(stored.origin().resolved_job));
    return exit_code::complete;
}

} // namespace overturn
