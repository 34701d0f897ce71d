#include "overturn/mechanics/low_bounces.hpp"

#include "support/one_point.hpp"

#include <gtest/gtest.h>

#include <random>

namespace overturn {
namespace {

template <Theory theory>
std::optional<LowBounces> bounds_of(PulseKind pulse, const PulsePoint<double>& point)
{
    return bound_of_low_bounces<theory>(point.block(), excitation_of<theory>(pulse, point));
}

TEST(LowBounces, BoundTheMotionAtAnyMoment)
{
    std::mt19937_64 generator(21);
    std::uniform_real_distribution<double> uniform(0, 1);
    int bounded = 0;
    for_every_scene([&]<Theory theory>(PulseKind pulse) {
        for (int i = 0; i < 60; ++i) {
            const double slenderness = 0.05 + 0.8 * uniform(generator);
            const double restitution = i % 2 ? 1 : uniform(generator);
            const PulsePoint<double> point{slenderness, restitution,
                                           std::pow(10, -1 + 2 * uniform(generator)),
                                           1 + std::pow(10, -0.5 - 2.5 * uniform(generator))};
            PulseExcitation<double> excitation = excitation_of<theory>(pulse, point);
            const PulseMotion<double>& motion = excitation.motion;
            excitation.motion =
                cut_at(motion.begin + uniform(generator) * (motion.end - motion.begin), motion);
            const auto bounds = bound_of_low_bounces<theory>(point.block(), excitation);
            if (!bounds) {
                continue;
            }
            ++bounded;
            // A long series keeps 1e-12 of its energy for 1e3 impacts, and less of its phase.
            const auto end =
                run_in_doubles<Taylor<20>, theory>({slenderness, restitution}, excitation, 1e-12);
            EXPECT_LE(end.state.tilt, bounds->tilt * (1 + 1e-9)) << i;
            EXPECT_LE(std::abs(end.state.rate), bounds->rate * (1 + 1e-9)) << i;
        }
    });
    EXPECT_GT(bounded, 350); // of 840
}

TEST(LowBounces, UnderAConstantPushAreCloseToTheClosedForm)
{
    // Linear theory: |theta| = (a - 1) alpha (cosh tau - 1) from rest.
    const PulsePoint<double> point{0.2, 1, 3, 1.02};
    const auto bounds = bounds_of<Theory::linear>(PulseKind::rectangular, point);
    ASSERT_TRUE(bounds);
    const double duration = pi<double>() / point.frequency;
    const double tilt = 0.02 * 0.2 * (std::cosh(duration) - 1);
    const double rate = 0.02 * 0.2 * std::sinh(duration);
    EXPECT_GE(bounds->tilt, tilt);
    EXPECT_GE(bounds->rate, rate);
    // The change of the pulse between the ends of a step, A (pi / 4096)^2 / 2 each, does work of 2
    // % of the energy: sum of tilt A (pi / 4096)^2 / 2 = 2.4e-7 against 1.3e-5.
    EXPECT_LE(bounds->tilt, tilt * 1.02);
    EXPECT_LE(bounds->rate, rate * 1.02);
}

TEST(LowBounces, HaveNoHeightIfTheBlockIsNotLifted)
{
    const auto bounds = bounds_of<Theory::nonlinear>(PulseKind::one_sine, {0.2, 1, 3, 1});
    ASSERT_TRUE(bounds);
    EXPECT_EQ(bounds->tilt, 0);
    EXPECT_EQ(bounds->rate, 0);
}

TEST(LowBounces, AreNotReportedForABlockThatRisesOrOverturns)
{
    EXPECT_FALSE((bounds_of<Theory::nonlinear>(PulseKind::one_sine, {0.2, 1, 3, 1.5})));
    EXPECT_FALSE((bounds_of<Theory::linear>(PulseKind::rectangular, {0.2, 1, 0.1, 1.02})));
    EXPECT_FALSE((bounds_of<Theory::nonlinear>(PulseKind::one_sine, {0.2, 1, 1e-40, 1.02})));
}

} // namespace
} // namespace overturn
