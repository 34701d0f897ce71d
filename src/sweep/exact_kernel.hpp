// One point in 50 digits: what settles a verdict that doubles cannot.
#pragma once

#include "sweep_kernel.hpp"

#include "overturn/mechanics/region.hpp"

namespace overturn {

/// A step takes half a millisecond. Whoever needs more than these bounces without end.
inline constexpr int most_exact_steps = 20000;

/// A point of a plane; its coordinates are taken as exact.
struct PlanePoint {
    double slenderness; ///< [rad]
    double restitution; ///< r [1]
    double amplitude;   ///< a [1]
    double frequency;   ///< Omega [1]
    double window;      ///< of a Ricker wavelet [pulse periods]
};

/// Its end, rounded to doubles after region, margin and error were told.
struct ExactEnd {
    double tilt, rate, side;
    std::uint8_t flags; ///< see end_flag
    double impacts, steps;
    Region region;
    double margin;
    double error; ///< of the margin
};

using ExactKernel = ExactEnd (*)(Theory theory, const PlanePoint& point);

} // namespace overturn
