// A job: what the user asks for. The only room that knows TOML.
#pragma once

#include "overturn/sweep/fields.hpp"
#include "overturn/sweep/plane.hpp"
#include "overturn/sweep/scene.hpp"
#include "overturn/sweep/tile.hpp"

#include <stdexcept>
#include <string>
#include <vector>

namespace overturn {

/// The user's mistake: where, what was found, what is allowed, what to do.
class JobError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// What is made of a plane.
enum class Product { spectrum, boundary };

/// Flips of a boundary that are stored for a block at one frequency, at most.
inline constexpr std::int64_t most_crossings = 64;

struct Job {
    Product product = Product::spectrum;
    std::string title;
    Scene scene;
    Plane plane;
    Numerics numerics;
    std::vector<Field> fields; ///< in the job's order, without duplicates
    Axis scan;                 ///< of a boundary: the amplitudes that are looked at [1]

    std::string given;                  ///< the job file, byte for byte
    std::vector<std::string> overrides; ///< the --set arguments, in order
    std::string resolved;               ///< the canonical job: equal text, equal results
};

/// Reads and checks a job. Each override is `key.path=value` in TOML syntax (a bare word stands for
/// a string), laid over the file; what it contradicts in the file is dropped.
/// Throws JobError; nothing is computed or written before it.
Job read_job(const std::string& path, const std::vector<std::string>& overrides = {});

/// The same of a text; its name stands for the path in messages.
Job read_job_text(std::string text, const std::string& name,
                  const std::vector<std::string>& overrides = {});

/// The job that finds the boundaries of a job's spectrum. Its amplitudes become the scan, and the
/// plane has crossings instead: the flips of a block at one frequency, counted from 0.
/// Throws JobError if there is a single amplitude, or if no file could hold them.
Job boundary_of(Job spectrum);

/// How a job is cut into tiles.
Tiling tiling_of(const Job& job);

/// |f| at the ends of a Ricker wavelet's window, over its peak: what the window cuts off [1];
/// 0 for the pulses that end by themselves.
double cut_by_window(const Scene& scene);

} // namespace overturn
