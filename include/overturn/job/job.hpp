// A job: what a run computes and stores. The only module that uses TOML.
#pragma once

#include "overturn/mechanics/intensity_measures.hpp"
#include "overturn/problem/problem.hpp"
#include "overturn/text/table.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace overturn {

/// Where a record of the scene comes from, and what it is like.
struct RecordedMotion {
    std::string file;      ///< path as the job spells it, or as a pattern matched it
    std::string name;      ///< unique among the motions of the job: the file, or with component
    std::string component; ///< its name in the file; may be empty
    std::string vertical;  ///< component or file of the vertical motion as the job spells it
    std::string second;    ///< of the second horizontal component
    bool is_uncorrected;   ///< whether one of the files states that it was not corrected
    std::vector<std::string> remarks; ///< numbers of headers that differ from the samples by little
    std::vector<std::string> header;  ///< lines of the file in UTF-8
    IntensityMeasures measures;       ///< not scaled
    std::optional<MotionOf> stated_motion_of; ///< if one of the files states it
    std::optional<double> ground_pga;         ///< see RecordComponent; not scaled
    std::string checksum; ///< XXH64 of the accelerations over g, in hexadecimal digits
    std::shared_ptr<const Accelerogram> record;
};

/// Where the shape of a pulse comes from.
struct ShapeTable {
    std::string file;     ///< path as the job spells it; empty if the job has the values itself
    double peak;          ///< the largest |value|, by which the values were divided
    double periods;       ///< from the first to the last row
    std::string checksum; ///< XXH64 of the phases and accelerations, in hexadecimal digits
    std::shared_ptr<const Accelerogram> shape;
};

/// The column with the object of which a row is an azimuth, and that of the samples of the object.
/// They have no effect on the points, but on what is concluded from them.
inline constexpr std::string_view column_of_azimuths = "azimuth_of";
inline constexpr std::string_view column_of_samples = "sample";

/// The table of the blocks of a job.
struct BlockTable {
    std::string file;     ///< path as the job spells it
    Table table;          ///< under records, `motion_number` has the numbers of the records
    std::string checksum; ///< XXH64 of the columns, in hexadecimal digits
};

struct Job {
    std::string title;
    Problem problem;
    std::vector<RecordedMotion> motions; ///< those of scene.records, in order; empty: a pulse
    const Quantity* along = nullptr;     ///< of boundary_of(); nullptr: the strength
    std::optional<ShapeTable> shape;     ///< of a pulse that is given by a table
    std::optional<BlockTable> blocks;    ///< of which the grid has the columns that describe points

    std::string given;                  ///< the job file, byte for byte
    std::vector<std::string> overrides; ///< the --set arguments, in order
    std::string resolved;               ///< the canonical job: equal text, equal results
};

/// Reads and checks a job. Each override is `key.path=value` in TOML syntax (a bare word is a
/// string) and replaces a key of the file; keys that contradict it are dropped. Throws Error.
Job read_job(const std::string& path, const std::vector<std::string>& overrides = {});

/// The name of a job whose text is made from options. Messages do not state its lines.
inline constexpr const char* command_line = "the command line";

/// The same for a text; `name` replaces the path in messages. Records and tables are searched for
/// in its folder.
Job read_job_text(std::string text, const std::string& name,
                  const std::vector<std::string>& overrides = {});

/// The job that computes the boundary of a spectrum: the flips between the first and the last of
/// its strengths, or of the quantity that the job names. Throws Error if this has only one value,
/// if there is a table, or if the result would be too large.
Job boundary_of(Job spectrum);

} // namespace overturn
