// A hard case: one point together with its scene.
#pragma once

#include "overturn/mechanics/block.hpp"
#include "overturn/problem/scene.hpp"

#include <cmath>
#include <ostream>

namespace overturn {

/// By default the paper's block under a one-sine pulse.
struct HardCase {
    PulseKind pulse = PulseKind::one_sine;
    Theory theory = Theory::nonlinear;
    double slenderness = std::atan2(1.0, 5.67);            ///< alpha [rad]
    double restitution = largest_restitution(slenderness); ///< r [1]
    double frequency = 3;                                  ///< Omega [1]
    double amplitude = 3;                                  ///< a [1]
    double window = 1; ///< half width of a Ricker wavelet [pulse periods]
};

inline std::ostream& operator<<(std::ostream& out, const HardCase& point)
{
    const auto digits = out.precision(17);
    out << name_of(point.pulse) << ", " << name_of(point.theory) << ", alpha " << point.slenderness
        << ", r " << point.restitution << ", Omega " << point.frequency << ", a "
        << point.amplitude;
    if (has_window(point.pulse)) {
        out << ", window " << point.window;
    }
    out.precision(digits);
    return out;
}

} // namespace overturn
