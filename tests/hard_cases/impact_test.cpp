// Grazing impacts, pairs of impacts, and impacts at critical moments.
#include "boundary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace overturn {
namespace {

/// Grazing impacts between neighbouring amplitudes: two impacts below, none above.
const std::vector<Neighbours>& grazes()
{
    static const std::vector<Neighbours> found = [] {
        struct Line {
            HardCase point;
            double low, high, impacts;
        };
        std::vector<Neighbours> all;
        for (const Line& line :
             {Line{{.pulse = PulseKind::one_cosine}, 1.233, 1.2332, 4},
              Line{{.pulse = PulseKind::symmetric_ricker, .frequency = 4}, 2.38, 2.39, 6},
              Line{{.pulse = PulseKind::symmetric_ricker, .frequency = 4}, 2.47, 2.48, 4}}) {
            const auto touches = [&](const Truth& truth) { return truth.impacts == line.impacts; };
            all.push_back(neighbours_of_change(line.point, &HardCase::amplitude, line.low,
                                               line.high, touches));
        }
        return all;
    }();
    return found;
}

/// Expects every run with a finite error to have the right number of impacts: a finite error means
/// that no event is in doubt.
void expect_impacts_counted(const HardCase& point)
{
    const double impacts = truth_of(point).impacts;
    for (const Numerics& numerics : plain_numerics()) {
        const Outcome outcome = outcome_of(point, numerics);
        if (std::isfinite(outcome.error)) {
            EXPECT_EQ(outcome.impacts, impacts)
                << point << ", " << name_of(numerics.method) << " at " << numerics.tolerance;
        }
    }
}

TEST(GrazingImpact, IsTwoImpactsOrNoneCountedByEveryRunAndHasTheRightVerdictOnBothSides)
{
    for (const Neighbours& graze : grazes()) {
        EXPECT_EQ(truth_of(graze.below).impacts, truth_of(graze.above).impacts + 2);
        expect_right_verdicts_around(graze, &HardCase::amplitude);
        // The two impacts would be within one step: a tenth of a unit of time apart at the larger
        // distances, a millionth at the smaller ones.
        for (const double distance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12}) {
            HardCase touching = graze.below;
            touching.amplitude *= 1 - distance;
            expect_impacts_counted(touching);
            HardCase passing = graze.above;
            passing.amplitude *= 1 + distance;
            expect_impacts_counted(passing);
        }
        // Ensures that this does not pass only because of infinite errors.
        HardCase point = graze.below;
        point.amplitude *= 1 - 1e-6;
        for (const Method method : {Method::rk45, Method::taylor}) {
            const Outcome outcome = outcome_of(point, {.method = method, .tolerance = 1e-12});
            EXPECT_TRUE(std::isfinite(outcome.error)) << point;
        }
    }
}

TEST(GrazingImpact, ThatDecidesTheVerdictIsResolved)
{
    // Under a slow pulse, one touch more or less decides between safe and overturning: the margin
    // changes its sign in a jump within this line.
    const Neighbours flip =
        neighbours_of_root({.frequency = 0.5}, &HardCase::amplitude, 1.046, 1.048, &Truth::margin);
    expect_right_verdicts_around(flip, &HardCase::amplitude);
}

TEST(Impact, WhereTheGroundAccelerationCrossesTheUpliftValueHasTheRightVerdict)
{
    // There the restoring force on the new side vanishes: the block is balanced from the impact on.
    const Neighbours impact =
        neighbours_of_root({}, &HardCase::amplitude, 1.3, 2.3, angle_at_second_uplift_value);
    expect_right_verdicts_around(impact, &HardCase::amplitude);
}

TEST(Impact, WhereTheGroundAccelerationCrossesTheUpliftValueIsResolvedWhereTheVerdictFlips)
{
    // The impact does not depend on r, so there is an r at which the block just overturns after it.
    const HardCase point = neighbours_of_root({.frequency = 2}, &HardCase::amplitude, 1.25, 1.4,
                                              angle_at_second_uplift_value)
                               .below;
    const Neighbours flip =
        neighbours_of_root(point, &HardCase::restitution, 0.2, 0.5, &Truth::margin);
    expect_right_verdicts_around(flip, &HardCase::restitution);
    expect_right_verdicts_around(flip, &HardCase::amplitude);
}

TEST(Impact, AtTheVeryEndOfAPushToOneSideHasTheRightVerdict)
{
    const Neighbours impact = neighbours_of_root({.pulse = PulseKind::half_sine},
                                                 &HardCase::amplitude, 1.14, 1.15, &Truth::angle);
    expect_right_verdicts_around(impact, &HardCase::amplitude);
}

} // namespace
} // namespace overturn
