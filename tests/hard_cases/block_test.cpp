// Extreme blocks: nearly plastic, loss-free, very slender and very stout.
#include "boundary.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace overturn {
namespace {

const double limit_of_slenderness = std::asin(std::sqrt(2.0 / 3)); ///< there r_max = 0

/// Verdicts from weak to strong pushes.
void expect_right_verdicts_at_all_amplitudes(HardCase point)
{
    for (const PulseKind pulse : {PulseKind::one_sine, PulseKind::one_cosine,
                                  PulseKind::symmetric_ricker, PulseKind::antisymmetric_ricker}) {
        for (const double amplitude : {1.02, 1.3, 2.0, 3.6, 7.0}) {
            point.pulse = pulse;
            point.amplitude = amplitude;
            expect_right_verdicts(point);
        }
    }
}

TEST(NearlyPlasticBlock, ComesToRestAfterItsFirstImpact)
{
    const HardCase point{.restitution = 1e-12, .frequency = 3, .amplitude = 2};
    const Truth truth = expect_right_verdicts(point);
    EXPECT_TRUE(truth.rested);
    EXPECT_EQ(truth.region, Region::S);
    for (const Numerics& numerics : plain_numerics()) {
        EXPECT_EQ(outcome_of(point, numerics).status, status::came_to_rest);
    }
}

TEST(NearlyPlasticBlock, HasAVerdictAtAllAmplitudes)
{
    expect_right_verdicts_at_all_amplitudes({.restitution = 1e-12});
}

TEST(NearlyPlasticBlock, IsResolvedWhereItJustOverturnsToItsOwnSide)
{
    const Neighbours flip = neighbours_of_root({.restitution = 1e-12}, &HardCase::amplitude, 3.64,
                                               3.65, &Truth::margin);
    expect_right_verdicts_around(flip, &HardCase::amplitude);
}

TEST(NearlyPlasticBlock, AtRestIsSafeHoweverSmallTheRestitution)
{
    for (const double restitution : {1e-16, 1e-24, 1e-32}) {
        expect_right_verdicts({.restitution = restitution, .amplitude = 0.5});
        expect_right_verdicts({.restitution = restitution, .amplitude = 2});
    }
}

TEST(LossFreeBlock, HasAVerdictAtAllAmplitudes)
{
    // q_min = 0: both branches of the margin meet at the top.
    expect_right_verdicts_at_all_amplitudes({.restitution = 1});
}

TEST(LossFreeBlock, IsResolvedAtTheFirstOverturningAmplitude)
{
    const Neighbours flip =
        neighbours_of_root({.restitution = 1}, &HardCase::amplitude, 1.2, 1.4, &Truth::margin);
    expect_right_verdicts_around(flip, &HardCase::amplitude);
}

TEST(LossFreeBlock, ThatRisesToTheTopIsResolvedForEitherOutcome)
{
    // After an impact it rises to near the top, where both branches of the margin are close: the
    // one that looks larger is far more sensitive to an error.
    const HardCase nonlinear{.pulse = PulseKind::antisymmetric_ricker,
                             .slenderness = 0.2,
                             .restitution = 1,
                             .frequency = 1.7307692307692308,
                             .amplitude = 2.3280001807292083,
                             .window = 2};
    HardCase linear = nonlinear;
    linear.theory = Theory::linear;
    linear.frequency = 1.064102564102564;
    linear.amplitude = 1.5963486754474812;
    for (const HardCase& start : {nonlinear, linear}) {
        for (int i = -20; i <= 20; ++i) {
            HardCase point = start;
            point.amplitude *= 1 + 1e-5 * i;
            expect_right_verdicts(point);
        }
    }
}

TEST(Block, WithRestitutionAboveTheMaximumHasAVerdictAtAllAmplitudes)
{
    // r above r_max = 0.91.
    for (const double restitution : {0.92, 0.96, 1 - 0x1p-53}) {
        expect_right_verdicts_at_all_amplitudes({.restitution = restitution});
    }
}

TEST(Block, OfAnySlendernessHasAVerdictAtAllAmplitudes)
{
    for (const double alpha : {1e-6, 1.0, 1.5}) {
        for (const double restitution : {0.1, 0.9}) {
            expect_right_verdicts_at_all_amplitudes(
                {.slenderness = alpha, .restitution = restitution});
        }
    }
}

TEST(Block, OfAnySlendernessIsResolvedWhereTheVerdictFlips)
{
    for (const double alpha : {1e-6, 1.0, 1.5}) {
        // From not lifted to overturned: there is a flip in between.
        const Neighbours flip = neighbours_of_root({.slenderness = alpha, .restitution = 0.5},
                                                   &HardCase::amplitude, 1, 10, &Truth::margin);
        expect_right_verdicts_around(flip, &HardCase::amplitude);
    }
}

TEST(Block, OfLimitingSlendernessHasAVerdictAtAllAmplitudes)
{
    // r_max is about 2e-14, 2e-22, and determined by the last bits of alpha.
    for (const double below : {1e-7, 1e-11, 1e-15}) {
        const double alpha = limit_of_slenderness - below;
        const double restitution = largest_restitution(alpha);
        ASSERT_GT(restitution, 0);
        expect_right_verdicts_at_all_amplitudes({.slenderness = alpha, .restitution = restitution});
    }
}

} // namespace
} // namespace overturn
