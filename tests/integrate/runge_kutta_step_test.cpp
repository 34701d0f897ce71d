#include "overturn/integrate/first_root.hpp"
#include "overturn/integrate/runge_kutta_step.hpp"
#include "overturn/number/digits50.hpp"
#include "support/observed_order.hpp"
#include "support/untrapped_floating_point.hpp"

#include <gtest/gtest.h>

namespace overturn {
namespace {

using Motion50 = StepMotion<Digits50>;

/// x'' = sin x + cos(2 t) cos x from x = 0.2 at rest, over 2 units of time: an inverted pendulum
/// under a smooth push. In double it reaches round-off at 64 steps; 50 digits avoid this.
Digits50 acceleration(const Digits50& t, const Digits50& x)
{
    return sin(x) + cos(2 * t) * cos(x);
}

Motion50 start()
{
    return {Digits50(0.2), 0, acceleration(0, Digits50(0.2))};
}

Step<Digits50> step_from(const Motion50& motion, const Digits50& t, const Digits50& h)
{
    return runge_kutta_step(motion, h, [&](std::size_t stage, const Digits50& x) {
        return acceleration(t + DormandPrince::node[stage].in<Digits50>() * h, x);
    });
}

/// The motion at the ends of n equal steps.
std::vector<Motion50> run(int n)
{
    const Digits50 h = Digits50(2) / n;
    std::vector<Motion50> motions{start()};
    for (int i = 0; i < n; ++i) {
        motions.push_back(step_from(motions.back(), i * h, h).end);
    }
    return motions;
}

constexpr int finest = 8192;

/// The motion with 8192 steps: its error is 2^-20 of that with 512, the most used below.
const std::vector<Motion50>& reference()
{
    static const std::vector<Motion50> motions = run(finest);
    return motions;
}

// With fewer steps the observed order still decreases to its limit: 5.4 between 16 and 128.
const std::vector<int> step_counts{64, 128, 256, 512};

TEST(RungeKuttaStep, ConvergesWithOrderFive)
{
    const auto position_error = [](int n) -> Digits50 {
        return abs(run(n).back().position - reference().back().position);
    };
    const auto rate_error = [](int n) -> Digits50 {
        return abs(run(n).back().rate - reference().back().rate);
    };
    // A method of order 4 or 6 would miss by five margins.
    EXPECT_NEAR(observed_order(step_counts, position_error), 5, 0.2);
    EXPECT_NEAR(observed_order(step_counts, rate_error), 5, 0.2);
}

TEST(RungeKuttaStep, EstimatesItsLocalErrorWithTheOrderOfTheEmbeddedMethod)
{
    // Error of the first step; the local error of a method of order 4 is h^5.
    EXPECT_NEAR(observed_order(step_counts,
                               [](int n) -> Digits50 {
                                   return abs(step_from(start(), 0, Digits50(2) / n).rate_error);
                               }),
                5, 0.2);
}

/// Error of the dense output in the middle of step number `step` of n, between two motions.
Digits50 error_within(const Motion50& from, const Motion50& to, int step, int n)
{
    const auto dense = dense_output(from, to, Digits50(Digits50(2) / n));
    const Digits50 middle = restricted(dense, Digits50(0), Digits50(0.5)).back();
    return abs(middle - reference()[std::size_t((2 * step + 1) * (finest / 2 / n))].position);
}

TEST(DenseOutput, ConvergesAsFastAsTheStep)
{
    const auto worst = [](int n) {
        const auto motions = run(n);
        Digits50 error = 0;
        for (int i = 0; i < n; ++i) {
            const auto k = std::size_t(i);
            const Digits50 here = error_within(motions[k], motions[k + 1], i, n);
            error = here > error ? here : error;
        }
        return error;
    };
    // Dormand and Prince's own dense output would give 4 here.
    EXPECT_NEAR(observed_order(step_counts, worst), 5, 0.2);
}

TEST(DenseOutput, BetweenExactEndsHasOrderSix)
{
    const auto error = [](int n) {
        const int step = n / 4;
        const std::size_t k = std::size_t(step * (finest / n));
        return error_within(reference()[k], reference()[k + std::size_t(finest / n)], step, n);
    };
    EXPECT_NEAR(observed_order(step_counts, error), 6, 0.2);
}

TEST(DenseOutput, MatchesPositionRateAndAccelerationAtBothEnds)
{
    const StepMotion<double> start{0.3, -0.7, 1.1};
    const StepMotion<double> end{0.1, 0.2, -0.4};
    const double h = 0.5;
    const Quintic<double> c = dense_output(start, end, h);
    const double ulp = 1e-15; // a few roundings of numbers of order 1
    EXPECT_EQ(c[0], start.position);
    EXPECT_EQ(c[5], end.position);
    EXPECT_NEAR(5 * (c[1] - c[0]) / h, start.rate, 10 * ulp);
    EXPECT_NEAR(5 * (c[5] - c[4]) / h, end.rate, 10 * ulp);
    EXPECT_NEAR(20 * (c[2] - 2 * c[1] + c[0]) / (h * h), start.acceleration, 100 * ulp);
    EXPECT_NEAR(20 * (c[5] - 2 * c[4] + c[3]) / (h * h), end.acceleration, 100 * ulp);
}

TEST(StepSizeFactor, ShrinksAboveAndGrowsBelowTheTolerance)
{
    EXPECT_DOUBLE_EQ(step_size_factor(1.0), 0.9);
    EXPECT_DOUBLE_EQ(step_size_factor(0x1p-16), 4);   // 0.9 * 8, limited
    EXPECT_DOUBLE_EQ(step_size_factor(0x1p+16), 0.2); // 0.9 / 8, limited
    EXPECT_DOUBLE_EQ(step_size_factor(0x1p-8), 0.9 * std::pow(2, 1.5));
    EXPECT_EQ(step_size_factor(0.0), 4);
    const UntrappedFloatingPoint comparison_with_nan;
    EXPECT_EQ(step_size_factor(std::numeric_limits<double>::quiet_NaN()), 0.2);
}

} // namespace
} // namespace overturn
