// The reference of random verdicts and bounds of errors, and the command line of their programs.
#pragma once

#include "point_run.hpp"

#include "overturn/number/digits50.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace overturn {

inline constexpr Numerics tightest{.method = Method::taylor, .tolerance = 1e-14};
inline constexpr double loosest = 1e-4; ///< loosest tolerance with resolve
inline constexpr double margin_that_wants_digits = 1e-9;
/// Specified limit: one in 10^5 of all points may exceed the bound of its error, to first order.
inline constexpr double most_exceeded = 1e-5;

/// The tightest run in doubles, and 50 digits where its margin is small or unknown.
inline Outcomes truth_of(const PointRun& run)
{
    Outcomes outcomes = outcomes_of(run, tightest, {.error = true, .margin = true});
    for (int point = 0; point < outcomes.size(); ++point) {
        const auto i = std::size_t(point);
        // Half a million impacts in 50 digits would take hours.
        const bool hopeless = outcomes[i].flags & status::cap_was_hit;
        const double margin = std::abs(outcomes[i].margin);
        const bool is_known = std::isgreaterequal(margin, margin_that_wants_digits) &&
                              std::isless(outcomes[i].error, margin);
        if (!hopeless && !is_known) {
            run.run_in_more_digits<Digits50>(point, outcomes);
        }
    }
    return outcomes;
}

/// Whether so few bounds are exceeded. A single point in a small sample is not significant.
inline bool are_few(std::int64_t exceeded, std::int64_t points)
{
    return double(exceeded) <= 1 + most_exceeded * double(points);
}

/// main() of a program NAME POINTS [SEED]. study(points, seed) returns whether every verdict is
/// correct.
template <class Study>
int study_main(int argc, char** argv, const char* usage, const Study& study)
{
    if (argc < 2) {
        std::fprintf(stderr, "usage: %s\n", usage);
        return 2;
    }
    const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
    const bool right = study(std::strtoll(argv[1], nullptr, 10), seed);
    std::printf(right ? "every verdict is correct\n" : "FAILED\n");
    return right ? 0 : 1;
}

} // namespace overturn
