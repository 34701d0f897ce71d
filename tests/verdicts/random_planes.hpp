// Random planes of 16 x 16 points: half of them like real blocks and pulses, half of them spread
// over whatever a job may ask for and a pulse can still move.
#pragma once

#include "overturn/mechanics/block.hpp"
#include "overturn/sweep/plane.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace overturn {

inline Plane random_plane(std::mt19937_64& generator)
{
    constexpr int side = 16;
    std::uniform_real_distribution<double> uniform(0, 1);
    const auto between = [&](double low, double high) {
        return low + (high - low) * uniform(generator);
    };
    const auto log_between = [&](double low, double high) {
        return std::exp(between(std::log(low), std::log(high)));
    };
    const auto axis = [&](const auto& value) {
        AxisList values(side);
        std::generate(values.begin(), values.end(), value);
        std::sort(values.begin(), values.end());
        return Axis(values);
    };
    Plane plane;
    if (uniform(generator) < 0.5) {
        const double slenderness = between(0.08, 0.45);
        plane.slenderness = Axis(AxisList{slenderness});
        plane.restitution = Axis(AxisList{largest_restitution(slenderness) * between(0.55, 1)});
        plane.frequency = axis([&] { return between(0.5, 9.5); });
        plane.amplitude = axis([&] { return between(1.05, 11.05); });
    } else {
        plane.slenderness = Axis(AxisList{log_between(0.01, 1.3)});
        // Some blocks lose nothing at all.
        plane.restitution = Axis(AxisList{uniform(generator) < 0.1 ? 1 : between(0.02, 1)});
        plane.frequency = axis([&] { return log_between(0.03, 30); });
        plane.amplitude = axis([&] { return 0.9 + log_between(1e-2, 1e2); });
    }
    return plane;
}

} // namespace overturn
