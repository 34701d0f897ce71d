#include "overturn/mechanics/pulse.hpp"
#include "overturn/number/digits50.hpp"

#include <gtest/gtest.h>

namespace overturn {
namespace {

template <class Pulse>
class EveryPulse : public testing::Test {};
using Pulses =
    testing::Types<OneSine, OneCosine, SymmetricRicker, AntisymmetricRicker, HalfSine, Rectangular>;
TYPED_TEST_SUITE(EveryPulse, Pulses);

constexpr int samples = 20000;

/// Phases spread evenly over the pulse.
template <class Pulse>
double phase_number(int i, double window)
{
    const double begin = Pulse::begin(window);
    return begin + (Pulse::end(window) - begin) * i / samples;
}

TYPED_TEST(EveryPulse, HasPeakOne)
{
    double peak = 0;
    for (int i = 0; i <= samples; ++i) {
        peak = std::max(peak, std::abs(TypeParam::value(phase_number<TypeParam>(i, 1.0))));
    }
    // The grid misses the peak by (phase step)^2 / 2 = 1e-7; the antisymmetric Ricker wavelet is
    // higher by 8.6e-5 with the paper's factor 1.38.
    EXPECT_NEAR(peak, (std::is_same_v<TypeParam, AntisymmetricRicker>) ? 1.000086 : 1.0, 1e-6);
}

TYPED_TEST(EveryPulse, HasNoExtremumButAtThePeaksOfItsLobes)
{
    const auto flanks = TypeParam::template flanks<double>();
    const double step = phase_number<TypeParam>(1, 1.0) - TypeParam::begin(1.0);
    for (int i = 1; i < samples; ++i) {
        const double phase = phase_number<TypeParam>(i, 1.0);
        const double before = TypeParam::value(phase) - TypeParam::value(phase - step);
        const double after = TypeParam::value(phase + step) - TypeParam::value(phase);
        if (before * after < 0) {
            const bool known = std::any_of(flanks.begin(), flanks.end(), [&](const auto& flank) {
                return std::abs(flank.peak - phase) <= step;
            });
            EXPECT_TRUE(known) << "turns at " << phase;
        }
    }
}

/// The first phase of each spell in which amplitude |f| > 1, by looking everywhere.
template <class Pulse>
std::vector<double> spells(double amplitude, double window)
{
    std::vector<double> result;
    bool lifted = false;
    for (int i = 0; i <= samples; ++i) {
        const double phase = phase_number<Pulse>(i, window);
        const bool lifts = amplitude * std::abs(Pulse::value(phase)) > 1;
        if (lifts && !lifted) {
            result.push_back(phase);
        }
        lifted = lifts;
    }
    return result;
}

TYPED_TEST(EveryPulse, UpliftsAreWhereTheGroundFirstExceedsTheThreshold)
{
    for (const double window : {0.05, 0.15, 0.3, 0.6, 1.0, 3.0}) {
        for (const double amplitude : {0.5, 1.003, 1.3, 2.1, 2.4, 9.0, 200.0}) {
            std::vector<double> ours;
            for (const double phase : uplift_phases<TypeParam>(amplitude, window)) {
                if (std::isfinite(phase)) {
                    ours.push_back(phase);
                }
            }
            const std::vector<double> seen = spells<TypeParam>(amplitude, window);
            ASSERT_EQ(ours.size(), seen.size())
                << "amplitude " << amplitude << ", window " << window;
            for (std::size_t i = 0; i < seen.size(); ++i) {
                // The grid sees an uplift at most one step late.
                EXPECT_LE(ours[i], seen[i]);
                const double step = phase_number<TypeParam>(1, window) - TypeParam::begin(window);
                EXPECT_GE(ours[i], seen[i] - 1.001 * step);
            }
        }
    }
}

TYPED_TEST(EveryPulse, UpliftsInDoubleAndFiftyDigitsAgree)
{
    const auto in_double = uplift_phases<TypeParam>(3.0, 1.0);
    const auto in_digits = uplift_phases<TypeParam>(Digits50(3), Digits50(1));
    for (std::size_t i = 0; i < in_double.size(); ++i) {
        if (std::isinf(in_double[i])) {
            EXPECT_TRUE(isinf(in_digits[i]));
            continue;
        }
        // 4 units in the last place of 2 pi; the inverse of f is well conditioned at f = 1/3.
        EXPECT_NEAR(in_double[i], double(in_digits[i]), 4e-15);
    }
}

TEST(UpliftPhases, OfASineIsItsClosedForm)
{
    EXPECT_DOUBLE_EQ(uplift_phases<OneSine>(4.0, 1.0)[0], std::asin(0.25));
    EXPECT_DOUBLE_EQ(uplift_phases<HalfSine>(1.25, 1.0)[0], std::asin(0.8));
    EXPECT_EQ(uplift_phases<OneCosine>(1.25, 1.0)[0], 0);
}

TEST(UpliftPhases, AnAmplitudeOfOneDoesNotExceedTheThreshold)
{
    EXPECT_EQ(uplift_phases<OneSine>(1.0, 1.0)[0], std::numeric_limits<double>::infinity());
    EXPECT_EQ(uplift_phases<OneCosine>(1.0, 1.0)[0], std::numeric_limits<double>::infinity());
    EXPECT_EQ(uplift_phases<Rectangular>(1.0, 1.0)[0], std::numeric_limits<double>::infinity());
}

TEST(UpliftPhases, SideLobeOfTheSymmetricRickerLiftsFromItsOwnPeakOn)
{
    const double side_peak = 2 * std::exp(-1.5); // |f| at x^2 = 3/2
    EXPECT_FALSE(std::isfinite(uplift_phases<SymmetricRicker>(0.999 / side_peak, 1.0)[0]));
    EXPECT_TRUE(std::isfinite(uplift_phases<SymmetricRicker>(1.001 / side_peak, 1.0)[0]));
}

template <class Pulse>
void expect_a_tail_to_end_in_time()
{
    for (const double level : {1e-12, 1e-19, 1e-30, 1e-60}) {
        const double end = end_of_tail<Pulse>(std::log2(level));
        for (const double beyond : {1.0, 1.1, 2.0, 3.0}) {
            EXPECT_LE(std::abs(Pulse::value(end * beyond)), level * 1.01) << level;
        }
        EXPECT_GT(std::abs(Pulse::value(end * 0.95)), level); // nor much earlier
    }
    EXPECT_GT(end_of_tail<Pulse>(0.0), 8); // beyond every lobe: the last ends at 4
}

TEST(Wavelets, HaveTailsThatEndBelowAnyLevel)
{
    expect_a_tail_to_end_in_time<SymmetricRicker>();
    expect_a_tail_to_end_in_time<AntisymmetricRicker>();
}

} // namespace
} // namespace overturn
