// The largest and smallest values accepted in a job file give a verdict or a flag with the reason.
#include "verdicts.hpp"

#include "support/untrapped_floating_point.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace overturn {
namespace {

constexpr double largest = std::numeric_limits<double>::max();
constexpr double smallest = std::numeric_limits<double>::denorm_min();

/// Numbers may overflow, and steps may be too small for a double.
constexpr Allowance anything_with_a_flag{
    .most_steps = 1 << 20, .undecided = true, .unresolved = true};

class LargestValues : public testing::Test {
    UntrappedFloatingPoint untrapped_;
};

TEST_F(LargestValues, OfTheFrequencyDoNotMoveTheBlock)
{
    for (const double frequency : {1e16, 1e100, 1e300}) {
        const Truth truth = expect_right_verdicts({.frequency = frequency});
        EXPECT_EQ(truth.region, Region::S);
    }
    expect_right_verdicts({.frequency = largest}, anything_with_a_flag);
}

TEST_F(LargestValues, OfThePulseLengthOverturnTheBlockWithCertainty)
{
    // The block overturns although its phase does not change in doubles.
    for (const double frequency : {1e-5, 1e-10, 1e-17}) {
        const Truth truth = expect_right_verdicts({.frequency = frequency});
        EXPECT_EQ(truth.region, Region::F_minus);
    }
}

TEST_F(LargestValues, OfThePulseLengthMayRemainUnresolved)
{
    // 50 digits do not distinguish the phase of overturning from that of uplift.
    expect_right_verdicts({.frequency = 1e-40}, {.unresolved = true});
    expect_right_verdicts({.frequency = 1e-100}, {.unresolved = true});
}

TEST_F(LargestValues, OfThePulseLengthGiveAnErrorThatIsFiniteOrInfinite)
{
    for (const double frequency : {1e-300, smallest}) {
        expect_right_verdicts({.frequency = frequency}, {.unresolved = true});
    }
}

TEST_F(LargestValues, OfTheAmplitudeOverturnTheBlock)
{
    const Truth truth = expect_right_verdicts({.amplitude = 1e16});
    EXPECT_EQ(truth.region, Region::F_minus);
    // In doubles the powers of a step overflow.
    const Truth larger = expect_right_verdicts({.amplitude = 1e100}, {.undecided = true});
    EXPECT_EQ(larger.region, Region::F_minus);
}

TEST_F(LargestValues, OfTheAmplitudeOverflowAndSetAFlag)
{
    for (const double amplitude : {1e155, 1e300, largest}) {
        for (const Numerics& numerics : plain_numerics()) {
            expect_right_verdict({.amplitude = amplitude}, numerics, {}, anything_with_a_flag);
        }
    }
}

TEST_F(LargestValues, OfTheAmplitudeFailWithAnInfiniteErrorInFiftyDigits)
{
    expect_right_verdict({.amplitude = 1e300},
                         {.method = Method::taylor, .tolerance = 1e-4, .resolve = true}, {},
                         anything_with_a_flag);
}

TEST_F(LargestValues, OfAmplitudeAndFrequencyTogetherCancel)
{
    // The block gets the velocity a alpha / Omega, and moves a alpha / Omega^2.
    for (const double size : {1e16, 1e100}) {
        const Truth truth =
            expect_right_verdicts({.frequency = size, .amplitude = size}, {.undecided = true});
        EXPECT_EQ(truth.region, Region::S);
    }
    expect_right_verdicts({.frequency = 1e300, .amplitude = 1e300}, anything_with_a_flag);
}

TEST_F(LargestValues, OfTheAmplitudeWithTheLongestPulseGiveAVerdictOrAFlag)
{
    for (const auto& [frequency, amplitude] :
         {std::array{1e-17, 1e16}, std::array{1e-100, 1e100}, std::array{1e100, 1e-100}}) {
        expect_right_verdicts({.frequency = frequency, .amplitude = amplitude},
                              anything_with_a_flag);
    }
}

TEST_F(LargestValues, OfTheLossAtAnImpactLeaveABlockAtRestSafe)
{
    for (const double restitution : {1e-60, 1e-100, 1e-300}) {
        expect_right_verdicts({.restitution = restitution, .amplitude = 0.5});
    }
}

TEST_F(LargestValues, OfTheSlendernessGiveAVerdict)
{
    for (const double alpha : {1e-100, 1e-50, 1.57}) {
        for (const double amplitude : {0.5, 1.2, 2.0, 1e3}) {
            expect_right_verdicts(
                {.slenderness = alpha, .restitution = 0.5, .amplitude = amplitude});
        }
    }
    // A block so stout that doubles need a million steps to lift it: the push is 1e16 g.
    const HardCase point{
        .slenderness = std::nextafter(std::acos(0.0), 0), .restitution = 0.5, .amplitude = 1.2};
    const Truth truth = expect_right_verdicts(point, {.most_steps = 1 << 20, .undecided = true});
    EXPECT_EQ(truth.region, Region::F_minus);
}

TEST_F(LargestValues, OfTheHeightGiveARightVerdictOrAFlag)
{
    // The smallest slenderness allowed in a job: squares of rates are near the smallest double.
    const HardCase point{.slenderness = 1e-100, .restitution = 0.5, .amplitude = 2};
    const Truth truth = expect_right_verdicts(point, anything_with_a_flag);
    EXPECT_TRUE(truth.settled);
    for (const Numerics& numerics : plain_numerics()) {
        const Outcome outcome = outcome_of(point, numerics);
        EXPECT_TRUE(outcome.region == Region::undecided ||
                    is_safe(outcome.region) == is_safe(truth.region));
    }
}

TEST_F(LargestValues, OfTheHeightGiveAFiniteMarginOrAFlag)
{
    const Numerics taylor{.method = Method::taylor, .tolerance = 1e-4};
    const HardCase highest{.slenderness = 1e-100, .restitution = 0.5, .amplitude = 2};
    expect_right_verdict(highest, taylor, {}, anything_with_a_flag);
    // It overturns with -theta'^2 / q_max of 1e200.
    const HardCase falls{.pulse = PulseKind::rectangular,
                         .slenderness = 1e-100,
                         .restitution = 0.5,
                         .frequency = 1e-4,
                         .amplitude = 2};
    expect_right_verdict(falls, {.method = Method::rk45, .tolerance = 1e-4}, {},
                         anything_with_a_flag);
}

TEST_F(LargestValues, OfTheWindowGiveAVerdict)
{
    for (const PulseKind pulse : {PulseKind::symmetric_ricker, PulseKind::antisymmetric_ricker}) {
        for (const double window : {1e-300, 1e-100, 1e-16, 8.0}) {
            for (const double amplitude : {0.5, 3.0, 1e3, 1e16}) {
                expect_right_verdicts({.pulse = pulse, .amplitude = amplitude, .window = window});
            }
        }
        // A million steps in each run, of which there are fewer.
        for (const Numerics& numerics :
             {Numerics{.method = Method::rk45},
              Numerics{.method = Method::taylor, .tolerance = 1e-4, .resolve = true}}) {
            expect_right_verdict({.pulse = pulse, .window = smallest}, numerics, {},
                                 anything_with_a_flag);
        }
    }
}

} // namespace
} // namespace overturn
