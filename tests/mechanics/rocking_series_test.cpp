#include "overturn/mechanics/theory/theories.hpp"
#include "overturn/number/digits50.hpp"
#include "support/every_pulse.hpp"
#include "support/observed_order.hpp"
#include "support/special_values.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace overturn {
namespace {

/// A block in motion under a pulse, at the centre of the expansion.
template <class T>
struct SeriesStart {
    T tilt;         // [rad]
    T rate;         // [rad p]
    T slenderness;  // [rad]
    T acceleration; // of the ground on the block's side, over g [1]
    T phase;        // [rad]
    T frequency;    // [1]
    T unit;         // of time [1/p]
};

const SeriesStart<Digits50> inward{.tilt = 0.15,
                                   .rate = -0.25,
                                   .slenderness = 0.2,
                                   .acceleration = 0.45,
                                   .phase = 0.7,
                                   .frequency = 3,
                                   .unit = 1};

/// Blocks from upright to overturned, slow and fast, under pushes from both sides; units as chosen
/// by a stepper.
std::vector<SeriesStart<double>> series_starts(int count)
{
    std::mt19937_64 generator(5);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(generator);
    };
    std::vector<SeriesStart<double>> starts;
    for (int i = 0; i < count; ++i) {
        const double frequency = std::exp(between(std::log(0.1), std::log(20.0)));
        starts.push_back({.tilt = between(0, 1.57),
                          .rate = between(-1, 1),
                          .slenderness = between(0.05, 0.5),
                          .acceleration = between(-2, 2),
                          .phase = between(0, 3),
                          .frequency = frequency,
                          .unit = 1 / std::max(1.0, frequency)});
    }
    return starts;
}

SeriesStart<Digits50> in_digits(const SeriesStart<double>& start)
{
    return {start.tilt,  start.rate,      start.slenderness, start.acceleration,
            start.phase, start.frequency, start.unit};
}

template <Theory theory, int order, class T>
RockingSeries<order, T> series_of(PulseKind pulse, const SeriesStart<T>& start)
{
    const auto push = pulse_motion<T>(pulse).template series<order>(
        start.acceleration, start.phase, T(start.frequency * start.unit));
    return Equations<theory>::template series<order>(BlockSide{start.slenderness}, start.tilt,
                                                     T(start.rate * start.unit), push, start.unit);
}

/// sum of c[k] t^k, term by term.
template <class T, std::size_t count>
T sum(const std::array<T, count>& c, const T& t)
{
    T power = 1;
    T result = 0;
    for (const T& x : c) {
        result += x * power;
        power *= t;
    }
    return result;
}

template <class T, std::size_t count>
T slope(const std::array<T, count>& c, const T& t)
{
    T power = 1;
    T result = 0;
    for (std::size_t k = 1; k < count; ++k) {
        result += int(k) * c[k] * power;
        power *= t;
    }
    return result;
}

/// The residual of the series in the equation of motion of block.hpp and pulse.hpp, at t.
template <Theory theory, int order>
Digits50 residual(PulseKind pulse, const SeriesStart<Digits50>& start, const Digits50& t)
{
    const auto series = series_of<theory, order>(pulse, start);
    const Digits50 push = start.acceleration *
                          value_of_pulse(pulse_motion<Digits50>(pulse),
                                         Digits50(start.phase + start.frequency * start.unit * t));
    return slope(series.rate, t) - start.unit * start.unit *
                                       Equations<theory>::acceleration(BlockSide{start.slenderness},
                                                                       sum(series.tilt, t), push);
}

using SeriesUnderEveryPulse = EveryPulse;
INSTANTIATE_TEST_SUITE_P(Pulse, SeriesUnderEveryPulse, every_pulse(), pulse_test_name);

template <Theory theory, int order>
double order_of_residual(PulseKind pulse)
{
    return observed_order({32, 64, 128}, [&](int n) -> Digits50 {
        return abs(residual<theory, order>(pulse, inward, Digits50(1) / n));
    });
}

TEST_P(SeriesUnderEveryPulse, SolvesEquation47ToItsOrder)
{
    // The rate ends at t^order, its slope one earlier: the residual begins with t^order. A wrong
    // coefficient k would leave a residual of order k - 1. The next term changes the observed slope
    // by 0.25 where the leading one happens to be small.
    EXPECT_NEAR((order_of_residual<Theory::nonlinear, 8>(GetParam())), 8, 0.3);
    EXPECT_NEAR((order_of_residual<Theory::nonlinear, 12>(GetParam())), 12, 0.3);
    EXPECT_NEAR((order_of_residual<Theory::linear, 8>(GetParam())), 8, 0.3);
    EXPECT_NEAR((order_of_residual<Theory::linear, 12>(GetParam())), 12, 0.3);
}

TEST_P(SeriesUnderEveryPulse, ALongSeriesSolvesEquation47ToManyDigits)
{
    for (const SeriesStart<double>& start : series_starts(20)) {
        const SeriesStart<Digits50> digits = in_digits(start);
        for (const double t : {-0x1p-8, 0x1p-9, 0x1p-8}) {
            // The residual of order 20 is below 2^-160, 7e-49. A product missing from one of the
            // first 16 coefficients is visible.
            EXPECT_LT(abs(residual<Theory::nonlinear, 20>(GetParam(), digits, t)), 1e-46);
            EXPECT_LT(abs(residual<Theory::linear, 20>(GetParam(), digits, t)), 1e-46);
        }
    }
}

template <class Choice>
class SeriesOfEveryTheory : public testing::Test {};
using Theories = testing::Types<std::integral_constant<Theory, Theory::nonlinear>,
                                std::integral_constant<Theory, Theory::linear>>;
TYPED_TEST_SUITE(SeriesOfEveryTheory, Theories);

TYPED_TEST(SeriesOfEveryTheory, RateIsTheDerivativeOfTilt)
{
    for (const SeriesStart<double>& start : series_starts(200)) {
        const auto series = series_of<TypeParam::value, 20>(PulseKind::one_sine, start);
        EXPECT_EQ(series.tilt[0], start.tilt);
        EXPECT_EQ(series.rate[0], start.rate * start.unit);
        EXPECT_EQ(series.tilt[1], series.rate[0]);
        for (std::size_t k = 1; k < series.rate.size(); ++k) {
            // The reciprocal and the product round once each.
            EXPECT_NEAR(double(k + 1) * series.tilt[k + 1], series.rate[k],
                        2 * epsilon * std::abs(series.rate[k]));
        }
    }
}

TEST(RockingSeries, OfTheLinearTheoryUnderAConstantPushIsHyperbolic)
{
    // tilt = alpha + B + (tilt_0 - alpha - B) cosh(u t) + (rate_0 / u) sinh(u t), u the unit and
    // rate_0 per unit of t.
    SeriesStart<Digits50> start = inward;
    start.unit = Digits50(1) / 3;
    const auto series = series_of<Theory::linear, 20>(PulseKind::rectangular, start);
    const Digits50 rest = start.slenderness + start.acceleration;
    Digits50 power = 1; // u^k / k!
    for (int k = 1; k < 22; ++k) {
        power *= start.unit / k;
        const Digits50 exact = power * (k % 2 == 0 ? start.tilt - rest : start.rate);
        EXPECT_LT(abs(series.tilt[std::size_t(k)] / exact - 1), 1e-48) << k; // a few roundings
    }
}

TYPED_TEST(SeriesOfEveryTheory, IsReversedInTimeWithThePush)
{
    for (const SeriesStart<double>& start : series_starts(200)) {
        const double w = start.frequency * start.unit;
        const double rate = start.rate * start.unit;
        const auto forth = pulse_motion<double>(PulseKind::one_sine)
                               .series<20>(start.acceleration, start.phase, w);
        const auto back = pulse_motion<double>(PulseKind::one_sine)
                              .series<20>(start.acceleration, start.phase, -w);
        const auto later = Equations<TypeParam::value>::template series<20>(
            BlockSide{start.slenderness}, start.tilt, rate, forth, start.unit);
        const auto earlier = Equations<TypeParam::value>::template series<20>(
            BlockSide{start.slenderness}, start.tilt, -rate, back, start.unit);
        for (std::size_t k = 0; k < later.tilt.size(); ++k) {
            // Only signs change: no other bit may change.
            ASSERT_EQ(earlier.tilt[k], k % 2 == 0 ? later.tilt[k] : -later.tilt[k]) << k;
        }
    }
}

TYPED_TEST(SeriesOfEveryTheory, IsMirroredAboutTheUnstableBalance)
{
    // At tilt = alpha the mass is above the corner: alpha - tilt and tilt - alpha obey one
    // equation.
    constexpr Theory theory = TypeParam::value;
    for (SeriesStart<double> start : series_starts(200)) {
        start.slenderness = 0.25; // so that the tilt's distance from it has an exact opposite
        start.tilt = std::ldexp(std::round(std::ldexp(start.tilt, 20)), -20);
        SeriesStart<double> mirrored = start;
        mirrored.tilt = 2 * start.slenderness - start.tilt;
        mirrored.rate = -start.rate;
        mirrored.acceleration = -start.acceleration;
        const auto ours = series_of<theory, 20>(PulseKind::one_cosine, start);
        const auto theirs = series_of<theory, 20>(PulseKind::one_cosine, mirrored);
        for (std::size_t k = 1; k < ours.tilt.size(); ++k) {
            ASSERT_EQ(theirs.tilt[k], -ours.tilt[k]) << k;
        }
    }
}

TYPED_TEST(SeriesOfEveryTheory, CoefficientKGrowsWithTheUnitOfTimeToThePowerK)
{
    constexpr Theory theory = TypeParam::value;
    for (const SeriesStart<double>& start : series_starts(200)) {
        SeriesStart<double> slower = start;
        slower.unit = start.unit / 4;
        const auto ours = series_of<theory, 20>(PulseKind::symmetric_ricker, start);
        const auto theirs = series_of<theory, 20>(PulseKind::symmetric_ricker, slower);
        for (std::size_t k = 0; k < ours.tilt.size(); ++k) {
            // A power of two: no bit may change.
            ASSERT_EQ(theirs.tilt[k], std::ldexp(ours.tilt[k], -2 * int(k))) << k;
        }
    }
    SeriesStart<Digits50> odd = inward;
    odd.unit = Digits50(1) / 7;
    const auto ours = series_of<theory, 20>(PulseKind::symmetric_ricker, inward);
    const auto theirs = series_of<theory, 20>(PulseKind::symmetric_ricker, odd);
    for (std::size_t k = 0; k < ours.tilt.size(); ++k) {
        // Round-off of 50 digits, about 1e-50 per term. A unit omitted once is a factor of 7.
        EXPECT_LT(abs(theirs.tilt[k] * pow(Digits50(7), int(k)) / ours.tilt[k] - 1), 1e-46) << k;
    }
}

TYPED_TEST(SeriesOfEveryTheory, ALongerSeriesBeginsWithTheShorterOneToTheBit)
{
    constexpr Theory theory = TypeParam::value;
    for (const SeriesStart<double>& start : series_starts(200)) {
        const auto shorter = series_of<theory, 13>(PulseKind::antisymmetric_ricker, start);
        const auto longer = series_of<theory, 20>(PulseKind::antisymmetric_ricker, start);
        for (std::size_t k = 0; k < shorter.tilt.size(); ++k) {
            ASSERT_EQ(shorter.tilt[k], longer.tilt[k]) << k;
        }
        for (std::size_t k = 0; k < shorter.rate.size(); ++k) {
            ASSERT_EQ(shorter.rate[k], longer.rate[k]) << k;
        }
    }
}

TYPED_TEST(SeriesOfEveryTheory, InDoubleAgreesWithFiftyDigits)
{
    constexpr Theory theory = TypeParam::value;
    constexpr int order = 20;
    std::array<double, order + 1> error{};
    std::array<double, order + 1> largest{};
    for (const SeriesStart<double>& start : series_starts(1000)) {
        const auto ours = series_of<theory, order>(PulseKind::one_sine, start);
        const auto exact = series_of<theory, order>(PulseKind::one_sine, in_digits(start));
        for (std::size_t k = 0; k <= order; ++k) {
            error[k] = std::max(error[k], std::abs(double(ours.rate[k] - exact.rate[k])));
            largest[k] = std::max(largest[k], std::abs(double(exact.rate[k])));
        }
    }
    for (std::size_t k = 0; k <= order; ++k) {
        // The recurrences amplify nothing: 4 units in the last place at most. Sines in float would
        // be off by a hundred million.
        EXPECT_LE(error[k], double(k + 2) * epsilon * largest[k]) << "coefficient " << k;
    }
}

template <int count>
std::vector<int> order_of_visits()
{
    std::vector<int> visits;
    newest_last<count>([&]<int j>() { visits.push_back(j); });
    return visits;
}

TEST(NewestLast, VisitsFromTheMiddleToBothEnds)
{
    EXPECT_EQ(order_of_visits<1>(), (std::vector{0}));
    EXPECT_EQ(order_of_visits<2>(), (std::vector{1, 0}));
    EXPECT_EQ(order_of_visits<5>(), (std::vector{2, 3, 1, 4, 0}));
    EXPECT_EQ(order_of_visits<6>(), (std::vector{3, 2, 4, 1, 5, 0}));
}

} // namespace
} // namespace overturn
