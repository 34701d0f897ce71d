// The outcome of a hard case in 50 digits.
#pragma once

#include "hard_case.hpp"

#include "overturn/mechanics/region.hpp"

namespace overturn {

/// The end of the forced stage in 50 digits, rounded after all differences were taken.
struct Truth {
    Region region = Region::undecided;
    bool settled = false; ///< the run has ended, and its margin exceeds the error of 50 digits
    bool fell = false;
    bool rested = false;
    double impacts = 0;    ///< excludes some of a series that died out
    double steps = 0;      ///< of the reference
    double angle = 0;      ///< theta [rad]
    double velocity = 0;   ///< theta' [rad]
    double margin = 0;     ///< [1]
    double below_top = 0;  ///< alpha - |theta| [rad]
    double within_arc = 0; ///< c - |theta'|, with the sign of q0 [rad]
};

/// Steps that take about a second, half a millisecond each; most cases need a hundred.
inline constexpr int steps_of_a_second = 2000;

Truth truth_of(const HardCase& point, int step_limit = steps_of_a_second);

/// theta [rad] of a block under a one-sine pulse at the phase pi + arcsin(1/a), where the ground
/// acceleration crosses the uplift value in the second lobe.
double angle_at_second_uplift_value(const HardCase& point);

} // namespace overturn
