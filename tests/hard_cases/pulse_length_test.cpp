// Pulses of thousands of units of time, and of less than a thousandth.
#include "boundary.hpp"

#include <gtest/gtest.h>

namespace overturn {
namespace {

TEST(LongPulse, LiftsTheBlockBrieflyAndBringsItToRestTwice)
{
    // In 6283 units of time, the ground exceeds the threshold for one and a half in each lobe.
    const HardCase point{.frequency = 1e-3, .amplitude = 1 + 1e-7};
    const Truth truth = expect_right_verdicts(point);
    EXPECT_EQ(truth.region, Region::S);
    EXPECT_TRUE(truth.rested);
    for (const Numerics& numerics : plain_numerics()) {
        const Outcome outcome = outcome_of(point, numerics);
        EXPECT_EQ(outcome.status, status::came_to_rest);
        EXPECT_EQ(outcome.impacts, impact_count::bounce_series);
        EXPECT_EQ(outcome.angle, 0);
        EXPECT_EQ(outcome.velocity, 0);
    }
}

TEST(LongPulse, OverturnsTheBlockIfItLiftsItLongEnough)
{
    const Neighbours flip = neighbours_of_root({.frequency = 1e-3}, &HardCase::amplitude, 1 + 1e-7,
                                               1 + 1e-5, &Truth::margin);
    // The flip is about 1e-6 above 1: distances are measured from there.
    EXPECT_LT(flip.below.amplitude - 1, 5e-6);
    expect_right_verdicts(flip.below);
    expect_right_verdicts(flip.above);
    for (const double distance : {-1e-7, -1e-9, -1e-12, 1e-12, 1e-9, 1e-7}) {
        HardCase point = flip.below;
        point.amplitude += distance;
        expect_right_verdicts(point);
    }
}

TEST(LongPulse, RestAfterAnExcursionToTheTopIsAsCertainAsTheExcursion)
{
    // Near the top the block may turn back or not; once at rest it does not show this uncertainty.
    const Truth truth = expect_right_verdicts({.pulse = PulseKind::antisymmetric_ricker,
                                               .slenderness = 0.55443270095467534,
                                               .restitution = 0.1800942256249258,
                                               .frequency = 0.10970031964016724,
                                               .amplitude = 1.0065794358944815});
    EXPECT_EQ(truth.region, Region::F_plus);
}

TEST(LongPulse, OfAConstantPushTerminates)
{
    for (const double amplitude : {1.0, 1 + 1e-15, 1 + 1e-6, 2.0}) {
        expect_right_verdicts(
            {.pulse = PulseKind::rectangular, .frequency = 1e-3, .amplitude = amplitude});
    }
}

TEST(LongPulse, OfEveryShapeGivesAVerdict)
{
    for (std::size_t pulse = 0; pulse < names_of<PulseKind>.size(); ++pulse) {
        for (const double amplitude : {1 + 1e-8, 1.001, 3.0}) {
            expect_right_verdicts(
                {.pulse = PulseKind(pulse), .frequency = 1e-3, .amplitude = amplitude});
        }
    }
}

TEST(ShortPulse, OfEveryShapeGivesAVerdict)
{
    for (std::size_t pulse = 0; pulse < names_of<PulseKind>.size(); ++pulse) {
        for (const double amplitude : {1 + 1e-7, 5.0, 1e4, 1e8}) {
            expect_right_verdicts(
                {.pulse = PulseKind(pulse), .frequency = 1e4, .amplitude = amplitude});
        }
    }
}

TEST(ShortPulse, OverturnsTheBlockByItsImpulseAlone)
{
    // A half sine of frequency Omega gives the velocity 2 a alpha / Omega: the flip is near a =
    // Omega / 2, and the block has hardly tilted.
    const Neighbours flip = neighbours_of_root({.pulse = PulseKind::half_sine, .frequency = 1e4},
                                               &HardCase::amplitude, 4900, 5100, &Truth::margin);
    expect_right_verdicts_around(flip, &HardCase::amplitude);
}

TEST(ShortPulse, OfTwoLobesOverturnsTheBlockByItsFinalTilt)
{
    const Neighbours flip =
        neighbours_of_root({.frequency = 1e4}, &HardCase::amplitude, 1e6, 1e8, &Truth::margin);
    expect_right_verdicts_around(flip, &HardCase::amplitude);
}

} // namespace
} // namespace overturn
