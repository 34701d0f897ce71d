// Whether the file at the output path belongs to the job.

#include "hdf5_handles.hpp"
#include "layout.hpp"
#include "stored_spectrum.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/file/spectrum_file.hpp"

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
    constexpr std::string_view before = "    { file = ";
    const std::size_t end = line.find(", component = ");
    return line.starts_with(before) && end != line.npos
               ? line.substr(before.size(), end - before.size())
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

/// Adds what to do to the message if the file cannot be opened.
StoredSpectrum open_or_refuse(const std::string& path)
{
    try {
        return open_stored_spectrum(path);
    } catch (const FileError& error) {
        throw FileError(fmt::format("{} Choose another name with -o.", error.what()));
    }
}

} // namespace

Existing examine(const std::string& path, const Job& job, const Tiling& tiling)
{
    std::error_code reason;
    if (std::filesystem::status(path, reason).type() == std::filesystem::file_type::not_found) {
        return Existing::nothing;
    }
    const StoredSpectrum stored = open_or_refuse(path);
    if (stored.product != job.product) {
        throw FileError(fmt::format(
            "\"{}\" is an {}, but the job computes an {}. Choose another name "
            "with -o.",
            path, layout::name_of(stored.kind), layout::name_of(FileKind(job.product))));
    }
    if (stored.resolved_job != job.resolved) {
        throw FileError(fmt::format("\"{}\" belongs to another job: {}Choose another name with -o.",
                                    path, first_difference(stored.resolved_job, job.resolved)));
    }
    if (stored.format != layout::newest_format) {
        throw FileError(
            fmt::format("\"{}\" has the format of an earlier version ({}), which can be "
                        "read but not resumed. Choose another name with -o.",
                        path, stored.format));
    }
    if (stored.program_version != program_version() || stored.program_commit != program_commit()) {
        throw FileError(fmt::format(
            "\"{}\" was computed by overturn {} (commit {}), but this is overturn {} (commit {}), "
            "whose results may differ in the last digits. Choose another name with -o, or use "
            "that version.",
            path, stored.program_version, stored.program_commit, program_version(),
            program_commit()));
    }
    if (stored.tile_shape != tiling.tile_shape() || stored.tiles != tiling.size() ||
        !std::ranges::equal(stored.fields, job.fields, {}, &FieldSummary::field)) {
        throw FileError(fmt::format("\"{}\" is damaged: its fields or tiles do not match its job. "
                                    "Remove it, or choose another name with -o.",
                                    path));
    }
    if (const auto foreign = foreign_coordinates(stored, job); !foreign.empty()) {
        throw FileError(fmt::format(
            "\"{}\" is damaged: its coordinates do not match its job: {}. Remove it, or "
            "choose another name with -o.",
            path, fmt::join(foreign, ", ")));
    }
    return stored.tiles_done < stored.tiles ? Existing::unfinished : Existing::complete;
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
