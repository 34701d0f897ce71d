#include "positive_numbers.hpp"

#include "overturn/number/digits50.hpp"
#include "overturn/number/elementary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace overturn {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Largest |error(x)| over random x in [low, high].
template <class Error>
double worst(double low, double high, const Error& error)
{
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> uniform(low, high);
    double result = 0;
    for (int i = 0; i < 20000; ++i) {
        result = std::max(result, std::abs(double(error(uniform(generator)))));
    }
    return result;
}

const double quarter_turn = pi<double>() / 2;

TEST(SineAndCosine, SineIsWithinOneUnitInTheLastPlaceOverAQuarterTurn)
{
    // Half a unit for the last rounding plus the error of Horner's rule; a polynomial one term
    // shorter would be off by 1.4 units at the ends.
    EXPECT_LT(worst(-quarter_turn, quarter_turn,
                    [](double x) {
                        return (sine_and_cosine(x).sine - sin(Digits50(x))) / sin(Digits50(x));
                    }),
              epsilon);
}

TEST(SineAndCosine, CosineIsWithinOneUnitOfOne)
{
    EXPECT_LT(worst(-quarter_turn, quarter_turn,
                    [](double x) { return sine_and_cosine(x).cosine - cos(Digits50(x)); }),
              epsilon);
}

TEST(SineAndCosine, SineIsOddAndCosineIsEvenToTheBit)
{
    for (const double x : {0.0, 1e-300, 1e-8, 0.3, 1.5}) {
        EXPECT_EQ(sine_and_cosine(-x).sine, -sine_and_cosine(x).sine);
        EXPECT_EQ(sine_and_cosine(-x).cosine, sine_and_cosine(x).cosine);
    }
}

TEST(SineAndCosineOfPeriod, AgreeWithTheReferenceOverAWholePeriod)
{
    const auto sine_error = [](double x) {
        return sine_and_cosine_of_period(x).sine - sin(Digits50(x));
    };
    const auto cosine_error = [](double x) {
        return sine_and_cosine_of_period(x).cosine - cos(Digits50(x));
    };
    EXPECT_LT(worst(0, 2 * pi<double>(), sine_error), epsilon);
    EXPECT_LT(worst(0, 2 * pi<double>(), cosine_error), epsilon);
}

TEST(SineAndCosineOfPeriod, KeepsItsDigitsNextToTheZeroAtPi)
{
    // Reduction by a rounded pi alone would leave an absolute error of 1.2e-16, here 1.2e-4.
    const double x = pi<double>() + 1e-12;
    const Digits50 exact = sin(Digits50(x));
    EXPECT_LT(abs((sine_and_cosine_of_period(x).sine - exact) / exact), 2 * epsilon);
}

TEST(SineAndCosineOfCycles, AgreeWithTheReferenceOverManyPeriods)
{
    const auto sine_error = [](double x) {
        return sine_and_cosine_of_cycles(x).sine - sin(Digits50(x));
    };
    const auto cosine_error = [](double x) {
        return sine_and_cosine_of_cycles(x).cosine - cos(Digits50(x));
    };
    for (const double range : {10.0, 100.0, 0x1p+20}) {
        EXPECT_LT(worst(-range, range, sine_error), epsilon);
        EXPECT_LT(worst(-range, range, cosine_error), epsilon);
    }
}

TEST(SineAndCosineOfCycles, AreBitIdenticalToThoseOfOnePeriod)
{
    for (int i = 0; i <= 10000; ++i) {
        const double x = 2 * pi<double>() * i / 10000; // includes pi/2 and 3 pi/2
        ASSERT_EQ(sine_and_cosine_of_cycles(x).sine, sine_and_cosine_of_period(x).sine) << x;
        ASSERT_EQ(sine_and_cosine_of_cycles(x).cosine, sine_and_cosine_of_period(x).cosine) << x;
    }
}

TEST(ExponentialDecay, IsWithinTwoUnitsInTheLastPlaceDownToTheSmallestNumbers)
{
    // The polynomial and the scaling are exact to a unit; reducing 700 by multiples of ln 2 in two
    // parts leaves another half.
    EXPECT_LT(worst(0, 700,
                    [](double x) {
                        return (exponential_decay(x) - exp(Digits50(-x))) / exp(Digits50(-x));
                    }),
              2 * epsilon);
    EXPECT_EQ(exponential_decay(0.0), 1.0);
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

TEST(Split, ReproducesEveryNormalNumberExactly)
{
    for (const double x : positive_numbers()) {
        const auto [mantissa, exponent] = number_traits<double>::split(x);
        ASSERT_GE(mantissa, 1) << x;
        ASSERT_LT(mantissa, 2) << x;
        ASSERT_EQ(std::ldexp(mantissa, int(exponent)), x);
    }
}

TEST(Split, OfAPowerOfTwoInvertsPowerOfTwo)
{
    for (int k = -1022; k <= 1023; ++k) {
        const double power = number_traits<double>::power_of_two(k);
        ASSERT_EQ(power, std::ldexp(1, k));
        ASSERT_EQ(number_traits<double>::split(power).mantissa, 1) << k;
        ASSERT_EQ(number_traits<double>::split(power).exponent, k);
    }
}

TEST(RoughLog2, IsWithinAThousandthOverAllNormalNumbers)
{
    for (const double x : positive_numbers()) {
        ASSERT_NEAR(rough_log2(x), std::log2(x), 1e-3) << x;
    }
    // 8.3e-4, at 1. A parabola instead of the cubic would leave 5e-3, an exponent off by one 1.
    const auto error = [](double x) { return rough_log2(x) - std::log2(x); };
    EXPECT_LT(worst(1, 2, error), 1e-3);
}

TEST(RoughLog2, OfZeroAndOfNonFiniteValuesIsOutsideTheRangeOfLogarithms)
{
    // Also for minus zero and negative results: never a number that could be the logarithm of a
    // positive number.
    EXPECT_LT(rough_log2(0.0), -1022);
    for (const double x : {-0.0, -1.0, infinity, -infinity, not_a_number, -not_a_number}) {
        EXPECT_GT(rough_log2(x), 1023) << x;
    }
}

TEST(RoughLog2, InFiftyDigitsIsTheLogarithm)
{
    // In double the cubic would be off by 8e-4.
    EXPECT_LT(abs(rough_log2(Digits50(12)) - log(Digits50(12)) / log(Digits50(2))), 1e-48);
}

TEST(RoughPowerOfTwo, IsWithinOnePartInTenThousandOverItsRange)
{
    const auto error = [](double x) { return rough_power_of_two(x) / std::exp2(x) - 1; };
    // 9.97e-5, at the half integers. A parabola would leave 2e-3, a wrong integer part 0.5 or 1.
    EXPECT_LT(worst(-1000, 1000, error), 1e-4);
    for (int k = -1999; k < 2000; ++k) { // integers and half integers
        EXPECT_LT(std::abs(error(0.5 * k)), 1e-4) << 0.5 * k;
    }
}

TEST(RoughPowerOfTwo, InvertsRoughLog2)
{
    const auto error = [](double x) { return rough_power_of_two(rough_log2(x)) / x - 1; };
    // 1e-3 ln 2 and 1e-4.
    EXPECT_LT(worst(1, 4, error), 8e-4);
    EXPECT_LT(worst(0x1p-900, 0x1p-898, error), 8e-4);
}

TEST(RoughPowerOfTwo, InFiftyDigitsIsThePower)
{
    EXPECT_LT(abs(rough_power_of_two(Digits50(0.5)) - sqrt(Digits50(2))), 1e-48); // double: 7e-5
}

} // namespace
} // namespace overturn
