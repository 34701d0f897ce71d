// The steps of read_job: apply the --set arguments, then read table by table.
#pragma once

#include "job_keys.hpp"
#include "overturn/job/job.hpp"
#include "overturn/sweep/quantity.hpp"
#include "toml_reading.hpp"

namespace overturn {

/// Overrides a key of the job by `key.path=value` (TOML; a bare word is a string). Keys that it
/// contradicts are dropped: `values` or first/last/count of the same axis, other keys that give the
/// same quantity, [block], [blocks] and the axes that they replace, the numbers that the new pulse
/// does not have, and the keys of a record or of a pulse.
/// Throws JobError if it is invalid.
void apply_override(toml::table& job, const std::string& argument);

/// Reads [scene], without its records.
Scene read_scene(const Entry& job);

/// A job as given, or as resolved and stored in a result file, which describes its records.
enum class JobText { given, resolved };

/// Reads scene.record and the keys that belong to it. folder: of the job file; gravity [m/s2].
std::vector<Motion> read_motions(const Entry& scene, const std::string& folder, double gravity,
                                 JobText kind);

Numerics read_numerics(const Entry& job, bool is_recorded);

/// Reads [output].
std::vector<Field> read_fields(const Entry& job);

/// Throws JobError if the job needs error bounds, but its tolerance is too loose for them.
void expect_known_errors(const Entry& job, const Numerics& numerics,
                         const std::vector<Field>& fields);

/// Throws JobError if the job asks for filling but cannot be filled.
void expect_fillable(const Entry& entry, const Job& job);

/// Reads [blocks] and the table that it names. folder: of the job file. Sets plane.list; the scene,
/// the motions and plane.motions of the job must have been read.
BlockTable read_blocks(const Entry& blocks, const std::string& folder, Job& job, JobText kind);

/// Reads [plane] and [block]. plane: motions and list must be set.
void read_plane(const Entry& job, Plane& plane);

/// Throws JobError if the value is outside the interval of the quantity.
void expect_allowed(const Entry& entry, const Quantity& rule, double value);

/// Reads an axis: a number, which gives an axis of one value, or a table with these keys only,
/// { values = [...] } or { first, last, count, spacing }.
Axis read_axis(const Entry& entry, const Quantity& rule, Names keys = axis_keys);

} // namespace overturn
