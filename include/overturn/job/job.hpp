// A job: what a run computes and stores. The only module that uses TOML.
#pragma once

#include "overturn/sweep/fields.hpp"
#include "overturn/sweep/plane.hpp"
#include "overturn/sweep/scene.hpp"
#include "overturn/sweep/tile.hpp"

#include <stdexcept>
#include <string>
#include <vector>

namespace overturn {

/// An error in a job. The message names the place, what was found, what is allowed and what to do.
class JobError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// What a job computes over its plane.
enum class Product { spectrum, boundary };

/// Maximum number of flips of a boundary that are stored for a block at one frequency.
inline constexpr std::int64_t most_crossings = 64;

struct Job {
    Product product = Product::spectrum;
    std::string title;
    Scene scene;
    Plane plane;
    Numerics numerics;
    std::vector<Field> fields; ///< in the job's order, without duplicates
    Axis scan;                 ///< of a boundary: the amplitudes that are computed first [1]

    std::string given;                  ///< the job file, byte for byte
    std::vector<std::string> overrides; ///< the --set arguments, in order
    std::string resolved;               ///< the canonical job: equal text, equal results
};

/// Reads and checks a job. Each override is `key.path=value` in TOML syntax (a bare word is a
/// string) and replaces a key of the file; keys that contradict it are dropped. Throws JobError.
Job read_job(const std::string& path, const std::vector<std::string>& overrides = {});

/// The same for a text; `name` replaces the path in messages.
Job read_job_text(std::string text, const std::string& name,
                  const std::vector<std::string>& overrides = {});

/// The job that computes the boundary of a spectrum. The amplitudes become the scan, and crossings
/// replace them in the plane: the flips of a block at one frequency, counted from 0.
/// Throws JobError if there is only one amplitude, or if the result would be too large.
Job boundary_of(Job spectrum);

/// The division of a job into tiles.
Tiling tiling_of(const Job& job);

/// |f| over its peak at the ends of a Ricker wavelet's window, where it is truncated [1]; 0 for
/// other pulses.
double cut_by_window(const Scene& scene);

} // namespace overturn
