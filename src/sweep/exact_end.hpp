// One point of a plane in more digits: what settles a verdict that doubles cannot.
#pragma once

#include "sweep_kernel.hpp"

#include "overturn/mechanics/region.hpp"
#include "overturn/sweep/scene.hpp"

namespace overturn {

/// A point of a plane; its coordinates are taken as exact.
struct PlanePoint {
    double slenderness; ///< [rad]
    double restitution; ///< r [1]
    double amplitude;   ///< a [1]
    double frequency;   ///< Omega [1]
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

/// T: long double or Digits50.
template <class T>
ExactEnd exact_end(const Scene& scene, const PlanePoint& point);

} // namespace overturn
