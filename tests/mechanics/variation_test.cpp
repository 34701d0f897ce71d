#include "overturn/mechanics/theory/theories.hpp"
#include "overturn/mechanics/variation.hpp"

#include "overturn/number/digits50.hpp"
#include "support/observed_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

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

/// The variation of an inverted pendulum, delta'' = k delta.
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
            return Equations<Theory::nonlinear>::acceleration(BlockSide{slenderness}, at, push);
        };
        const Digits50 slope =
            (acceleration(tilt + small) - acceleration(tilt - small)) / (2 * small);
        // A central difference is off by small^2 / 6 times a third derivative of order 1.
        EXPECT_LT(abs(slope - Equations<Theory::nonlinear>::stiffness(BlockSide{slenderness},
                                                                      Digits50(tilt), push)),
                  1e-23);
    }
}

TEST(VariationOverAStep, IsThatOfAnInvertedPendulumForAnyLength)
{
    // The series of cosh and sinh extend to x^20 / 20!, x^21 / 21!; the remainder is a geometric
    // series of at most 12^2 / (22 * 23), and at 12 less than 2 % of cosh(12).
    for (const double h : {0.01, 0.5, 1.0, 3.0, 6.0, 9.0, longest_variation}) {
        for (const double stiffness : {1.0, 0.6}) {
            EXPECT_LT(distance(variation_over<double>(h, stiffness, stiffness, stiffness),
                               exact_variation(h, stiffness)),
                      0.02 * std::cosh(h))
                << h;
        }
    }
    // Up to 3 the remainder is slightly more than 3^21 / 21! = 2.1e-10.
    EXPECT_LT(distance(variation_over<double>(3, 1, 1, 1), exact_variation(3, 1)), 3e-10);
}

/// From the beginning of a step to its end, in parts with a total error 1e10 times smaller.
template <class Stiffness>
Variation<double> composed_variation(double h, const Stiffness& stiffness)
{
    constexpr int parts = 300;
    Variation<double> all{1, 0, 0, 1};
    for (int i = 0; i < parts; ++i) {
        const auto at = [&](double part) { return stiffness(h * (i + part) / parts); };
        const auto next = variation_over<double>(h / parts, at(0), at(0.5), at(1));
        all = {next.tilt_by_tilt * all.tilt_by_tilt + next.tilt_by_rate * all.rate_by_tilt,
               next.tilt_by_tilt * all.tilt_by_rate + next.tilt_by_rate * all.rate_by_rate,
               next.rate_by_tilt * all.tilt_by_tilt + next.rate_by_rate * all.rate_by_tilt,
               next.rate_by_tilt * all.tilt_by_rate + next.rate_by_rate * all.rate_by_rate};
    }
    return all;
}

TEST(VariationOverAStep, HasOrderFourWhereTheStiffnessVaries)
{
    const auto stiffness = [](double t) { return 1 + t; };
    const auto error = [&](int steps) {
        const double h = 1.0 / steps;
        return distance(variation_over<double>(h, stiffness(0), stiffness(h / 2), stiffness(h)),
                        composed_variation(h, stiffness));
    };
    EXPECT_LT(error(1), 0.02);
    EXPECT_NEAR(observed_order({4, 6, 8, 12, 16}, error), 5, 0.1); // of one step
}

TEST(VariationOverAStep, BoundsItsUncertainty)
{
    // Steps of up to 2, over up to 2 rad of a push up to ten times as strong as gravity.
    std::mt19937_64 generator(4);
    std::uniform_real_distribution<double> uniform(0, 1);
    constexpr int draws = 2000;
    int too_little = 0;
    std::vector<double> shares;
    for (int i = 0; i < draws; ++i) {
        const double h = std::pow(10, -2 + 2.3 * uniform(generator));
        const double frequency = 2 * uniform(generator) / h;
        const double push = std::pow(10, -1.5 + 2.5 * uniform(generator));
        const double phase = 7 * uniform(generator);
        const auto stiffness = [&](double t) {
            return 0.8 + push * std::sin(frequency * t + phase);
        };
        const Variation<double> found =
            variation_over<double>(h, stiffness(0), stiffness(h / 2), stiffness(h));
        const Variation<double> exact = composed_variation(h, stiffness);
        const double share =
            std::max({std::abs(found.rate_by_tilt - exact.rate_by_tilt),
                      std::abs(found.tilt_by_tilt - exact.tilt_by_tilt) / h,
                      std::abs(found.rate_by_rate - exact.rate_by_rate) / h,
                      std::abs(found.tilt_by_rate - exact.tilt_by_rate) / (h * h)}) /
            found.unsure;
        too_little += share > 1;
        shares.push_back(share);
    }
    EXPECT_LT(too_little, draws / 50);
    std::sort(shares.begin(), shares.end());
    EXPECT_LT(shares.back(), 5);
    EXPECT_GT(shares[draws / 2], 1.0 / 30) << "the uncertainty is overestimated";
}

TEST(VariationOverAStep, PreservesAreas)
{
    // The motion has no friction: the determinant is 1, to the order of the step.
    const Variation<double> v = variation_over<double>(0.1, 1.3, 0.9, 0.4);
    EXPECT_NEAR(v.tilt_by_tilt * v.rate_by_rate - v.tilt_by_rate * v.rate_by_tilt, 1, 1e-6);
}

TEST(VariationOverAnImpact, IsThatOfTwoParabolas)
{
    // Before the impact the block falls as tilt + rate t + a t^2 / 2; after it, it rises on the
    // other side under b. The motions are compared at a fixed time after the impact and propagated
    // back to it.
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
    const Variation<double> found =
        variation_over_impact(sqrt_restitution, 1.0, speed, before, after);
    // A parabola maps a change of (tilt, rate) to (tilt + rate, rate) in a unit of time. The
    // differences have errors of small times second derivatives, of order 1 / speed^3.
    EXPECT_NEAR((x_tilt - x) / small - (v_tilt - v) / small, found.tilt_by_tilt, 1e-4);
    EXPECT_NEAR((v_tilt - v) / small, found.rate_by_tilt, 1e-4);
    EXPECT_NEAR((x_rate - x) / small - (v_rate - v) / small, found.tilt_by_rate, 1e-4);
    EXPECT_NEAR((v_rate - v) / small, found.rate_by_rate, 1e-4);
}

} // namespace
} // namespace overturn
