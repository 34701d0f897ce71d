// Slow pulses that hardly lift the block: errors that are small at uplift are 1e6 to 1e15 times
// larger at the end. The bound of each of these points was once exceeded by its error, with a wrong
// verdict.
#include "verdicts.hpp"

#include <gtest/gtest.h>

namespace overturn {
namespace {

TEST(Amplification, OverOneLongStepIsPartOfTheError)
{
    const HardCase half_sine{.pulse = PulseKind::half_sine,
                             .theory = Theory::linear,
                             .slenderness = 0.2190266147968824,
                             .restitution = 0.6791215840390759,
                             .frequency = 0.07738004675203289};
    for (const double amplitude : {1.002989367514313, 1.0029893666116225}) {
        HardCase point = half_sine;
        point.amplitude = amplitude;
        expect_right_verdicts(point);
    }
    expect_right_verdicts({.pulse = PulseKind::one_sine,
                           .theory = Theory::linear,
                           .slenderness = 0.10404824387895703,
                           .restitution = 0.7977967923716414,
                           .frequency = 0.14174589673876217,
                           .amplitude = 1.0098991655281153});
    expect_right_verdicts({.pulse = PulseKind::one_cosine,
                           .theory = Theory::linear,
                           .slenderness = 0.07801151972840942,
                           .restitution = 0.8444568454495585,
                           .frequency = 0.1041095381152212,
                           .amplitude = 1.0054021134247213});
}

TEST(Amplification, OfImpactsOverALongTimeIsPartOfTheError)
{
    expect_right_verdicts({.pulse = PulseKind::one_cosine,
                           .slenderness = 0.2972200856338059,
                           .restitution = 0.6468045609643587,
                           .frequency = 0.07631388066955715,
                           .amplitude = 1.0027857893189558});
}

TEST(Amplification, OfSystematicRoundOffIsPartOfTheError)
{
    // The peak of the pulse is rounded once, which makes every step push too hard.
    for (const double frequency :
         {0.15277345754571803, 0.15277345754571806, 0.1527734575457181, 0.15277345754571825}) {
        expect_right_verdicts({.pulse = PulseKind::symmetric_ricker,
                               .theory = Theory::linear,
                               .slenderness = 0.2012045907792478,
                               .restitution = 0.8738038594108882,
                               .frequency = frequency,
                               .amplitude = 1.0169943886935842});
    }
    for (const double frequency : {0.10064001335369872, 0.10067400725881652, 0.10070800116393433}) {
        expect_right_verdicts({.pulse = PulseKind::rectangular,
                               .slenderness = 0.49354261318154147,
                               .restitution = 0.5,
                               .frequency = frequency,
                               .amplitude = 1.0000000000000042});
    }
}

TEST(Amplification, InFiftyDigitsKeepsTheErrorWithinItsBound)
{
    // Eight impacts that also amplify the errors of locating them.
    const HardCase point{.pulse = PulseKind::antisymmetric_ricker,
                         .theory = Theory::linear,
                         .slenderness = 0.30232279446291216,
                         .restitution = 0.5913205839355178,
                         .frequency = 0.2930857843949017,
                         .amplitude = 1.044489325114106,
                         .window = 1.4735407876265727};
    expect_right_verdicts(point);
    // From tolerances of 1e-36 and 1e-42, and from another program.
    EXPECT_NEAR(truth_of(point).margin, -0.002851210435169135554626, 4e-19);
}

TEST(Amplification, ThatIsReversedOnTheWayDownEndsBelowTheRoundOffOfTheBound)
{
    // Twice from top to top without loss: errors grow to a tenth of alpha, and shrink to less than
    // the round-off of a bound in doubles.
    expect_right_verdicts({.pulse = PulseKind::symmetric_ricker,
                           .theory = Theory::linear,
                           .slenderness = 0.051923607403811856,
                           .restitution = 1,
                           .frequency = 0.4462874609702015,
                           .amplitude = 1.0948520953270426,
                           .window = 4.8589922388857376});
}

TEST(Amplification, OfThousandsOfBouncesIsKnownInDoubles)
{
    // Bounces after a first lobe that hardly lifts, and after one of two that hardly lift. In long
    // double both are known to 1e-6; the bound of doubles is that times a few thousand.
    const HardCase side_lobe{.pulse = PulseKind::symmetric_ricker,
                             .slenderness = 0.024413150530126933,
                             .restitution = 1,
                             .frequency = 6.3,
                             .amplitude = 2.2409966655330615};
    const HardCase two_lobes{
        .slenderness = 0.026, .restitution = 1, .frequency = 0.05, .amplitude = 1.0001156};
    for (const HardCase& point : {side_lobe, two_lobes}) {
        const Outcome outcome = expect_right_verdict(
            point, {.method = Method::taylor, .tolerance = 1e-4, .resolve = true}, {},
            {.most_steps = 20000});
        EXPECT_EQ(outcome.region, Region::S);
        EXPECT_GT(outcome.impacts, 10000);
        EXPECT_LT(outcome.error, 1e-3 * outcome.margin);
        const Outcome finest = outcome_of(point, {.method = Method::taylor, .tolerance = 1e-13});
        EXPECT_LE(std::abs(finest.margin - outcome.margin), finest.error + outcome.error);
        EXPECT_LT(finest.error, 1e-3 * finest.margin);
    }
}

TEST(Amplification, OfThousandsOfImpactsIsPartOfTheErrorOfRungeKuttaSteps)
{
    // Locating an impact moves the end of its step. Omitting this from the linearised motion was
    // enough to convert errors of the time into errors of the energy and back, and to make the
    // bound negative.
    HardCase linear{.pulse = PulseKind::symmetric_ricker,
                    .theory = Theory::linear,
                    .slenderness = 1.1,
                    .restitution = 0.999,
                    .frequency = 0.3070407213106455,
                    .amplitude = 1.0021419320614147};
    HardCase nonlinear{.pulse = PulseKind::symmetric_ricker,
                       .slenderness = 0.1745716,
                       .restitution = 0.999,
                       .frequency = 0.19687717211015124,
                       .amplitude = 1.002276791226567};
    int bounded = 0;
    for (HardCase point : {linear, nonlinear}) {
        const double amplitude = point.amplitude;
        for (int i = -20; i < 20; ++i) {
            point.amplitude = amplitude * (1 + 5e-7 * i);
            const Outcome truth = outcome_of(point, {.method = Method::taylor, .tolerance = 1e-13});
            EXPECT_LT(truth.error, 1e-6);
            for (const double tolerance : {1e-4, 1e-6, 1e-9}) {
                const Outcome found =
                    outcome_of(point, {.method = Method::rk45, .tolerance = tolerance});
                EXPECT_LE(std::abs(found.margin - truth.margin), found.error + truth.error)
                    << point << ", " << tolerance;
                bounded += std::isfinite(found.error);
            }
        }
    }
    EXPECT_GT(bounded, 80); // at 1e-9 at least
}

TEST(Uplift, OccursOnceOnAFlank)
{
    // Lifted by a last bit, the block is down again before a step of 1e-4 detects its rise.
    for (const double amplitude : {1 + 0x1p-52, 1 + 1e-12}) {
        const HardCase point{.pulse = PulseKind::one_cosine,
                             .slenderness = 0.4675,
                             .restitution = 0.5,
                             .frequency = 0.2858,
                             .amplitude = amplitude};
        expect_right_verdicts(point);
        for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
            EXPECT_LT(outcome_of(point, {.method = Method::rk45, .tolerance = tolerance}).steps,
                      50);
        }
    }
}

} // namespace
} // namespace overturn
