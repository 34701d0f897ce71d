// Errors of the ends of a solver compared with the reference.
#pragma once

#include "peer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace overturn::benchmarks {

/// The end of a point in the reference.
struct ReferenceEnd : PeerEnd<long double> {
    /// Whether solvers are compared at this point: not if its error grows so much that the verdict
    /// is almost a matter of chance.
    bool compared;
};

struct Errors {
    double p99;               ///< of the points compared that are safe in the reference
    double largest;           ///< of the points compared that are safe in the reference
    int safe_points;          ///< number of points compared that are safe in the reference
    int verdicts_that_differ; ///< of all points compared: safe, unsafe or undecided
};

/// The error of a point is max(|d theta|, |d theta'|) at the end of the ground motion over `unit`
/// [rad]; p99 is the smallest error that 99 of 100 points do not exceed. A point at which the
/// solver failed has an infinite error.
template <class S>
Errors errors_of(const std::vector<PeerEnd<S>>& ends, const std::vector<ReferenceEnd>& reference,
                 double unit)
{
    std::vector<double> errors;
    int differ = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const ReferenceEnd& truth = reference[i];
        if (!truth.compared) {
            continue;
        }
        differ += is_safe(ends[i].region) != is_safe(truth.region) ||
                  is_unsafe(ends[i].region) != is_unsafe(truth.region);
        if (is_safe(truth.region)) {
            const double error = double(std::max(std::abs(ends[i].angle - truth.angle),
                                                 std::abs(ends[i].velocity - truth.velocity))) /
                                 unit;
            errors.push_back(error >= 0 ? error : std::numeric_limits<double>::infinity());
        }
    }
    std::sort(errors.begin(), errors.end());
    const double none = std::numeric_limits<double>::quiet_NaN();
    const std::size_t within = errors.empty() ? 0 : (errors.size() * 99 + 99) / 100 - 1;
    return {errors.empty() ? none : errors[within], errors.empty() ? none : errors.back(),
            int(errors.size()), differ};
}

} // namespace overturn::benchmarks
