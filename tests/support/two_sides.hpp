// Blocks with two different sides, from their mass and shape by the formulas of mechanics, and
// random ones.
#pragma once

#include "overturn/mechanics/block.hpp"

#include <cmath>
#include <random>

namespace overturn {

/// A rigid body on a base. Lengths in m, angles in rad.
struct Body {
    double plus;   ///< distance of the corner plus from the foot of the centre of mass on the base
    double minus;  ///< that of the corner minus
    double height; ///< of the centre of mass above the base
    double gyration;    ///< radius of gyration about the centre of mass
    double incline = 0; ///< of the base; positive: the side plus is downhill

    double inertia(double base) const // about a corner, over the mass
    {
        return gyration * gyration + base * base + height * height;
    }
    /// The largest energy ratio of an impact: the angular momentum about the new corner is
    /// conserved.
    double largest_restitution() const
    {
        const double kept = gyration * gyration + height * height - plus * minus;
        return kept * kept / (inertia(plus) * inertia(minus));
    }
    /// As seen from the side plus.
    Block<double> block(double restitution, double gravity = 9.81) const
    {
        const auto side = [&](double base, double tilted) -> BlockSide<double> {
            const double size = std::hypot(base, height);
            return {std::atan(base / height) + tilted, size,
                    std::sqrt(gravity * size / inertia(base))};
        };
        return {side(plus, -incline), restitution, side(minus, incline)};
    }
    /// Whether it stands on its base, and rocks on after an impact.
    bool stands() const
    {
        const Block<double> block = this->block(1);
        const double right_angle = std::acos(0.0);
        return std::min(block.slenderness, block.other.slenderness) > 0 &&
               std::max(block.slenderness, block.other.slenderness) < right_angle &&
               gyration * gyration + height * height > plus * minus;
    }
    Body mirrored() const { return {minus, plus, height, gyration, -incline}; }
};

/// B1: a box of 0.5 m x 2 m on a base inclined by 4 degrees; B2: an eccentric body.
inline const Body leaning_box{0.25, 0.25, 1, std::sqrt(4.25 / 12), 4 * std::acos(-1.0) / 180};
inline const Body eccentric_body{0.30, 0.20, 1, std::sqrt(0.3541667)};

/// Sides whose barriers differ by a factor of up to about ten.
inline Body random_body(std::mt19937_64& generator)
{
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(generator);
    };
    Body body{between(0.1, 0.5), between(0.1, 0.5), between(0.7, 1.5), between(0.2, 0.8)};
    const double alpha_plus = std::atan(body.plus / body.height);
    const double alpha_minus = std::atan(body.minus / body.height);
    body.incline = between(-0.5 * alpha_minus, 0.5 * alpha_plus);
    return body;
}

} // namespace overturn
