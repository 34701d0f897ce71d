#include "overturn/number/digits50.hpp"
#include "overturn/number/elementary.hpp"

#include <gtest/gtest.h>

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
    // Half a unit for the last rounding and what Horner's rule adds; a polynomial one term too
    // short would be off by 1.4 units at the ends.
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

TEST(SineAndCosineOfPeriod, KeepsItsDigitsBesideTheZeroAtPi)
{
    // Reduction by a rounded pi alone would leave an absolute error of 1.2e-16, here 1.2e-4.
    const double x = pi<double>() + 1e-12;
    const Digits50 exact = sin(Digits50(x));
    EXPECT_LT(abs((sine_and_cosine_of_period(x).sine - exact) / exact), 2 * epsilon);
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

} // namespace
} // namespace overturn
