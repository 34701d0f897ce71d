// Bounce series: in closed form where they die out, impact by impact where they do not.
#include "support/one_point.hpp"

#include <gtest/gtest.h>

namespace overturn {
namespace {

TEST(BounceSeries, OfABarelyLiftedBlockEndsInClosedForm)
{
    for (const double excess : {1e-15, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3}) {
        const auto end = forced_end<OneSine, Theory::nonlinear>(
            Point<double>{0.1745, 0.91, 2.0, 1 + excess}, 1e-9);
        EXPECT_TRUE(end.rested);
        // Two lobes lift it. Impact by impact each series would go on until its speed is
        // round-off: 2 log(1e-16) / log(0.91) = 780 impacts.
        EXPECT_LE(end.impacts, 12) << "excess " << excess;
        EXPECT_LT(end.steps, 500) << "excess " << excess;
    }
}

TEST(BounceSeries, ABlockThatRestedBetweenTheLobesForgetsTheFirst)
{
    // The second half of a one-sine pulse is a half-sine pulse to the other side.
    const Point<double> point{0.2, 0.5, 1.0, 1.02};
    const auto both = forced_end<OneSine, Theory::nonlinear>(point, 1e-11);
    const auto second = forced_end<HalfSine, Theory::nonlinear>(point, 1e-11);
    ASSERT_TRUE(both.rested);
    EXPECT_NEAR(both.state.tilt, second.state.tilt, 1e-9 * point.slenderness);
    EXPECT_NEAR(both.state.rate, second.state.rate, 1e-9 * point.slenderness);
}

TEST(BounceSeries, NearlyPlasticImpactsBringTheBlockToRestAtOnce)
{
    const auto end =
        forced_end<OneSine, Theory::nonlinear>(Point<double>{0.2, 1e-12, 2.0, 1.05}, 1e-9);
    EXPECT_TRUE(end.rested);
    EXPECT_LE(end.impacts, 4);
}

TEST(BounceSeries, WithoutLossNeverRests)
{
    const auto end =
        forced_end<OneSine, Theory::nonlinear>(Point<double>{0.2, 1.0, 2.0, 1.01}, 1e-9);
    EXPECT_FALSE(end.rested);
    EXPECT_FALSE(end.capped);
    EXPECT_GT(end.impacts, 50);
}

TEST(BounceSeries, EndsWhereBouncingOnWouldHaveEnded)
{
    // Just before a series is closed its speed v is 1e-3 alpha or less, and bouncing on would end
    // in the same rest: the next lobe lifts both alike. A series closed although the ground lifts
    // the block again before it died out would show as a jump between neighbouring amplitudes.
    double previous = -1;
    for (int i = 0; i <= 400; ++i) {
        const double amplitude = 1.001 + 0.0002 * i;
        const auto end =
            forced_end<OneSine, Theory::nonlinear>(Point<double>{0.2, 0.4, 1.0, amplitude}, 1e-11);
        ASSERT_FALSE(end.fell);
        if (previous >= 0 && end.rested) {
            EXPECT_NEAR(end.state.tilt, previous, 0.01 * 0.2) << "amplitude " << amplitude;
        }
        previous = end.rested ? end.state.tilt : -1;
    }
}

} // namespace
} // namespace overturn
