// The forced stage in 50 digits, by Taylor series of order 30: what settles a verdict that doubles
// cannot, and what accuracy is measured against.
#pragma once

#include "overturn/integrate/forced_stage.hpp"
#include "overturn/number/digits50.hpp"

namespace overturn {

/// A step in 50 digits takes half a millisecond. Whoever needs more than these bounces without end.
inline constexpr int most_exact_steps = 20000;

/// run_forced_stage() for one block, which counts impacts and bounds its error, and after
/// `step_limit` steps gives up as capped. A tolerance of 1e-30 leaves 25 digits and more at the end
/// of a pulse, after a hundred steps or so. Compiled for every pulse in src/integrate.
template <class Pulse, Theory theory>
ForcedEnd<Digits50> run_in_fifty_digits(const Block<Digits50>& block,
                                        const Excitation<Pulse, Digits50>& excitation,
                                        double tolerance, int step_limit = most_exact_steps);

} // namespace overturn
