// A job: what the user asks for. The only room that knows TOML.
#pragma once

#include "overturn/sweep/fields.hpp"
#include "overturn/sweep/plane.hpp"
#include "overturn/sweep/scene.hpp"

#include <stdexcept>
#include <string>
#include <vector>

namespace overturn {

/// The user's mistake: where, what was found, what is allowed, what to do.
class JobError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

struct Job {
    std::string title;
    Scene scene;
    Plane plane;
    Numerics numerics;
    std::vector<Field> fields; ///< in the job's order, without duplicates

    std::string given;                  ///< the job file, byte for byte
    std::vector<std::string> overrides; ///< the --set arguments, in order
    std::string resolved;               ///< the canonical job: equal text, equal results
};

/// Reads and checks a job. Each override is `key.path=value` in TOML syntax (a bare word stands for
/// a string), laid over the file; what it contradicts in the file is dropped.
/// Throws JobError; nothing is computed or written before it.
Job read_job(const std::string& path, const std::vector<std::string>& overrides = {});

/// |f| at the ends of a Ricker wavelet's window, over its peak: what the window cuts off [1];
/// 0 for the pulses that end by themselves.
double cut_by_window(const Scene& scene);

} // namespace overturn
