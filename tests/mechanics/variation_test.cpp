#include "overturn/mechanics/variation.hpp"

#include "overturn/number/digits50.hpp"
#include "support/observed_order.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace overturn {
namespace {

/// The largest entry of the difference.
template <class T>
T distance(const Variation<T>& a, const Variation<T>& b)
{
    using std::abs;
    const T first =
        std::max(T(abs(a.tilt_by_tilt - b.tilt_by_tilt)), T(abs(a.tilt_by_rate - b.tilt_by_rate)));
    const T second =
        std::max(T(abs(a.rate_by_tilt - b.rate_by_tilt)), T(abs(a.rate_by_rate - b.rate_by_rate)));
    return std::max(first, second);
}

/// Of an inverted pendulum, delta'' = k delta.
Variation<double> exact_variation(double h, double k)
{
    const double w = std::sqrt(k);
    return {std::cosh(w * h), std::sinh(w * h) / w, w * std::sinh(w * h), std::cosh(w * h)};
}

TEST(RockingStiffness, IsTheSlopeOfTheAcceleration)
{
    const Digits50 slenderness = 0.3;
    const Digits50 push = 0.7;
    const Digits50 small = 1e-12;
    for (const double tilt : {0.0, 0.1, 0.5, 1.2}) {
        const auto acceleration = [&](const Digits50& at) {
            return rocking_acceleration<Theory::nonlinear>(at, slenderness, push);
        };
        const Digits50 slope =
            (acceleration(tilt + small) - acceleration(tilt - small)) / (2 * small);
        // A central difference is off by small^2 / 6 times a third derivative of order 1.
        EXPECT_LT(
            abs(slope - rocking_stiffness<Theory::nonlinear>(Digits50(tilt), slenderness, push)),
            1e-23);
    }
}

TEST(VariationOverAStep, IsThatOfAnInvertedPendulumToItsOrder)
{
    // Off by (k h^2)^(5/2) / 120 and less, so with h falls to the fifth power.
    const auto error = [](int steps) {
        const double h = 1.0 / steps;
        return distance(variation_over<double>(h, 1, 1, 1), exact_variation(h, 1));
    };
    EXPECT_LT(error(1), 1.0 / 100);
    EXPECT_NEAR(observed_order({4, 6, 8, 12, 16}, error), 5, 0.1);
}

TEST(VariationOverAStep, KeepsAreas)
{
    // The motion has no friction: the determinant is 1, to the order of the step.
    const Variation<double> v = variation_over<double>(0.1, 1.3, 0.9, 0.4);
    EXPECT_NEAR(v.tilt_by_tilt * v.rate_by_rate - v.tilt_by_rate * v.rate_by_tilt, 1, 1e-6);
}

TEST(VariationOverAnImpact, IsThatOfTwoParabolas)
{
    // Before the impact the block falls as tilt + rate t + a t^2 / 2, after it it rises on the
    // other side under b. Compared at a fixed time after the impact, and carried back to it.
    const double sqrt_restitution = 0.9;
    const double speed = 0.4;
    const double before = -0.3;
    const double after = -0.2;
    const auto state_later = [&](double tilt, double rate) {
        const double strikes =
            (-rate - std::sqrt(rate * rate - 2 * before * tilt)) / before; // tilt = 0 there
        const double rises = -sqrt_restitution * (rate + before * strikes);
        const double left = 1 - strikes;
        return std::pair(rises * left + after * left * left / 2, rises + after * left);
    };
    const double small = 1e-6;
    const auto [x, v] = state_later(0, -speed);
    const auto [x_tilt, v_tilt] = state_later(small, -speed);
    const auto [x_rate, v_rate] = state_later(0, -speed + small);
    const Variation<double> found = variation_over_impact(sqrt_restitution, speed, before, after);
    // A parabola carries a change of (tilt, rate) to (tilt + rate, rate) in a unit of time. The
    // differences are off by small times second derivatives, of order 1 / speed^3.
    EXPECT_NEAR((x_tilt - x) / small - (v_tilt - v) / small, found.tilt_by_tilt, 1e-4);
    EXPECT_NEAR((v_tilt - v) / small, found.rate_by_tilt, 1e-4);
    EXPECT_NEAR((x_rate - x) / small - (v_rate - v) / small, found.tilt_by_rate, 1e-4);
    EXPECT_NEAR((v_rate - v) / small, found.rate_by_rate, 1e-4);
}

} // namespace
} // namespace overturn
