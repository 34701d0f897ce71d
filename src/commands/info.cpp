// Prints a summary of a result file, and how to resume it if it is unfinished.
#include "audit_text.hpp"
#include "child_process.hpp"
#include "commands.hpp"
#include "human_units.hpp"
#include "output_lines.hpp"
#include "printable.hpp"

#include "overturn/file/spectrum_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

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
    print_row("made by", printable(fmt::format("overturn {} (commit {})", origin.program_version,
                                               origin.program_commit)));
}

/// The shape of a tile, without leading dimensions of size 1; the last two are always shown.
std::string tile_text(const Shape& shape)
{
    auto begin = shape.begin();
    while (shape.end() - begin > 2 && *begin == 1) {
        ++begin;
    }
    return fmt::format("{}", fmt::join(begin, shape.end(), " x "));
}

/// Of a spectrum or a boundary.
void print_plane_and_tiles(const std::string& path)
{
    const SpectrumSummary summary = summarize(path);
    const std::vector<std::string> damaged = damaged_coordinates(path);
    print_origin(path, summary);
    for (const AxisSummary& axis : summary.axes) {
        print_axis(axis.name, axis.size, axis.first, axis.last,
                   axis.units == "1" ? "" : fmt::format(" {}", printable(axis.units)));
    }
    if (!damaged.empty()) {
        print_row("damaged", fmt::format("{}: mismatch with the job", fmt::join(damaged, ", ")));
    }
    for (const FieldSummary& field : summary.fields) {
        print_row("field", fmt::format("{}, {}", field.name, field.type));
    }
    const bool is_boundary = summary.product == Product::boundary;
    print_row("tiles",
              fmt::format("{} of {} done, {} {} each", summary.tiles_done, summary.tiles,
                          tile_text(summary.tile_shape), is_boundary ? "flips" : "points"));
    if (const std::string lines = is_boundary ? lines_text(count_lines(path)) : "";
        !lines.empty()) {
        print_row("lines", lines);
    }
    if (summary.audit) {
        print_row("audit", audit_text(*summary.audit));
    }
    if (summary.tiles_done < summary.tiles) {
        print_row("unfinished", fmt::format("Resume with overturn {} JOB.toml -o {}, with the "
                                            "job file and the --set arguments of the first run",
                                            is_boundary ? "boundary" : "run", path));
    }
}

void print_summary(const std::string& path)
{
    const FileOrigin origin = origin_of(path);
    if (origin.kind == FileKind::spectrum || origin.kind == FileKind::boundary) {
        print_plane_and_tiles(path);
    } else {
        print_origin(path, origin);
    }
    fmt::print("\nThe job with all defaults:\n\n{}", printable(origin.resolved_job));
}

} // namespace

int info(const std::string& path)
{
    return run_in_child(path, [&] { print_summary(path); });
}

} // namespace overturn
