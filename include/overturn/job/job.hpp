// A job: what a run computes and stores. The only module that uses TOML.
#pragma once

#include "overturn/mechanics/intensity_measures.hpp"
#include "overturn/record/read_table.hpp"
#include "overturn/sweep/fields.hpp"
#include "overturn/sweep/plane.hpp"
#include "overturn/sweep/scene.hpp"
#include "overturn/sweep/tile.hpp"

#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace overturn {

/// An error in a job. The message names the place, what was found, what is allowed and what to do.
class JobError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// What a job computes over its plane.
enum class Product { spectrum, boundary };

/// Maximum number of flips of a boundary that are stored for a block at one frequency or size.
inline std::int64_t most_crossings(const Scene& scene)
{
    return scene.is_recorded() ? 256 : 64;
}

/// A recorded ground motion of a job. A job read from a result file describes its records, but does
/// not contain their accelerations.
struct Motion {
    std::string file;      ///< path as the job spells it, or as a pattern matched it
    std::string name;      ///< of its own among the motions of the job: the file, or with component
    std::string component; ///< its name in the file; may be empty
    std::string vertical;  ///< component or file of the vertical motion as the job spells it
    std::vector<std::string> header; ///< lines of the file in UTF-8; not in a resolved job

    std::int64_t samples = 0;
    double time_step = 0; ///< [s]
    IntensityMeasures measures;
    double largest_scale = std::numeric_limits<double>::infinity(); ///< see Accelerogram
    std::string checksum; ///< XXH64 of the accelerations over g, in hexadecimal digits

    std::shared_ptr<const Accelerogram> record; ///< null in a job read from a result file
};

/// The table of the blocks of a list. A job read from a result file describes it, but does not
/// contain its columns.
struct BlockTable {
    std::string file;                 ///< path as the job spells it
    std::vector<std::string> columns; ///< their names, in order
    std::string checksum;             ///< XXH64 of the columns, in hexadecimal digits

    std::shared_ptr<const Table> table; ///< null in a job read from a result file
};

struct Job {
    Product product = Product::spectrum;
    std::string title;
    Scene scene;
    std::vector<Motion> motions;      ///< those of scene.records, in order; empty: a pulse
    std::optional<BlockTable> blocks; ///< that of plane.list
    Plane plane;
    Numerics numerics;
    std::vector<Field> fields; ///< in the job's order, without duplicates; of a filled spectrum,
                               ///< `evaluated` is the last one
    Axis scan;                 ///< of a boundary: the amplitudes that are computed first [1]

    std::string given;                  ///< the job file, byte for byte
    std::vector<std::string> overrides; ///< the --set arguments, in order
    std::string resolved;               ///< the canonical job: equal text, equal results

    /// The smallest and the largest factor on a record [1]; `motion` must be one of `motions`.
    double smallest_scale(const Motion& motion) const;
    double largest_scale(const Motion& motion) const;

    /// Both; infinity and 0 for a motion to which no block of a list is subjected.
    std::pair<double, double> scales(const Motion& motion) const;
};

/// The names of all axes of a plane.
inline constexpr std::array<std::string_view, 10> axis_names{
    "frequency", "pulse_period", "pulse_frequency",     "amplitude",   "pga",
    "scale",     "size",         "frequency_parameter", "restitution", "slenderness"};

/// Whether a job gives at most one value of these two axes: they are equal, or give one quantity.
bool exclude_each_other(std::string_view axis, std::string_view other);

/// The keys that an override of read_job() may replace, such as "scene.pulse" and
/// "plane.frequency.count".
std::vector<std::string> override_keys();

/// Reads and checks a job. Each override is `key.path=value` in TOML syntax (a bare word is a
/// string) and replaces a key of the file; keys that contradict it are dropped. Throws JobError.
Job read_job(const std::string& path, const std::vector<std::string>& overrides = {});

/// The name of a job whose text is made from options. Messages do not state its lines.
inline constexpr const char* command_line = "the command line";

/// The same for a text; `name` replaces the path in messages. Records are searched for in
/// its folder.
Job read_job_text(std::string text, const std::string& name,
                  const std::vector<std::string>& overrides = {});

/// Reads the resolved job in a result file, whose records are described there: their accelerations
/// are not read. Throws JobError.
Job read_resolved_job(std::string text, const std::string& name);

/// The XXH64 of the columns of a table, in hexadecimal digits.
std::string checksum_of(const Table& table);

/// Adds the columns of the table, which a result file contains, to the job in it. Under records, if
/// the blocks have motions of their own, the strengths of these are left out. Throws JobError if
/// the columns are not valid.
void restore_blocks(Job& job, Table table);

/// The job that computes the boundary of a spectrum. The amplitudes become the scan, and the
/// dimension `crossing` replaces them in the plane: the flips of a block at one frequency, counted
/// from 0.
/// Throws JobError if there is only one amplitude, or if the result would be too large.
Job boundary_of(Job spectrum);

/// Why the spectrum of this job cannot be filled, as a clause; empty if it can.
std::string reason_not_to_fill(const Job& job);

/// The division of a job into tiles.
Tiling tiling_of(const Job& job);

/// |f| over its peak at the ends of a Ricker wavelet's window, where it is truncated [1]; 0 for
/// other pulses.
double cut_by_window(const Scene& scene);

} // namespace overturn
