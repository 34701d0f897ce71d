// Requirements on every hard case: see expect_right_verdicts().
#pragma once

#include "hard_case.hpp"
#include "reference.hpp"

#include "overturn/mechanics/region.hpp"
#include "overturn/sweep/compute_tile.hpp"

#include <cstdint>
#include <vector>

namespace overturn {

/// Every field of one point.
struct Outcome {
    Region region = Region::not_computed;
    double angle = 0, velocity = 0, margin = 0, error = 0;
    std::uint16_t impacts = 0;
    std::uint32_t steps = 0;
    std::uint8_t status = 0;
};

/// Computes a spectrum of this point alone.
Outcome outcome_of(const HardCase& point, const Numerics& numerics);

/// Without resolve: both methods at the loosest tolerance at which errors are known, at the default
/// one, and near round-off.
std::vector<Numerics> plain_numerics();

/// With resolve: from the initial tolerance of the program, and from the default one.
std::vector<Numerics> resolving_numerics();

/// Exceptions for cases that are inherently hard.
struct Allowance {
    std::uint32_t most_steps = 5000; ///< of any one run
    bool undecided = false;          ///< runs without resolve may end without a verdict
    bool unresolved = false;         ///< resolve may give up
};

/// Expects of every method, tolerance and resolve:
///
///  - a region with consistent, finite angle, velocity and margin, or the code "undecided" together
///    with a flag that states the reason;
///  - an error that is finite or infinite, not NaN, and infinite where a run has no end;
///  - no more than most_steps steps;
///  - where |margin| > error, the same verdict as in 50 digits, or as each other if it is not
///    settled in 50 digits;
///  - with resolve always a verdict, and the right one.
///
/// Returns the reference.
Truth expect_right_verdicts(const HardCase& point, const Allowance& allowed = {});

/// The same for one run, which is returned. truth: not settled if it is unknown.
Outcome expect_right_verdict(const HardCase& point, const Numerics& numerics, const Truth& truth,
                             const Allowance& allowed = {});

} // namespace overturn
