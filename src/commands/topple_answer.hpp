// The answer of `topple`, and its form in JSON.
#pragma once

#include "commands.hpp"
#include "verdict_ranges.hpp"

#include "overturn/job/job.hpp"

#include <optional>
#include <string>
#include <vector>

namespace overturn {

/// The answer for one restitution.
struct RestitutionAnswer {
    double share; ///< r / r_max; NaN if there is no r_max
    double ratio; ///< r
    VerdictRanges ranges;
};

struct ToppleAnswer {
    std::optional<Verdict> verdict; ///< nullopt if not requested
    double peak = 0;                ///< |theta| / alpha
    std::optional<double> friction; ///< see Field::friction; nullopt in the linear theory
    /// For each toppling range of the requested restitution: the largest friction from uplift to
    /// its lower end, NaN if one is unknown; empty in the linear theory.
    std::vector<double> friction_to_topple;
    double pga = 0; ///< of the requested point
    double lifting_pga = 0;
    std::vector<RestitutionAnswer> by_restitution; ///< the requested one first
};

/// Prints the answer as JSON.
void print_json(const Job& job, const ToppleOptions& options, const ToppleAnswer& answer);

/// The name of a file or component, or another text, as a string of TOML and JSON. Throws Error if
/// it is not UTF-8.
std::string quoted_utf8(const std::string& text);

} // namespace overturn
