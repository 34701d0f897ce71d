// Short pulses approach impulses, whose critical velocities V have closed forms.
#include "overturn/mechanics/free_rocking.hpp"
#include "support/every_method.hpp"
#include "support/observed_order.hpp"
#include "support/one_point.hpp"
#include "support/record_point.hpp"

#include <gtest/gtest.h>

namespace overturn {
namespace {

template <class Method>
class Impulse : public testing::Test {};
TYPED_TEST_SUITE(Impulse, EveryMethod, MethodName);

/// Expects p V / (g tan alpha) of the critical rectangular pulse to approach `limit` like
/// limit + slope * duration.
template <Theory theory, class Method>
void expect_limit(double alpha, double limit, double slope)
{
    const auto velocity = [&](int frequency) {
        const double duration = pi<double>() / frequency; // [1/p]
        const double exact = limit / duration;
        return duration * flip<theory, Method>(PulseKind::rectangular,
                                               {alpha, 0.9, double(frequency), 0}, 0.9 * exact,
                                               1.2 * exact, 1e-12);
    };
    // The velocity is d / (1 - exp(-d)) = 1 + d / 2 + d^2 / 12 for the duration d <= 0.06 in the
    // linear theory: the order is observed as 1 + d / 6. The nonlinear theory has coefficients of
    // the same size. A pulse of a wrong area would not converge.
    EXPECT_NEAR(observed_order({50, 100, 200, 400, 800},
                               [&](int frequency) { return velocity(frequency) - limit; }),
                1, 0.02);
    const double shortest = pi<double>() / 800;
    EXPECT_NEAR(velocity(800), limit + slope * shortest, shortest * shortest / 4);
}

TYPED_TEST(Impulse, OverturnsInTheLinearTheoryFromAVelocityOfOne)
{
    expect_limit<Theory::linear, TypeParam>(0.25, 1, 0.5);
}

TYPED_TEST(Impulse, OverturnsFromTheVelocityOfItsClosedForm)
{
    for (const double alpha : {0.1, 0.25, 0.6}) {
        // At the end of a pulse of duration d and velocity V = a d, both over tan alpha, to first
        // order in d: theta' = V sin(alpha) - d sin(alpha) + V^2 d tan(alpha) sin^2(alpha) / 6 and
        // theta = V d sin(alpha) / 2. The block overturns from theta'^2 / 2 + theta sin(alpha) =
        // 1 - cos(alpha) on.
        const double limit = 1 / std::cos(alpha / 2);
        expect_limit<Theory::nonlinear, TypeParam>(
            alpha, limit, 0.5 - limit * limit * std::tan(alpha) * std::sin(alpha) / 6);
    }
}

/// p V / (g tan alpha) from which on two opposite impulses overturn the block, the second one just
/// after its first impact. An impulse is a triangle of two sample intervals, of which there are
/// `intervals` from the first impulse to that impact.
double critical_double_impulse(const Block<double>& block, int intervals)
{
    const double alpha = block.slenderness;
    const auto overturns = [&](double velocity) {
        const State<double> pushed{0, velocity * std::sin(alpha), 1};
        const FreeRocking<Theory::nonlinear, double> free(pushed, block);
        const double interval = free.impact_time() / intervals; // [1/p]
        std::vector<double> samples(intervals + 8, 0);          // [g]
        samples[1] = velocity * std::tan(alpha) / interval;
        samples[intervals + 6] = -samples[1];
        const RecordPoint point{accelerogram(samples), block, 1, 1 / interval};
        const auto end = run_record<Theory::nonlinear, Directions::horizontal>(point, 1e-12);
        EXPECT_EQ(end.impacts, 1) << velocity;
        return margin_of<Theory::nonlinear>(end, block) < 0;
    };
    return flip_of(overturns, 0.4, 0.7);
}

TEST(DoubleImpulse, OverturnsFromTheVelocityOfItsClosedForm)
{
    const double alpha = 0.25;
    const Block<double> block{alpha, largest_restitution(alpha)};
    const double sine = std::sin(alpha);
    const double limit = 1 / (std::cos(alpha / 2) * (2 - 1.5 * sine * sine));
    EXPECT_NEAR(limit, 0.528178700193311, 1e-15);
    // The impulses last two intervals, and the second one begins some intervals after the impact:
    // the error is of order 1 in the interval, and that of the extrapolation of order 2.
    const auto error = [&](int intervals) {
        return critical_double_impulse(block, intervals) - limit;
    };
    EXPECT_NEAR(observed_order({200, 400, 800, 1600}, error), 1, 0.02);
    const auto extrapolated = [&](int intervals) {
        return std::abs(2 * error(2 * intervals) - error(intervals));
    };
    EXPECT_NEAR(observed_order({400, 800, 1600}, extrapolated), 2, 0.05);
    EXPECT_LT(extrapolated(1600), 1e-5);
}

} // namespace
} // namespace overturn
