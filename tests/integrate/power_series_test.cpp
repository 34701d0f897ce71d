#include "overturn/integrate/power_series.hpp"
#include "overturn/number/digits50.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace overturn {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// sum of c[k] t^k in 50 digits, term by term.
template <std::size_t count>
Digits50 value_by_hand(const std::array<double, count>& c, const Digits50& t)
{
    Digits50 sum = 0;
    for (std::size_t k = 0; k < count; ++k) {
        sum += c[k] * pow(t, int(k));
    }
    return sum;
}

template <std::size_t count>
Digits50 slope_by_hand(const std::array<double, count>& c, const Digits50& t)
{
    Digits50 sum = 0;
    for (std::size_t k = 1; k < count; ++k) {
        sum += int(k) * Digits50(c[k]) * pow(t, int(k) - 1);
    }
    return sum;
}

/// The series of the absolute values.
template <std::size_t count>
std::array<double, count> absolute(std::array<double, count> c)
{
    for (double& x : c) {
        x = std::abs(x);
    }
    return c;
}

template <std::size_t count>
std::array<Digits50, count> in_digits(const std::array<double, count>& c)
{
    std::array<Digits50, count> digits;
    std::copy(c.begin(), c.end(), digits.begin());
    return digits;
}

/// The value at s of a polynomial given by Bernstein coefficients: sum of c[i] B_i(s).
Digits50 bernstein(const Quintic<Digits50>& c, const Digits50& s)
{
    constexpr std::array binomial{1, 5, 10, 10, 5, 1};
    Digits50 sum = 0;
    for (int i = 0; i <= 5; ++i) {
        sum += binomial[std::size_t(i)] * c[std::size_t(i)] * pow(s, i) * pow(1 - s, 5 - i);
    }
    return sum;
}

/// Even and odd lengths, from the shortest accepted by all functions to those of the steppers.
template <class Length>
class SeriesOfEveryLength : public testing::Test {
protected:
    static constexpr std::size_t count = Length::value;
    using Series = std::array<double, count>;

    /// Coefficients of both signs that decrease like those of a motion.
    static std::vector<Series> random_series()
    {
        std::mt19937_64 generator(11);
        std::uniform_real_distribution<double> uniform(-1, 1);
        std::vector<Series> result(60);
        for (Series& c : result) {
            double size = 1;
            for (double& x : c) {
                x = size * uniform(generator);
                size *= 0.7;
            }
        }
        return result;
    }
};
template <std::size_t count>
using Length = std::integral_constant<std::size_t, count>;
using Lengths = testing::Types<Length<7>, Length<8>, Length<15>, Length<21>>;
TYPED_TEST_SUITE(SeriesOfEveryLength, Lengths);

const std::vector<double> times{0.0, 1e-9, 0.125, 0.3, 0.5, 0.9, 1.3};

TYPED_TEST(SeriesOfEveryLength, ValueIsTheSumOfItsTerms)
{
    for (const auto& c : this->random_series()) {
        for (const double t : times) {
            for (const double time : {t, -t}) {
                // Half a unit for each of the half as many steps of a chain, each of the size of
                // the remaining terms: together less than two units. A missing or repeated term is
                // off by the whole term, at least 3e-4.
                const double size = double(value_by_hand(absolute(c), t));
                EXPECT_NEAR(double(value_of_series(c, time) - value_by_hand(c, time)), 0,
                            2 * epsilon * size)
                    << time;
            }
        }
        EXPECT_EQ(value_of_series(c, 0.0), c[0]);
    }
}

TYPED_TEST(SeriesOfEveryLength, SlopeIsTheSumOfItsDerivatives)
{
    for (const auto& c : this->random_series()) {
        for (const double t : times) {
            for (const double time : {t, -t}) {
                const double size = double(slope_by_hand(absolute(c), t));
                EXPECT_NEAR(double(slope_of_series(c, time) - slope_by_hand(c, time)), 0,
                            3 * epsilon * size) // k c[k] is also rounded
                    << time;
            }
        }
        EXPECT_EQ(slope_of_series(c, 0.0), c[1]);
    }
}

TYPED_TEST(SeriesOfEveryLength, ValueAndSlopeInFiftyDigitsHaveFiftyDigits)
{
    const Digits50 t = Digits50(1) / 3;
    for (const auto& c : this->random_series()) {
        EXPECT_LT(abs(value_of_series(in_digits(c), t) - value_by_hand(c, t)), 1e-48);
        EXPECT_LT(abs(slope_of_series(in_digits(c), t) - slope_by_hand(c, t)), 1e-48);
    }
}

TYPED_TEST(SeriesOfEveryLength, SlopeNeverExceedsSteepest)
{
    constexpr int samples = 50;
    for (const auto& c : this->random_series()) {
        for (const double t : times) {
            const Digits50 bound = steepest(in_digits(c), Digits50(t));
            for (int i = 0; i <= samples; ++i) {
                const Digits50 slope = slope_by_hand(c, Digits50(t) * i / samples);
                ASSERT_LE(abs(slope), bound * (1 + Digits50(1e-48))) << t << ", sample " << i;
            }
        }
    }
}

TYPED_TEST(SeriesOfEveryLength, SteepestIsTheSlopeAtTheEndIfAllTermsHaveTheSameSign)
{
    for (const auto& c : this->random_series()) {
        for (const double t : times) {
            // The same operations on the same numbers: a looser bound would differ.
            EXPECT_EQ(steepest(c, t), slope_of_series(absolute(c), t));
        }
    }
}

TYPED_TEST(SeriesOfEveryLength, IsWithinItsEnclosure)
{
    constexpr int samples = 50;
    for (const auto& c : this->random_series()) {
        for (const double t : times) {
            const Enclosure<Digits50> bounds = enclosure(in_digits(c), Digits50(t));
            const Quintic<Digits50> lower = bounds.lower();
            const Quintic<Digits50> upper = bounds.upper();
            for (int i = 0; i <= samples; ++i) {
                const Digits50 s = Digits50(i) / samples;
                const Digits50 value = value_by_hand(c, Digits50(t * s));
                const Digits50 round_off = 1e-47; // of 22 terms of 50 digits
                ASSERT_LE(bernstein(lower, s), value + round_off) << t << ", sample " << i;
                ASSERT_GE(bernstein(upper, s), value - round_off) << t << ", sample " << i;
            }
        }
    }
}

TYPED_TEST(SeriesOfEveryLength, CenterOfTheEnclosureIsTheSumOfTheTermsBelowTheFifthPower)
{
    for (const auto& c : this->random_series()) {
        const std::array<double, 5> first{c[0], c[1], c[2], c[3], c[4]};
        for (const double t : times) {
            const Quintic<Digits50> center = enclosure(in_digits(c), Digits50(t)).center;
            for (const double s : {0.0, 0.2, 0.5, 0.7, 1.0}) {
                EXPECT_LT(abs(bernstein(center, s) - value_by_hand(first, Digits50(t) * s)), 1e-47);
            }
        }
    }
}

TYPED_TEST(SeriesOfEveryLength, EnclosureIsReachedAtItsEndIfAllHighTermsHaveTheSameSign)
{
    for (const auto& series : this->random_series()) {
        for (const double sign : {-1.0, 1.0}) {
            auto c = series;
            for (std::size_t k = 5; k < c.size(); ++k) {
                c[k] = sign * std::abs(c[k]);
            }
            for (const double t : times) {
                const Enclosure<Digits50> bounds = enclosure(in_digits(c), Digits50(t));
                const Digits50 end = sign > 0 ? bounds.upper()[5] : bounds.lower()[5];
                // A bound twice as wide as needed would be off by the slack, 0.01 at t = 0.5.
                EXPECT_LT(abs(end - value_by_hand(c, Digits50(t))), 1e-47) << t;
            }
        }
    }
}

TYPED_TEST(SeriesOfEveryLength, EnclosureIsWidestAtItsEndAndNarrowsAsTheFifthPower)
{
    for (const auto& c : this->random_series()) {
        const Enclosure<Digits50> bounds = enclosure(in_digits(c), Digits50(0.9));
        for (const double s : {0.0, 0.5, 1.0}) {
            const Digits50 width = bernstein(bounds.upper(), s) - bernstein(bounds.lower(), s);
            EXPECT_LT(abs(width - 2 * bounds.slack * pow(Digits50(s), 5)), 1e-47) << s;
        }
    }
}

TYPED_TEST(SeriesOfEveryLength, EnclosureInDoubleAgreesWithFiftyDigits)
{
    for (const auto& c : this->random_series()) {
        for (const double t : times) {
            const Enclosure<double> ours = enclosure(c, t);
            const Enclosure<Digits50> exact = enclosure(in_digits(c), Digits50(t));
            const double size = double(value_by_hand(absolute(c), t));
            for (std::size_t i = 0; i < 6; ++i) {
                // Five levels of sums, each of half a unit, and two roundings before them.
                EXPECT_NEAR(double(ours.center[i] - exact.center[i]), 0, 4 * epsilon * size) << t;
            }
            // Relative: the slack is a sum of positive terms. An inaccurate one would weaken the
            // bound that decides whether a block may touch the ground.
            EXPECT_NEAR(ours.slack, double(exact.slack), 6 * epsilon * double(exact.slack)) << t;
        }
    }
}

} // namespace
} // namespace overturn
