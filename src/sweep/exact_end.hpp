// One point of a plane in more digits: what settles a verdict that doubles cannot.
#pragma once

#include "sweep_kernel.hpp"

#include "overturn/mechanics/region.hpp"
#include "overturn/sweep/plane.hpp"
#include "overturn/sweep/scene.hpp"

namespace overturn {

/// The end of a point, rounded to doubles after region, margin and error were told.
struct ExactEnd {
    double tilt, rate, side;
    std::uint8_t flags; ///< see end_flag
    double impacts, steps, phase;
    Region region;
    double margin;
    double error; ///< of the margin
};

/// T: long double or Digits50.
template <class T>
ExactEnd exact_end(const Scene& scene, const PlanePoint& point);

} // namespace overturn
