#include "overturn/mechanics/pulse_series.hpp"
#include "overturn/number/digits50.hpp"
#include "support/every_pulse.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace overturn {
namespace {

class SeriesOfEveryPulse : public EveryPulse {
protected:
    template <int count, class S>
    static Coefficients<count, S> series(const S& scale, const S& phase, const S& rate)
    {
        return motion(S(1)).template series<count>(scale, phase, rate);
    }
};
INSTANTIATE_TEST_SUITE_P(Pulse, SeriesOfEveryPulse, every_pulse(), pulse_test_name);

/// Evenly spaced phases of the pulse, including both ends [rad].
std::vector<double> phases(PulseKind pulse, double window = 1)
{
    constexpr int count = 61; // none in the middle, where doubles may miss a kink
    const PulseMotion<double> motion = pulse_motion<double>(pulse, shape_of_test(window));
    std::vector<double> result;
    for (int i = 0; i <= count; ++i) {
        result.push_back(motion.begin + (motion.end - motion.begin) * i / count);
    }
    return result;
}

/// sum of c[k] t^k, term by term.
template <std::size_t count>
Digits50 sum(const std::array<Digits50, count>& c, const Digits50& t)
{
    Digits50 power = 1;
    Digits50 result = 0;
    for (const Digits50& x : c) {
        result += x * power;
        power *= t;
    }
    return result;
}

TEST_P(SeriesOfEveryPulse, SumsToThePulseItselfOnItsSmoothPiece)
{
    const Digits50 scale = -Digits50(7) / 5;
    const Digits50 rate = Digits50(9) / 5;
    for (const double window : {1.0, 2.0}) {
        for (const double phase : phases(GetParam(), window)) {
            const auto terms = series<40>(scale, Digits50(phase), rate);
            for (const double t : {-0.125, 0.0625, 0.125}) {
                const PulseMotion<Digits50> pulse = motion(Digits50(1));
                const Digits50 there = phase + rate * t;
                if (pulse.end_of_piece(Digits50(phase)) != pulse.end_of_piece(there)) {
                    continue;
                }
                const Digits50 exact = scale * value_of_pulse(pulse, there);
                // The steps advance the phase by 0.225. The truncation error of a sine is 0.225^40
                // / 40!, 1e-74; that of a Gaussian of width 1.4 is at most 1e-53. A wrong term is
                // visible.
                EXPECT_LT(abs(sum(terms, Digits50(t)) - exact), 1e-46)
                    << "phase " << phase << ", t " << t;
            }
        }
    }
}

TEST_P(SeriesOfEveryPulse, InDoubleAgreesWithFiftyDigits)
{
    constexpr int count = 21; // the longest that a stepper uses
    const double scale = 1.4;
    const double rate = 0.8;
    std::array<double, count> error{};
    std::array<double, count> largest{};
    for (const double phase : phases(GetParam())) {
        const auto ours = series<count>(scale, phase, rate);
        const auto exact = series<count>(Digits50(scale), Digits50(phase), Digits50(rate));
        for (std::size_t k = 0; k < count; ++k) {
            error[k] = std::max(error[k], std::abs(double(ours[k] - exact[k])));
            largest[k] = std::max(largest[k], std::abs(double(exact[k])));
        }
    }
    for (std::size_t k = 0; k < count; ++k) {
        // Each step of a recurrence adds at most one unit in the last place, and half of that on
        // average: 5 units at k = 20 for the sines, 12 for the wavelets. A sine in single precision
        // would be off by a hundred million.
        const double unit = std::numeric_limits<double>::epsilon() * largest[k];
        EXPECT_LE(error[k], double(k + 2) * unit) << "coefficient " << k;
    }
}

TEST_P(SeriesOfEveryPulse, ALongerSeriesBeginsWithTheShorterOne)
{
    for (const double phase : phases(GetParam())) {
        const auto shorter = series<14>(1.4, phase, 0.8);
        const auto longer = series<20>(1.4, phase, 0.8);
        for (std::size_t k = 0; k < shorter.size(); ++k) {
            ASSERT_EQ(shorter[k], longer[k]) << "phase " << phase << ", coefficient " << k;
        }
    }
}

TEST_P(SeriesOfEveryPulse, ScalesWithTheAmplitudeAndWithPowersOfTheRate)
{
    for (const double phase : phases(GetParam())) {
        const auto once = series<20>(0.7, phase, 0.6);
        const auto scaled = series<20>(-1.4, phase, 0.6);
        const auto faster = series<20>(0.7, phase, 1.2);
        const auto backward = series<20>(0.7, phase, -0.6);
        for (std::size_t k = 0; k < once.size(); ++k) {
            // Factors of two and signs change no other bit.
            ASSERT_EQ(scaled[k], -2 * once[k]) << "coefficient " << k;
            ASSERT_EQ(faster[k], std::ldexp(once[k], int(k))) << "coefficient " << k;
            ASSERT_EQ(backward[k], k % 2 == 0 ? once[k] : -once[k]) << "coefficient " << k;
        }
    }
}

/// Expects f(-phase) = parity * f(phase) in every coefficient, to the bit.
void expect_parity(PulseKind pulse, double parity)
{
    for (const double phase : {0.0, 0.1, 0.7, 1.5}) {
        const auto after = pulse_motion<double>(pulse).series<20>(1.4, phase, 0.8);
        const auto before = pulse_motion<double>(pulse).series<20>(1.4, -phase, -0.8);
        for (std::size_t k = 0; k < after.size(); ++k) {
            EXPECT_EQ(before[k], parity * after[k]) << "phase " << phase << ", coefficient " << k;
        }
    }
}

void expect_terms_to_follow_as_told(PulseKind pulse)
{
    constexpr int known = 24;
    constexpr int all = 60;
    for (const double window : {1.0, 2.0, 5.0}) {
        for (const double phase : phases(pulse, window)) {
            const auto series = pulse_motion<Digits50>(pulse).series<all>(
                Digits50(1), Digits50(phase), Digits50(1));
            for (const double step : {0.1, 0.5, 1.0, 2.0, 3.0}) {
                const auto term = [&](int k) -> Digits50 {
                    return abs(series[k]) * pow(Digits50(step), k);
                };
                const Digits50 ratio =
                    following_ratio<known>(pulse, Digits50(phase), Digits50(step));
                const Digits50 last = std::max(term(known - 1), Digits50(ratio * term(known - 2)));
                for (int j = 1; known - 1 + j < all; ++j) {
                    EXPECT_LE(term(known - 1 + j), last * pow(ratio, j) * (1 + Digits50(1e-40)))
                        << "phase " << phase << ", step " << step << ", j " << j;
                }
            }
        }
    }
}

TEST(PulseSeries, OfTheWaveletsGrowsNoFasterThanItsBound)
{
    expect_terms_to_follow_as_told(PulseKind::symmetric_ricker);
    expect_terms_to_follow_as_told(PulseKind::antisymmetric_ricker);
}

TEST(PulseSeries, HasTheSymmetryOfThePulseAboutPhaseZero)
{
    expect_parity(PulseKind::one_sine, -1);
    expect_parity(PulseKind::antisymmetric_ricker, -1);
    expect_parity(PulseKind::one_cosine, 1);
    expect_parity(PulseKind::symmetric_ricker, 1);
}

TEST(PulseSeries, OfTheConstantPushIsItsScaleOnly)
{
    EXPECT_EQ((pulse_motion<double>(PulseKind::rectangular).series<4>(1.4, 0.3, 0.8)),
              (Coefficients<4, double>{1.4}));
}

TEST(PulseSeries, OfATriangleAtItsKinkIsThatOfTheRequestedPiece)
{
    const PulseMotion<double> triangle = pulse_motion<double>(PulseKind::triangular);
    const double kink = pi<double>() / 2;
    const auto rising = triangle.series<4>(1.5, kink, kink, 0.0);
    const auto falling = triangle.series<4>(1.5, kink, kink, kink);
    EXPECT_EQ(rising, (Coefficients<4, double>{1.5, 1.5}));
    EXPECT_EQ(falling, (Coefficients<4, double>{1.5, -1.5}));
}

TEST(PulseSeries, OfASineAndACosineAtPhaseZeroAreTheirTaylorSeries)
{
    const auto sine = pulse_motion<Digits50>(PulseKind::one_sine)
                          .series<8>(Digits50(1), Digits50(0), Digits50(1));
    const auto cosine = pulse_motion<Digits50>(PulseKind::one_cosine)
                            .series<8>(Digits50(1), Digits50(0), Digits50(1));
    Digits50 factorial = 1;
    for (int k = 0; k < 8; ++k) {
        factorial *= k == 0 ? 1 : k;
        const int sign = k % 4 < 2 ? 1 : -1;
        // A few roundings of 1e-50.
        EXPECT_LT(abs(sine[k] - (k % 2 == 1 ? sign / factorial : Digits50(0))), 1e-48) << k;
        EXPECT_LT(abs(cosine[k] - (k % 2 == 0 ? sign / factorial : Digits50(0))), 1e-48) << k;
    }
}

TEST(PulseSeries, OfTheWaveletsAtTheirCentreAreTheirTaylorSeries)
{
    // With x = t / 2: (1 - 2 x^2) exp(-x^2) = 1 - 3 x^2 + 5/2 x^4 - 7/6 x^6 + ...
    const auto even = pulse_motion<Digits50>(PulseKind::symmetric_ricker)
                          .series<8>(Digits50(1), Digits50(0), Digits50(2));
    const Coefficients<8, Digits50> even_by_hand{1, 0, -3, 0, Digits50(5) / 2, 0, -Digits50(7) / 6,
                                                 0};
    // With z = t: z (z^2 - 3) exp(-z^2 / 2) = -3 z + 5/2 z^3 - 7/8 z^5 + 3/16 z^7 + ...
    const auto odd = pulse_motion<Digits50>(PulseKind::antisymmetric_ricker)
                         .series<8>(Digits50("1.38"), Digits50(0), sqrt(Digits50(3)));
    const Coefficients<8, Digits50> odd_by_hand{
        0, -3, 0, Digits50(5) / 2, 0, -Digits50(7) / 8, 0, Digits50(3) / 16};
    for (std::size_t k = 0; k < 8; ++k) {
        EXPECT_LT(abs(even[k] - even_by_hand[k]), 1e-48) << k; // a few roundings of 1e-50
        EXPECT_LT(abs(odd[k] - odd_by_hand[k]), 1e-48) << k;
    }
}

} // namespace
} // namespace overturn
