#include "overturn/file/stored_result.hpp"

#include "job_difference.hpp"
#include "layout.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/mapped.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

namespace overturn {

namespace {

/// Throws Error unless the file is the result of this job, or of this part of it, by this version
/// of the program.
void expect_result_of(const Job& job, const std::optional<JobPart>& part,
                      const StoredResult& stored)
{
    const auto refuse = [&](const std::string& what) {
        throw Error(exit_code::output, "\"{}\" {}", stored.path(), what);
    };
    const Problem& problem = job.problem;
    const FileOrigin& origin = stored.origin();
    if (origin.kind != kind_of(problem.product)) {
        refuse(fmt::format("is {} {}, but the job computes an {}. Choose another name with -o.",
                           origin.kind == FileKind::history ? "a" : "an", name_of(origin.kind),
                           name_of(kind_of(problem.product))));
    }
    if (origin.resolved_job != job.resolved) {
        refuse("belongs to another job: " + first_difference(origin.resolved_job, job.resolved));
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
    if (tiles.part != part) {
        const auto words = [](const std::optional<JobPart>& of_job) {
            return of_job ? words_of(*of_job) : "the whole";
        };
        refuse(fmt::format("is {} of this job, but {} is to be computed. Choose another name with "
                           "-o.",
                           words(tiles.part), words(part)));
    }
    if (tiles.tile_shape != tiling.tile_shape() || tiles.tiles_of_job != tiling.size() ||
        tiles.fields != problem.fields ||
        mapped(tiles.fields, &Field::precision) != mapped(problem.fields, &Field::precision) ||
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

std::optional<StoredResult> existing_result(const std::string& path, const Job& job,
                                            const std::optional<JobPart>& part)
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
    if (stored->origin().format != layout::format) {
        throw Error(
            exit_code::output,
            "\"{}\" was written by an older program, and is not continued by this one. Choose "
            "another name with -o.",
            path);
    }
    expect_result_of(job, part, *stored);
    return stored;
}

} // namespace overturn
