// The steps of read_job: apply the --set arguments, then read table by table.
#pragma once

#include "overturn/job/job.hpp"
#include "overturn/job/schema.hpp"
#include "overturn/problem/given.hpp"
#include "toml_reading.hpp"

#include <initializer_list>
#include <string>
#include <vector>

namespace overturn {

/// Overrides a key of the job by `key.path=value` (TOML; a bare word is a string). Keys that it
/// contradicts are dropped: `values` or first/last/count of the same axis, other quantities that
/// cannot be combined with this one, tables of blocks, the numbers that the new pulse does not
/// have, and the keys of a record or of a pulse. Throws Error if it is invalid.
void apply_override(toml::table& job, const std::string& argument);

/// Reads scene.record and the keys that belong to it. folder: of the job file; gravity [m/s2].
std::vector<RecordedMotion> read_motions(const Entry& scene, const std::string& folder,
                                         double gravity);

/// Reads scene.shape, the table of a pulse. folder: of the job file.
ShapeTable read_shape_table(const Entry& scene, const std::string& folder);

/// The XXH64 of lists of numbers, in hexadecimal digits.
std::string checksum_of(std::initializer_list<const std::vector<double>*> lists);

/// Whose motion it is: as scene.motion_of says, or the files of the records do.
MotionOf read_motion_of(const Entry& scene, const std::vector<RecordedMotion>& motions);

/// Reads the table of the blocks of a job. file: relative to the folder. Under records, the column
/// `motion` contains their names, or those of their files; in the result, their numbers, from 1.
/// Throws Error.
BlockTable read_block_table(const std::string& file, const std::string& folder,
                            const MotionTraits& motion, const std::vector<RecordedMotion>& motions);

/// The columns that describe points.
std::vector<Given> columns_of(const BlockTable& blocks, const MotionTraits& motion);

/// Throws Error with the file, and with line and column only if known.
[[noreturn]] void refuse(const BlockTable& blocks, const GivenError& error);

/// Reads [plane], [block] and [blocks] with the table that it names. folder: of the job file. The
/// scene and the motions of the job must have been read.
void read_points(const Entry& entry, const std::string& folder, Job& job);

/// The canonical text of a job: in fixed order, with all defaults.
std::string resolved_text(const Job& job);

} // namespace overturn
