// End states on a boundary between two regions, to the last bits of a double.
#include "boundary.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace overturn {
namespace {

void expect_regions(const Neighbours& boundary, Region below, Region above)
{
    const Truth first = truth_of(boundary.below);
    const Truth second = truth_of(boundary.above);
    EXPECT_TRUE(first.settled);
    EXPECT_TRUE(second.settled);
    EXPECT_EQ(first.region, below);
    EXPECT_EQ(second.region, above);
}

TEST(VerdictBoundary, OnTheSeparatrixBelowTheTopIsResolved)
{
    const Neighbours flip =
        neighbours_of_root({}, &HardCase::amplitude, 1.38, 1.39, &Truth::margin);
    expect_regions(flip, Region::S, Region::U0_plus);
    expect_right_verdicts_around(flip, &HardCase::amplitude);
}

TEST(VerdictBoundary, OnTheSeparatrixBeyondTheTopIsResolved)
{
    // The block is beyond its balance and moves back: too slowly, or just fast enough.
    const Neighbours flip =
        neighbours_of_root({}, &HardCase::amplitude, 3.64, 3.65, &Truth::margin);
    expect_regions(flip, Region::S_plus, Region::U0_minus);
    expect_right_verdicts_around(flip, &HardCase::amplitude);
}

TEST(VerdictBoundary, WhereTheNextImpactJustDissipatesEnoughEnergyIsResolved)
{
    // q0 = q_min, the other branch of the margin.
    const Neighbours flip =
        neighbours_of_root({}, &HardCase::amplitude, 3.59, 3.60, &Truth::margin);
    expect_regions(flip, Region::U1_plus, Region::S_plus);
    expect_right_verdicts_around(flip, &HardCase::amplitude);
}

TEST(VerdictBoundary, OnTheSeparatrixIsResolvedAlongTheFrequency)
{
    const HardCase point{.pulse = PulseKind::one_cosine, .amplitude = 11.139};
    const Neighbours flip =
        neighbours_of_root(point, &HardCase::frequency, 2.99, 3.01, &Truth::margin);
    expect_right_verdicts_around(flip, &HardCase::frequency);
}

TEST(VerdictBoundary, OnTheSeparatrixIsResolvedInTheLinearTheory)
{
    const HardCase point{
        .theory = Theory::linear, .slenderness = 0.25, .restitution = 0.81, .frequency = 5};
    // Published: 3.01, 6.32 and 7.18.
    for (const double amplitude : {3.0186, 6.318071, 7.168129}) {
        const Neighbours flip = neighbours_of_root(point, &HardCase::amplitude, amplitude - 1e-4,
                                                   amplitude + 1e-4, &Truth::margin);
        expect_right_verdicts_around(flip, &HardCase::amplitude);
    }
}

TEST(VerdictBoundary, BetweenSafeWithoutAndSafeAfterAnImpactKeepsTheVerdict)
{
    // q0 = 0 with the block moving towards the ground.
    const HardCase point{.pulse = PulseKind::antisymmetric_ricker, .frequency = 4, .amplitude = 3};
    const Neighbours change =
        neighbours_of_root(point, &HardCase::window, 0.30, 0.32, &Truth::within_arc);
    expect_regions(change, Region::S, Region::S_plus);
    expect_right_verdicts_around(change, &HardCase::window);
}

TEST(VerdictBoundary, ATiltOfAlphaKeepsTheVerdict)
{
    const Neighbours unsafe =
        neighbours_of_root({}, &HardCase::amplitude, 3.28, 3.29, &Truth::below_top);
    expect_regions(unsafe, Region::U1_plus, Region::U1_plus);
    expect_right_verdicts_around(unsafe, &HardCase::amplitude);

    const Neighbours safe = neighbours_of_root({.restitution = 0.3, .frequency = 2},
                                               &HardCase::amplitude, 2.25, 2.26, &Truth::below_top);
    expect_regions(safe, Region::S_plus, Region::S_plus);
    expect_right_verdicts_around(safe, &HardCase::amplitude);
}

TEST(VerdictBoundary, AnImpactAtTheVeryEndKeepsTheVerdictOfASafeBlock)
{
    const Neighbours impact = neighbours_of_root({.restitution = 0.3, .frequency = 2},
                                                 &HardCase::amplitude, 2, 2.01, &Truth::angle);
    expect_regions(impact, Region::S, Region::S_plus);
    expect_right_verdicts_around(impact, &HardCase::amplitude);
}

TEST(VerdictBoundary, AnImpactAtTheVeryEndKeepsTheVerdictOfAnUnsafeBlock)
{
    // Beyond this point, the block overturns after an impact that follows the pulse.
    const Neighbours impact =
        neighbours_of_root({}, &HardCase::amplitude, 2.38, 2.39, &Truth::angle);
    expect_regions(impact, Region::U0_plus, Region::U1_plus);
    expect_right_verdicts_around(impact, &HardCase::amplitude);
}

TEST(VerdictBoundary, AnImpactAtTheVeryEndThatLeavesTheBlockOnTheSeparatrixIsResolved)
{
    // Before its first impact nothing depends on r; with r = q_max / theta'^2 the impact leaves the
    // block with the velocity that just overturns it. Both boundaries coincide to the last bits.
    const Neighbours impact =
        neighbours_of_root({}, &HardCase::amplitude, 2.38, 2.39, &Truth::angle);
    for (HardCase point : {impact.below, impact.above}) {
        const double topples = 2 * std::sin(point.slenderness / 2);
        const double ratio = topples / truth_of(impact.above).velocity;
        const double r = ratio * ratio;
        const Neighbours corner =
            neighbours_of_root(point, &HardCase::restitution, r - 1e-6, r + 1e-6, &Truth::margin);
        expect_right_verdicts_around(corner, &HardCase::restitution);
        expect_right_verdicts_around(corner, &HardCase::amplitude);
    }
}

TEST(VerdictBoundary, ABlockWithoutVelocityAtTheEndKeepsItsVerdict)
{
    const Neighbours unsafe =
        neighbours_of_root({}, &HardCase::amplitude, 4.09, 4.10, &Truth::velocity);
    expect_regions(unsafe, Region::U0_minus, Region::U0_minus);
    expect_right_verdicts_around(unsafe, &HardCase::amplitude);

    const Neighbours safe = neighbours_of_root({.pulse = PulseKind::half_sine},
                                               &HardCase::amplitude, 1.35, 1.36, &Truth::velocity);
    expect_regions(safe, Region::S, Region::S);
    expect_right_verdicts_around(safe, &HardCase::amplitude);
}

/// A pulse that balances the block: theta = alpha and theta' = 0 at its end, to the last bits.
struct Balance {
    PulseKind pulse;
    double frequency;
    double amplitude;
};

TEST(VerdictBoundary, ABlockWithoutVelocityOnTheTopIsResolved)
{
    // A root of two equations in two coordinates, found by Newton's method.
    for (const Balance& balance :
         {Balance{PulseKind::one_cosine, 1.8709310274428315, 3.9675278518464667},
          Balance{PulseKind::one_cosine, 2.1896045356857314, 1.4505694292189482},
          Balance{PulseKind::symmetric_ricker, 2.7565858437422834, 2.6139099886826922},
          Balance{PulseKind::antisymmetric_ricker, 1.8381775955138158, 1.2393618201735408}}) {
        const HardCase point{
            .pulse = balance.pulse, .frequency = balance.frequency, .amplitude = balance.amplitude};
        const Truth truth = truth_of(point);
        // A few last bits of the coordinates, which the motion amplifies at most a hundredfold.
        EXPECT_LT(std::abs(truth.below_top), 1e-14);
        EXPECT_LT(std::abs(truth.velocity), 1e-14);
        expect_right_verdicts_around({point, point}, &HardCase::amplitude);
        expect_right_verdicts_around({point, point}, &HardCase::frequency);
    }
}

TEST(VerdictBoundary, OverturningAtTheVeryEndKeepsTheVerdict)
{
    const Neighbours fall = neighbours_of_change({}, &HardCase::amplitude, 9.38, 9.39,
                                                 [](const Truth& truth) { return truth.fell; });
    expect_regions(fall, Region::U0_minus, Region::F_minus);
    expect_right_verdicts_around(fall, &HardCase::amplitude);
}

} // namespace
} // namespace overturn
