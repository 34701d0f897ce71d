// Sines and cosines of several cycles, and the pulse of Mavroeidis and Papageorgiou.
#include "overturn/mechanics/pulse_motion.hpp"
#include "overturn/number/digits50.hpp"
#include "support/every_pulse.hpp"
#include "support/special_values.hpp"

#include <gtest/gtest.h>

namespace overturn {
namespace {

template <class S>
PulseMotion<S> mavroeidis_papageorgiou(double gamma, double nu)
{
    return pulse_motion<S>(PulseKind::mavroeidis_papageorgiou, {.gamma = gamma, .nu = nu});
}

/// Calls visit(gamma, nu) over the range of both.
template <class Visitor>
void for_many_shapes(double gamma_step, const Visitor& visit)
{
    for (double gamma = largest_gamma; gamma > 1; gamma -= gamma_step) {
        for (int i = 0; i <= 16; ++i) {
            visit(gamma, i * pi<double>() / 16);
        }
    }
}

void expect_one_cycle_of(PulseKind kind, PulseKind cycles)
{
    const PulseMotion<double> one = pulse_motion<double>(kind);
    const PulseMotion<double> same = pulse_motion<double>(cycles, {.cycles = 1});
    EXPECT_EQ(same.begin, one.begin);
    EXPECT_EQ(same.end, one.end);
    for (int i = 0; i <= 1000; ++i) {
        const double phase = one.end * i / 1000;
        ASSERT_EQ(value_of_pulse(same, phase), value_of_pulse(one, phase)) << phase;
        ASSERT_EQ((same.series<20>(1.3, phase, 0.7)), (one.series<20>(1.3, phase, 0.7))) << phase;
    }
}

TEST(ModulatedSine, OfOneCycleIsBitIdenticalToTheOneSineAndTheOneCosine)
{
    expect_one_cycle_of(PulseKind::one_sine, PulseKind::sine);
    expect_one_cycle_of(PulseKind::one_cosine, PulseKind::cosine);
}

TEST(ModulatedSine, OfManyCyclesRepeatsItself)
{
    const PulseMotion<double> sine = pulse_motion<double>(PulseKind::sine, {.cycles = 10});
    for (int cycle = 1; cycle < 10; ++cycle) {
        for (const double phase : {0.1, 1.0, 2.5, 4.0, 6.0}) {
            // The phases are rounded to half a unit of 20 pi in the last place, 4e-15.
            EXPECT_NEAR(value_of_pulse(sine, 2 * pi<double>() * cycle + phase), std::sin(phase),
                        1e-14);
        }
    }
}

TEST(MavroeidisPapageorgiou, IsTheDerivativeOfItsVelocity)
{
    for (const double gamma : {1.01, 1.5, 2.0, 3.7, 10.0}) {
        for (const double nu : {-2.0, 0.0, 0.4, 1.5707963267948966}) {
            const PulseMotion<Digits50> motion = mavroeidis_papageorgiou<Digits50>(gamma, nu);
            const auto velocity = [&](const Digits50& phase) -> Digits50 {
                return (1 + cos(phase / gamma)) * cos(phase + nu) / 2;
            };
            const Digits50 step("1e-12");
            const auto derivative = [&](const Digits50& phase) -> Digits50 {
                return (velocity(phase + step) - velocity(phase - step)) / (2 * step);
            };
            const Digits50 factor = 2 * abs(motion.sine.scale);
            for (int i = 0; i <= 40; ++i) {
                const Digits50 phase = motion.begin + (motion.end - motion.begin) * i / 40;
                // step^2 / 6 times a third derivative below 8, and round-off of 1e-50 / step.
                EXPECT_LT(abs(value_of_pulse(motion, phase) - factor * derivative(phase)), 1e-23)
                    << "gamma " << gamma << ", nu " << nu << ", phase " << phase;
            }
        }
    }
}

TEST(MavroeidisPapageorgiou, HasAPeakOfExactlyOne)
{
    for_many_shapes(0.37, [](double gamma, double nu) {
        const PulseMotion<double> motion = mavroeidis_papageorgiou<double>(gamma, nu);
        double peak = 0;
        for (const double phase : motion.peaks) {
            peak = std::max(peak, std::abs(value_of_pulse(motion, phase)));
        }
        EXPECT_LE(peak, 1); // an amplitude of 1 lifts no block
        EXPECT_GT(peak, 1 - 4 * epsilon);
        for (int i = 0; i <= 1000; ++i) {
            const double phase = motion.begin + (motion.end - motion.begin) * i / 1000;
            // Sums and products of a few numbers up to 2.
            EXPECT_LT(std::abs(value_of_pulse(motion, phase)), 1 + 8 * epsilon);
        }
    });
}

TEST(MavroeidisPapageorgiou, HasTheSameScaleAndPeaksInFiftyDigits)
{
    for (const double gamma : {1.2, 2.0, 6.3}) {
        const PulseMotion<double> motion = mavroeidis_papageorgiou<double>(gamma, 0.8);
        const PulseMotion<Digits50> exact = mavroeidis_papageorgiou<Digits50>(gamma, 0.8);
        EXPECT_NEAR(motion.sine.scale, double(exact.sine.scale), 4 * epsilon);
        ASSERT_EQ(motion.peaks.count, exact.peaks.count);
        for (int i = 1; i + 1 < motion.peaks.count; ++i) {
            const Digits50& peak = exact.peaks.values[i];
            // The slope is rounded to a few epsilon; the curvature at these extrema exceeds 0.02.
            EXPECT_NEAR(motion.peaks.values[i], double(peak), 200 * epsilon);
            // Newton's method doubles the digits: in four steps far beyond 50.
            EXPECT_LT(abs((exact.series<2>(Digits50(1), peak, Digits50(1))[1])), 1e-47);
        }
    }
}

TEST(MavroeidisPapageorgiou, HasNoMoreLobesThanThereIsRoomFor)
{
    int most = 0;
    for_many_shapes(0.05, [&](double gamma, double nu) {
        most = std::max(most, mavroeidis_papageorgiou<double>(gamma, nu).peaks.count);
    });
    EXPECT_LE(most, most_lobes);
    EXPECT_GT(most, 20); // twice per period and at both ends
}

TEST(MavroeidisPapageorgiou, BeginsAndEndsAtZero)
{
    for_many_shapes(0.37, [](double gamma, double nu) {
        const PulseMotion<double> motion = mavroeidis_papageorgiou<double>(gamma, nu);
        // The phase of the slow sine, +-pi, is rounded to 4e-16 and multiplied by 1 / gamma < 1.
        EXPECT_NEAR(value_of_pulse(motion, motion.begin), 0, 1e-15);
        EXPECT_NEAR(value_of_pulse(motion, motion.end), 0, 1e-15);
    });
}

TEST(MavroeidisPapageorgiou, WithTheOppositePhaseIsMirroredInTime)
{
    const PulseMotion<double> motion = mavroeidis_papageorgiou<double>(2.2, 0.6);
    const PulseMotion<double> mirrored = mavroeidis_papageorgiou<double>(2.2, -0.6);
    for (const double phase : {0.0, 0.3, 2.0, 6.5}) {
        EXPECT_EQ(value_of_pulse(mirrored, -phase), -value_of_pulse(motion, phase)) << phase;
    }
}

} // namespace
} // namespace overturn
