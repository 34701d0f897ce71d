// Series of bounces that die out, hardly die out, or never die out.
#include "boundary.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace overturn {
namespace {

TEST(BounceSeries, ThatDiesOutBringsTheBlockToRest)
{
    for (const double amplitude : {1.001, 1.005, 1.01}) {
        const HardCase point{.amplitude = amplitude};
        EXPECT_TRUE(is_safe(expect_right_verdicts(point).region));
        for (const Numerics& numerics : plain_numerics()) {
            const Outcome outcome = outcome_of(point, numerics);
            EXPECT_EQ(outcome.status, status::came_to_rest);
            EXPECT_EQ(outcome.impacts, impact_count::bounce_series);
        }
    }
}

TEST(BounceSeries, ThatHardlyDiesOutBeforeTheNextUpliftHasTheSameVerdictEitherWay)
{
    // Whether a series is closed depends on the bounds of its bounces, not on the digits.
    const auto rests = [](const HardCase& point) {
        const Outcome outcome = outcome_of(point, {.method = Method::taylor, .tolerance = 1e-12});
        return outcome.status == status::came_to_rest ? 1.0 : -1.0;
    };
    for (const auto& [frequency, low, high] :
         {std::array{0.5, 1.022, 1.024}, std::array{3.0, 1.02, 1.03}}) {
        const Neighbours last =
            neighbours_of_root({.frequency = frequency}, &HardCase::amplitude, low, high, rests);
        expect_right_verdicts(last.below);
        expect_right_verdicts(last.above);
    }
}

TEST(BounceSeries, InterruptedByTheNextUpliftIsResolvedWhereTheVerdictFlips)
{
    // Nine to eleven impacts between the lobes; the remaining bounces decide.
    for (const auto& [low, high] : {std::array{1.042, 1.044}, std::array{1.052, 1.054}}) {
        const Neighbours flip =
            neighbours_of_root({.frequency = 0.5}, &HardCase::amplitude, low, high, &Truth::margin);
        expect_right_verdicts_around(flip, &HardCase::amplitude);
    }
}

TEST(BounceSeries, WithoutLossNeverDiesOutAndIsCounted)
{
    for (const double alpha : {1e-6, std::atan2(1.0, 5.67), 1.0}) {
        const HardCase point{
            .slenderness = alpha, .restitution = 1, .frequency = 3, .amplitude = 1.01};
        EXPECT_GT(expect_right_verdicts(point).impacts, 100);
        const Outcome outcome = outcome_of(point, {.method = Method::taylor, .tolerance = 1e-12});
        EXPECT_EQ(outcome.status, 0);
        EXPECT_EQ(outcome.impacts, truth_of(point).impacts);
    }
}

TEST(BounceSeries, WithoutLossAndHardlyLiftedEndsAtTheLimitOfStepsWithAFlag)
{
    // Lifted by a millionth of the threshold it would bounce millions of times.
    const HardCase point{.restitution = 1, .frequency = 3, .amplitude = 1 + 1e-6};
    const Outcome outcome = expect_right_verdict(point, {.method = Method::rk45, .tolerance = 1e-9},
                                                 {}, {.most_steps = 1 << 20, .undecided = true});
    EXPECT_EQ(outcome.region, Region::undecided);
    EXPECT_EQ(outcome.status, status::cap_was_hit);
    EXPECT_EQ(outcome.steps, 1u << 20);
    EXPECT_EQ(outcome.impacts, impact_count::largest);
}

TEST(BounceSeries, ThatProvablyStaysLowIsSafeHoweverLong)
{
    // The same series, and one followed in doubles for about a hundred thousand bounces.
    const HardCase endless{.restitution = 1, .frequency = 3, .amplitude = 1 + 1e-6};
    const HardCase long_one{.pulse = PulseKind::one_cosine,
                            .slenderness = 0.01070179327811405,
                            .restitution = 1,
                            .frequency = 5.7031251127720424,
                            .amplitude = 1.0000077846945923};
    for (const HardCase& point : {endless, long_one}) {
        const Outcome outcome = expect_right_verdict(
            point, {.method = Method::taylor, .tolerance = 1e-4, .resolve = true}, {},
            {.most_steps = 1 << 20});
        EXPECT_EQ(outcome.region, Region::S);
        EXPECT_EQ(outcome.status, 0);
        EXPECT_EQ(outcome.margin, 1);
        EXPECT_LT(outcome.error, 0.1);
        EXPECT_LE(std::abs(outcome.angle) + std::abs(outcome.velocity),
                  outcome.error * point.slenderness);
    }
}

TEST(BounceSeries, TooLongForMoreDigitsIsNotTriedWithThem)
{
    // The second lobe lifts the block while it bounces, so its verdict requires following the
    // bounces; and more digits would need as many steps as doubles.
    const HardCase point{.pulse = PulseKind::one_cosine,
                         .slenderness = 0.3,
                         .restitution = 1,
                         .frequency = 0.02,
                         .amplitude = 1.00002};
    const Outcome outcome =
        expect_right_verdict(point, {.method = Method::taylor, .tolerance = 1e-4, .resolve = true},
                             {}, {.most_steps = 1 << 20, .unresolved = true});
    EXPECT_EQ(outcome.region, Region::undecided);
    EXPECT_EQ(outcome.status & status::unresolved, status::unresolved);
    EXPECT_GT(outcome.steps, 20000);
}

TEST(BounceSeries, WithHardlyAnyLossIsFollowedImpactByImpact)
{
    expect_right_verdicts({.restitution = 1 - 1e-6, .amplitude = 1.003}, {.most_steps = 20000});
}

} // namespace
} // namespace overturn
