// The steps of read_job: apply the --set arguments, then read table by table.
#pragma once

#include "overturn/job/job.hpp"
#include "overturn/job/schema.hpp"
#include "overturn/problem/given.hpp"
#include "toml_reading.hpp"

namespace overturn {

/// Overrides a key of the job by `key.path=value` (TOML; a bare word is a string). Keys that it
/// contradicts are dropped: `values` or first/last/count of the same axis, other quantities that
/// cannot be combined with this one, tables of blocks, the numbers that the new pulse does not
/// have, and the keys of a record or of a pulse. Throws Error if it is invalid.
void apply_override(toml::table& job, const std::string& argument);

/// Reads [scene], without its records.
Scene read_scene(const Entry& job);

/// The recorded motions of a job.
struct RecordedMotions {
    std::vector<Motion> motions;
    std::vector<std::shared_ptr<const Accelerogram>> records; ///< in the same order
    bool is_suite = false; ///< a list or a pattern of files: a dimension even if it has one motion
};

/// Reads scene.record and the keys that belong to it. folder: of the job file; gravity [m/s2].
RecordedMotions read_motions(const Entry& scene, const std::string& folder, double gravity);

/// Reads [numerics].
Numerics read_numerics(const Entry& job, bool is_recorded);

/// Reads [output].
std::vector<Field> read_fields(const Entry& job);

/// Throws Error if the job needs error bounds, but its tolerance is too loose for them.
void expect_known_errors(const Entry& job, const Problem& problem);

/// Refuses forces of the contact in the linear theory.
void expect_contact(const Entry& job, const Problem& problem);

/// Throws Error if the job asks for filling but cannot be filled.
void expect_fillable(const Entry& entry, const Problem& problem);

/// Reads the table of the blocks of a job. file: relative to the folder. Under records, the column
/// `motion` contains their names, or those of their files; in the result, their numbers, from 1.
/// Throws Error.
BlockTable read_block_table(const std::string& file, const std::string& folder,
                            const std::vector<Motion>& motions);

/// The columns that describe points.
std::vector<Given> columns_of(const BlockTable& blocks, bool is_recorded);

/// Throws Error with the file, and with line and column only if known.
[[noreturn]] void refuse(const BlockTable& blocks, const GivenError& error);

/// Reads [plane], [block] and [blocks] with the table that it names. folder: of the job file. The
/// scene and the motions of the job must have been read.
void read_points(const Entry& entry, const std::string& folder, bool is_suite, Job& job);

/// The canonical text of a job: in fixed order, with all defaults.
std::string resolved_text(const Job& job);

/// Reads a number, which gives an axis of one value, or an axis: a table with these keys only,
/// { values = [...] } or { first, last, count, spacing }.
Axis read_axis(const Entry& entry, const Quantity& rule, Names keys = axis_keys());

} // namespace overturn
