// Points on a boundary: neighbouring doubles between which a quantity in 50 digits changes.
#pragma once

#include "verdicts.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

namespace overturn {

/// A hard case on each side of a change.
struct Neighbours {
    HardCase below;
    HardCase above;
};

using Coordinate = double HardCase::*;

/// Neighbouring doubles in [low, high] between which the value, a function of the coordinate,
/// changes its sign. Needs about five evaluations if the value is smooth, fifty if it jumps.
template <class Value>
Neighbours neighbours_of_root(HardCase point, Coordinate coordinate, double low, double high,
                              const Value& value)
{
    const auto value_at = [&](double x) -> double {
        point.*coordinate = x;
        return value(point);
    };
    const auto adjacent = [](double a, double b) { return !(std::nextafter(a, b) < b); };
    std::uintmax_t evaluations = 200;
    const auto [a, b] =
        boost::math::tools::toms748_solve(value_at, low, high, adjacent, evaluations);
    Neighbours found{point, point};
    found.below.*coordinate = a;
    found.above.*coordinate = b; // the same as a where the value is 0
    return found;
}

/// The same for a quantity of the end state in 50 digits.
inline Neighbours neighbours_of_root(const HardCase& point, Coordinate coordinate, double low,
                                     double high, double Truth::*quantity)
{
    return neighbours_of_root(point, coordinate, low, high,
                              [&](const HardCase& at) { return truth_of(at).*quantity; });
}

/// The same for a condition that changes between true and false.
template <class Fact>
Neighbours neighbours_of_change(const HardCase& point, Coordinate coordinate, double low,
                                double high, const Fact& fact)
{
    return neighbours_of_root(point, coordinate, low, high,
                              [&](const HardCase& at) { return fact(truth_of(at)) ? 1.0 : -1.0; });
}

/// Expects correct verdicts at both neighbours, and next to them at distances from the last bits of
/// a double to where a loose tolerance is certain: an error of the verdict, at a tolerance of 1e-4
/// or finer, shows at one of them.
inline void expect_right_verdicts_around(const Neighbours& boundary, Coordinate coordinate,
                                         const Allowance& allowed = {})
{
    expect_right_verdicts(boundary.below, allowed);
    expect_right_verdicts(boundary.above, allowed);
    for (const double distance : {1e-15, 1e-14, 1e-12, 1e-9, 1e-6, 1e-4}) {
        HardCase below = boundary.below;
        below.*coordinate *= 1 - distance;
        expect_right_verdicts(below, allowed);
        HardCase above = boundary.above;
        above.*coordinate *= 1 + distance;
        expect_right_verdicts(above, allowed);
    }
}

} // namespace overturn
