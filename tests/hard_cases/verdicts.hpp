// What every hard case must show: see expect_right_verdicts().
#pragma once

#include "hard_case.hpp"
#include "reference.hpp"

#include "overturn/mechanics/region.hpp"
#include "overturn/sweep/sweep_tile.hpp"

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

/// A plane of this point alone, swept.
Outcome outcome_of(const HardCase& point, const Numerics& numerics);

/// Without resolve, both methods at the loosest tolerance at which errors are known, at the default
/// one, and near round-off.
std::vector<Numerics> plain_numerics();

/// With resolve, from the tolerance at which the program begins, and from the default one.
std::vector<Numerics> resolving_numerics();

/// What a case is allowed, where it is hard by its very idea.
struct Allowance {
    std::uint32_t most_steps = 5000; ///< of any one run
    bool undecided = false;          ///< runs without resolve may end without a verdict
    bool unresolved = false;         ///< resolve may give up
};

/// Expects of every method, tolerance and resolve:
///
///  - a region, with finite angle, velocity and margin that say the same as it, or the code
///    "undecided" together with a flag that says why;
///  - an error that is a number, or infinite, and infinite where a run has no end;
///  - no more than so many steps;
///  - where |margin| > error, the same verdict as in 50 digits, or as each other if 50 digits leave
///    it open;
///  - with resolve always a verdict, and the right one.
///
/// Returns what is true.
Truth expect_right_verdicts(const HardCase& point, const Allowance& allowed = {});

/// The same of one run, which is returned. truth: not settled if nobody knows.
Outcome expect_right_verdict(const HardCase& point, const Numerics& numerics, const Truth& truth,
                             const Allowance& allowed = {});

} // namespace overturn
