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

/// The part of a line around a column, to shorten long lists of values.
std::string excerpt(std::string_view line, std::size_t column)
{
    constexpr std::size_t before = 40;
    constexpr std::size_t length = 80;
    const std::size_t begin = line.size() <= length || column < before ? 0 : column - before;
    const std::string_view shown = line.substr(std::min(begin, line.size()), length);
    return fmt::format("{}{}{}", begin > 0 ? "..." : "", shown,
                       begin + shown.size() < line.size() ? "..." : "");
}

/// Removes the first line from a text and returns it.
std::string_view next_line(std::string_view& text)
{
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    return line;
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
    for (int number = 1;; ++number) {
        const bool ends = stored.empty() || given.empty();
        const std::string_view theirs = stored.empty() ? "(nothing more)" : next_line(stored);
        const std::string_view ours = given.empty() ? "(nothing more)" : next_line(given);
        if (const auto record = record_named_in(ours);
            theirs != ours && !record.empty() && record == record_named_in(theirs)) {
            return fmt::format("the record {} has changed since then, or is read with other keys "
                               "(component, vertical, time_step, units, gravity). ",
                               record);
        }
        if (ends || theirs != ours) {
            const auto differ =
                std::mismatch(theirs.begin(), theirs.end(), ours.begin(), ours.end());
            const auto column = std::size_t(differ.first - theirs.begin());
            return fmt::format(
                "line {} of its resolved job is\n  {}\nbut in this job it is\n  {}\n", number,
                excerpt(theirs, column), excerpt(ours, column));
        }
    }
}

} // namespace

void StoredResult::expect_result_of(const Job& job) const
{
    const auto refuse = [&](const std::string& what) {
        throw Error(exit_code::output, "\"{}\" {}", path(), what);
    };
    const Problem& problem = job.problem;
    if (origin().kind != FileKind(problem.product)) {
        refuse(fmt::format("is {} {}, but the job computes an {}. Choose another name with -o.",
                           origin().kind == FileKind::history ? "a" : "an",
                           layout::name_of(origin().kind),
                           layout::name_of(FileKind(problem.product))));
    }
    if (origin().format != layout::newest_format) {
        refuse(fmt::format("has the format of an earlier version ({}), which can be read but not "
                           "resumed. Choose another name with -o.",
                           origin().format));
    }
    if (origin().resolved_job != job.resolved) {
        refuse(fmt::format("belongs to another job: {}Choose another name with -o.",
                           first_difference(origin().resolved_job, job.resolved)));
    }
    if (origin().program_version != program_version() ||
        origin().program_commit != program_commit()) {
        refuse(
            fmt::format("was computed by overturn {} (commit {}), but this is overturn {} (commit "
                        "{}), whose results may differ in the last digits. Choose another name "
                        "with -o, or use that version.",
                        origin().program_version, origin().program_commit, program_version(),
                        program_commit()));
    }
    const Tiling tiling = tiling_of(problem);
    std::vector<std::string> names;
    for (const AxisSummary& axis : tiles().axes) {
        names.push_back(axis.name);
    }
    if (tiles().tile_shape != tiling.tile_shape() || tiles().tiles != tiling.size() ||
        tiles().fields != problem.fields ||
        !std::ranges::equal(names, stored_dimensions(problem), {}, {}, &StoredDimension::name)) {
        refuse("is damaged: its fields or tiles do not match its job. Remove it, or choose another "
               "name with -o.");
    }
    if (const auto damaged = damaged_coordinates(); !damaged.empty()) {
        refuse(fmt::format("is damaged: the values of its coordinates have changed: {}. Remove it, "
                           "or choose another name with -o.",
                           fmt::join(damaged, ", ")));
    }
}

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
    stored->expect_result_of(job);
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
