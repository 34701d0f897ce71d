// Whether an existing file is the result of a job.
#include "hdf5_handles.hpp"
#include "layout.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/file/spectrum_file.hpp"
#include "overturn/file/stored_result.hpp"
#include "overturn/job/job.hpp"
#include "overturn/text/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace overturn {

namespace {

/// The line of a text that begins at `begin`; of a long one, the part around `place`.
std::string line_around(std::string_view text, std::size_t begin, std::size_t place)
{
    constexpr std::size_t before = 40;
    constexpr std::size_t length = 80;
    if (begin == text.size()) {
        return "(nothing more)";
    }
    const std::string_view line = text.substr(begin, text.find('\n', begin) - begin);
    const std::size_t hidden = line.size() <= length ? 0 : std::max(place - begin, before) - before;
    const std::string_view shown = line.substr(hidden, length);
    return fmt::format("{}{}{}", hidden > 0 ? "..." : "", shown,
                       hidden + shown.size() < line.size() ? "..." : "");
}

/// The part of a line of a resolved job that names the file of a record; empty for other lines.
std::string_view record_named_in(std::string_view line)
{
    constexpr std::string_view before = "{ file = ";
    const std::size_t begin = line.find(before);
    const std::size_t end = line.find(", component = ");
    return begin < end && end != line.npos
               ? line.substr(begin + before.size(), end - begin - before.size())
               : std::string_view();
}

/// Describes the first line in which two different texts differ.
std::string first_difference(std::string_view stored, std::string_view given)
{
    const auto differ = std::ranges::mismatch(stored, given);
    const auto place = std::size_t(differ.in1 - stored.begin());
    const std::string_view same = given.substr(0, place);
    const std::size_t begin = same.rfind('\n') + 1; // 0 if there is none
    const auto line_of = [&](std::string_view text) {
        return text.substr(begin, text.find('\n', begin) - begin);
    };
    const std::string_view record = record_named_in(line_of(given));
    if (!record.empty() && record == record_named_in(line_of(stored))) {
        return fmt::format("the record {} has changed since then, or is read with other keys "
                           "(component, second_component, vertical, time_step, units, gravity). ",
                           record);
    }
    return fmt::format("line {} of its resolved job is\n  {}\nbut in this job it is\n  {}\n",
                       1 + std::ranges::count(same, '\n'), line_around(stored, begin, place),
                       line_around(given, begin, place));
}

/// Throws Error unless the file is the result of this job, by this version of the program.
void expect_result_of(const Job& job, const StoredResult& stored)
{
    const auto refuse = [&](const std::string& what) {
        throw Error(exit_code::output, "\"{}\" {}", stored.path(), what);
    };
    const Problem& problem = job.problem;
    const FileOrigin& origin = stored.origin();
    if (origin.kind != FileKind(problem.product)) {
        refuse(fmt::format("is {} {}, but the job computes an {}. Choose another name with -o.",
                           origin.kind == FileKind::history ? "a" : "an",
                           layout::name_of(origin.kind),
                           layout::name_of(FileKind(problem.product))));
    }
    if (origin.format != layout::newest_format) {
        refuse(fmt::format("has the format of an earlier version ({}), which can be read but not "
                           "resumed. Choose another name with -o.",
                           origin.format));
    }
    if (origin.resolved_job != job.resolved) {
        refuse(fmt::format("belongs to another job: {}Choose another name with -o.",
                           first_difference(origin.resolved_job, job.resolved)));
    }
    if (origin.program_version != program_version() || origin.program_commit != program_commit()) {
        refuse(fmt::format(
            "was computed by overturn {} (commit {}), but this is overturn {} (commit "
            "{}), whose results may differ in the last digits. Choose another name "
            "with -o, or use that version.",
            origin.program_version, origin.program_commit, program_version(), program_commit()));
    }
    const Tiling tiling = tiling_of(problem);
    const TilesSummary& tiles = stored.tiles();
    if (tiles.tile_shape != tiling.tile_shape() || tiles.tiles != tiling.size() ||
        tiles.fields != problem.fields ||
        !std::ranges::equal(tiles.axes, stored_dimensions(problem), {}, &AxisSummary::name,
                            &StoredDimension::name)) {
        refuse("is damaged: its fields or tiles do not match its job. Remove it, or choose another "
               "name with -o.");
    }
    if (const auto damaged = stored.damaged_coordinates(); !damaged.empty()) {
        refuse(fmt::format("is damaged: the values of its coordinates have changed: {}. Remove it, "
                           "or choose another name with -o.",
                           fmt::join(damaged, ", ")));
    }
}

} // namespace

std::optional<StoredResult> existing_result(const std::string& path, const Job& job)
{
    std::error_code reason;
    if (std::filesystem::status(path, reason).type() == std::filesystem::file_type::not_found) {
        return std::nullopt;
    }
    std::optional<StoredResult> stored;
    try {
        stored.emplace(path);
    } catch (const Error& error) {
        throw Error(exit_code::output, "{} Choose another name with -o.", error.what());
    }
    expect_result_of(job, *stored);
    return stored;
}

void clear_open_mark(const std::string& path)
{
    constexpr std::streamoff place = 20; // in a superblock of version 0
    std::ifstream file(path, std::ios::binary);
    file.seekg(place);
    if (file.get() != 0) {
        const hid_t opened = H5Fopen(path.c_str(), H5F_ACC_RDWR, hdf5::file_access());
        if (opened >= 0) {
            H5Fclose(opened);
        }
    }
}

} // namespace overturn
