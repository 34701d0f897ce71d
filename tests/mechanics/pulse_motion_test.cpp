#include "overturn/mechanics/pulse_motion.hpp"
#include "overturn/number/digits50.hpp"
#include "support/every_pulse.hpp"

#include <gtest/gtest.h>

namespace overturn {
namespace {

INSTANTIATE_TEST_SUITE_P(Pulse, EveryPulse, every_pulse(), pulse_test_name);

constexpr int samples = 20000;

/// Evenly spaced phases of the pulse.
double phase_number(int i, const PulseMotion<double>& motion)
{
    return motion.begin + (motion.end - motion.begin) * i / samples;
}

TEST_P(EveryPulse, HasPeakOne)
{
    const PulseMotion<double> pulse = motion(1.0);
    double peak = 0;
    for (int i = 0; i <= samples; ++i) {
        peak = std::max(peak, std::abs(value_of_pulse(pulse, phase_number(i, pulse))));
    }
    // The grid misses the peak by (phase step)^2 / 2 = 1e-7; the antisymmetric Ricker wavelet is
    // higher by 8.6e-5 with the paper's factor 1.38.
    EXPECT_NEAR(peak, GetParam() == PulseKind::antisymmetric_ricker ? 1.000086 : 1.0, 1e-6);
}

TEST_P(EveryPulse, HasDerivativesBelowTheirBounds)
{
    const PulseMotion<double> pulse = motion(1.0);
    double factorial = 1;
    for (int order = 1; order <= 4; ++order) {
        factorial *= order;
        double largest = 0;
        for (int i = 0; i < samples; ++i) {
            const auto f = pulse.series<5>(1.0, phase_number(i, pulse), 1.0);
            largest = std::max(largest, factorial * std::abs(f[std::size_t(order)]));
        }
        const double bound = pulse.largest_derivative(order);
        EXPECT_LE(largest, bound * (1 + 1e-14)) << order;
        // The harmonics of a modulated sine are not all at their peaks at the same phase, and the
        // bound of a wavelet is one of all orders.
        EXPECT_GE(largest, 0.25 * bound) << order;
    }
}

TEST_P(EveryPulse, HasNoExtremumExceptItsPeaks)
{
    const PulseMotion<double> pulse = motion(1.0);
    const double step = phase_number(1, pulse) - pulse.begin;
    for (int i = 1; i < samples; ++i) {
        const double phase = phase_number(i, pulse);
        const double here = value_of_pulse(pulse, phase);
        const double before = here - value_of_pulse(pulse, phase - step);
        const double after = value_of_pulse(pulse, phase + step) - here;
        if (before * after < 0) {
            const bool known =
                std::any_of(pulse.peaks.begin(), pulse.peaks.end(),
                            [&](double peak) { return std::abs(peak - phase) <= step; });
            EXPECT_TRUE(known) << "turns at " << phase;
        }
    }
}

TEST_P(EveryPulse, HasNoLargerSecondDerivativeThanItsBound)
{
    // The bound of low_bounces.hpp. A second difference is the mean of f'' over the two steps; its
    // rounding error is 4 epsilon / step^2, at most 1e-8.
    const PulseMotion<double> pulse = motion(1.0);
    const double step = phase_number(1, pulse) - pulse.begin;
    for (int i = 0; i + 2 <= samples; ++i) {
        const double first = phase_number(i, pulse);
        const double last = phase_number(i + 2, pulse);
        if (first < pulse.kink && pulse.kink < last) {
            continue;
        }
        const double difference = value_of_pulse(pulse, first) -
                                  2 * value_of_pulse(pulse, phase_number(i + 1, pulse)) +
                                  value_of_pulse(pulse, last);
        ASSERT_LT(std::abs(difference), pulse.largest_curvature() * step * step)
            << "phase " << first;
    }
}

/// The first phase of each interval with amplitude |f| > 1, by sampling the whole pulse.
std::vector<double> spells(const PulseMotion<double>& pulse, double amplitude)
{
    std::vector<double> result;
    bool lifted = false;
    for (int i = 0; i <= samples; ++i) {
        const double phase = phase_number(i, pulse);
        const bool lifts = amplitude * std::abs(value_of_pulse(pulse, phase)) > 1;
        if (lifts && !lifted) {
            result.push_back(phase);
        }
        lifted = lifts;
    }
    return result;
}

template <class S>
PerLobe<S> uplift_phases(const PulseMotion<S>& motion, const S& amplitude)
{
    return uplift_phases(motion, flanks_of(motion), {amplitude, amplitude});
}

TEST_P(EveryPulse, UpliftsAreWhereTheGroundFirstExceedsTheThreshold)
{
    for (const double window : {0.05, 0.15, 0.3, 0.6, 1.0, 3.0}) {
        const PulseMotion<double> pulse = motion(window);
        for (const double amplitude : {0.5, 1.003, 1.3, 2.1, 2.4, 9.0, 200.0}) {
            std::vector<double> ours;
            for (const double phase : uplift_phases(pulse, amplitude)) {
                if (std::isfinite(phase)) {
                    ours.push_back(phase);
                }
            }
            const std::vector<double> seen = spells(pulse, amplitude);
            ASSERT_EQ(ours.size(), seen.size())
                << "amplitude " << amplitude << ", window " << window;
            for (std::size_t i = 0; i < seen.size(); ++i) {
                // The grid detects an uplift at most one step late.
                EXPECT_LE(ours[i], seen[i]);
                const double step = phase_number(1, pulse) - pulse.begin;
                EXPECT_GE(ours[i], seen[i] - 1.001 * step);
            }
        }
    }
}

TEST_P(EveryPulse, UpliftsInDoubleAndFiftyDigitsAgree)
{
    const auto in_double = uplift_phases(motion(1.0), 3.0);
    const auto in_digits = uplift_phases(motion(Digits50(1)), Digits50(3));
    ASSERT_EQ(in_double.count, in_digits.count);
    for (int i = 0; i < in_double.count; ++i) {
        const double ours = in_double.values[i];
        const Digits50& exact = in_digits.values[i];
        if (std::isinf(ours)) {
            EXPECT_TRUE(isinf(exact));
            continue;
        }
        // 4 units in the last place of 2 pi; the inverse of f is well conditioned at f = 1/3.
        EXPECT_NEAR(ours, double(exact), 4e-15);
    }
}

double first_uplift(PulseKind pulse, double amplitude)
{
    return uplift_phases(pulse_motion<double>(pulse), amplitude).values[0];
}

TEST(UpliftPhases, OfASineEqualsItsClosedForm)
{
    EXPECT_DOUBLE_EQ(first_uplift(PulseKind::one_sine, 4.0), std::asin(0.25));
    EXPECT_DOUBLE_EQ(first_uplift(PulseKind::half_sine, 1.25), std::asin(0.8));
    EXPECT_EQ(first_uplift(PulseKind::one_cosine, 1.25), 0);
    EXPECT_DOUBLE_EQ(first_uplift(PulseKind::triangular, 1.25), 0.4 * pi<double>());
}

TEST(UpliftPhases, AnAmplitudeOfOneDoesNotExceedTheThreshold)
{
    EXPECT_EQ(first_uplift(PulseKind::one_sine, 1.0), std::numeric_limits<double>::infinity());
    EXPECT_EQ(first_uplift(PulseKind::one_cosine, 1.0), std::numeric_limits<double>::infinity());
    EXPECT_EQ(first_uplift(PulseKind::rectangular, 1.0), std::numeric_limits<double>::infinity());
    EXPECT_EQ(first_uplift(PulseKind::triangular, 1.0), std::numeric_limits<double>::infinity());
}

TEST(UpliftPhases, SideLobeOfTheSymmetricRickerLiftsFromItsOwnPeakOn)
{
    const double side_peak = 2 * std::exp(-1.5); // |f| at x^2 = 3/2
    EXPECT_FALSE(std::isfinite(first_uplift(PulseKind::symmetric_ricker, 0.999 / side_peak)));
    EXPECT_TRUE(std::isfinite(first_uplift(PulseKind::symmetric_ricker, 1.001 / side_peak)));
}

TEST(Wavelets, HaveTailsThatEndBelowAnyLevel)
{
    for (const PulseKind kind : {PulseKind::symmetric_ricker, PulseKind::antisymmetric_ricker}) {
        const PulseMotion<double> pulse = pulse_motion<double>(kind);
        for (const double level : {1e-12, 1e-19, 1e-30, 1e-60}) {
            const double end = end_of_tail(kind, std::log2(level));
            for (const double beyond : {1.0, 1.1, 2.0, 3.0}) {
                EXPECT_LE(std::abs(value_of_pulse(pulse, end * beyond)), level * 1.01) << level;
            }
            EXPECT_GT(std::abs(value_of_pulse(pulse, end * 0.95)), level); // and not much earlier
        }
        EXPECT_GT(end_of_tail(kind, 0.0), 8); // beyond every lobe: the last ends at 4
    }
}

} // namespace
} // namespace overturn
