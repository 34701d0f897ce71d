#include "overturn/number/digits50.hpp"
#include "overturn/number/double_double.hpp"
#include "overturn/number/elementary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace overturn {
namespace {

using Limits = std::numeric_limits<Digits31>;

Digits50 exactly(const Digits31& x)
{
    return Digits50(x.high()) + Digits50(x.low());
}

/// Numbers of very different sizes with digits in both parts.
class RandomNumbers {
public:
    Digits31 operator()()
    {
        const double high = std::ldexp(mantissa_(generator_), exponent_(generator_));
        return Digits31(high) + Digits31(high * 0x1p-54 * mantissa_(generator_));
    }

private:
    std::mt19937_64 generator_{1};
    std::uniform_real_distribution<double> mantissa_{-1, 1};
    std::uniform_int_distribution<int> exponent_{-40, 40};
};

/// The largest relative error of computed(a, b) against reference(a, b) in 50 digits.
template <class Computed, class Reference>
double worst(const Computed& computed, const Reference& reference)
{
    RandomNumbers number;
    double largest = 0;
    for (int i = 0; i < 20000; ++i) {
        const Digits31 a = number();
        const Digits31 b = number();
        const Digits50 expected = reference(exactly(a), exactly(b));
        const Digits50 error = (exactly(computed(a, b)) - expected) / expected;
        largest = std::max(largest, double(abs(error)));
    }
    return largest;
}

// The bounds of Joldes, Muller and Popescu, with u = 2^-53: 3 u^2 for a sum, 5 u^2 for a product. A
// quotient and a root have at most as many errors of this size as they have products and sums.
constexpr double u_squared = 0x1p-106;

TEST(DoubleDouble, SumsAndProductsAreWithinTheirBounds)
{
    EXPECT_LT(worst([](auto a, auto b) { return a + b; },
                    [](auto a, auto b) -> Digits50 { return a + b; }),
              3.1 * u_squared);
    EXPECT_LT(worst([](auto a, auto b) { return a - b; },
                    [](auto a, auto b) -> Digits50 { return a - b; }),
              3.1 * u_squared);
    EXPECT_LT(worst([](auto a, auto b) { return a * b; },
                    [](auto a, auto b) -> Digits50 { return a * b; }),
              5 * u_squared);
}

TEST(DoubleDouble, QuotientsAndRootsAreWithinEpsilon)
{
    const double epsilon = double(Limits::epsilon());
    EXPECT_LT(worst([](auto a, auto b) { return a / b; },
                    [](auto a, auto b) -> Digits50 { return a / b; }),
              epsilon);
    EXPECT_LT(worst([](auto a, auto) { return sqrt(abs(a)); },
                    [](auto a, auto) -> Digits50 { return sqrt(abs(a)); }),
              epsilon);
}

TEST(DoubleDouble, SumsThatCancelKeepTheirLastDigits)
{
    const Digits31 third = Digits31(1) / Digits31(3);
    const Digits31 left = (third + third) + third - Digits31(1);
    EXPECT_LT(std::abs(double(left)), 4 * u_squared);
    EXPECT_EQ(double((Digits31(1) + Digits31(0x1p-100)) - Digits31(1)), 0x1p-100);
}

TEST(DoubleDouble, SineAndCosineAreAccurateTo31Digits)
{
    std::mt19937_64 generator(1);
    for (const double largest : {1.65, 60.0, 0x1p+20}) {
        std::uniform_real_distribution<double> uniform(-largest, largest);
        double error = 0;
        for (int i = 0; i < 5000; ++i) {
            const double high = uniform(generator);
            const Digits31 x = Digits31(high) + Digits31(high * 0x1.23p-55);
            const auto [sine, cosine] = sine_and_cosine(x);
            error = std::max({error, std::abs(double(exactly(sine) - sin(exactly(x)))),
                              std::abs(double(exactly(cosine) - cos(exactly(x))))});
        }
        EXPECT_LT(error, 1e-31 + largest * 0x1p-106) << largest; // that of x itself
    }
}

TEST(DoubleDouble, TheSineOfASmallAngleIsAccurateToTheLastDigit)
{
    for (const double x : {1e-300, 1e-20, 1e-8, 1e-3}) {
        const Digits50 sine = exactly(sine_and_cosine(Digits31(x)).sine);
        EXPECT_LT(std::abs(double((sine - sin(Digits50(x))) / sin(Digits50(x)))),
                  double(Limits::epsilon()))
            << x;
    }
}

TEST(DoubleDouble, TheExponentialIsAccurateTo30Digits)
{
    std::mt19937_64 generator(1);
    for (const double largest : {1e-20, 1e-3, 0.35, 30.0, 600.0}) {
        std::uniform_real_distribution<double> uniform(0, largest);
        double error = 0;
        for (int i = 0; i < 1000; ++i) {
            const double high = uniform(generator);
            const Digits31 x = Digits31(high) + Digits31(high * 0x1.23p-55);
            const Digits50 exact = exp(-exactly(x));
            error =
                std::max(error, std::abs(double((exactly(exponential_decay(x)) - exact) / exact)));
        }
        EXPECT_LT(error, 1e-30 + largest * 0x1p-106) << largest; // that of x itself
    }
    EXPECT_EQ(double(exponential_decay(Digits31(0)) - Digits31(1)), 0);
}

TEST(DoubleDouble, ConstantsAreThoseOf31Digits)
{
    EXPECT_LT(std::abs(double(exactly(pi<Digits31>()) - pi<Digits50>())), 2 * u_squared);
}

TEST(DoubleDouble, ComparesByBothParts)
{
    const Digits31 one(1);
    const Digits31 more = one + Digits31(0x1p-80);
    EXPECT_TRUE(one < more && more > one && one <= more && more >= one && !(one == more));
    EXPECT_TRUE(one <= one && one >= one && one == one && !(one < one));
    const Digits31 infinity = Limits::infinity();
    EXPECT_TRUE(more < infinity && infinity == infinity && -infinity < one);
    const Digits31 unknown = Limits::quiet_NaN();
    EXPECT_FALSE(unknown < one || unknown > one || unknown <= one || unknown == unknown);
    EXPECT_EQ(double(floor(one - Digits31(0x1p-80))), 0);
    EXPECT_EQ(double(ceil(more)), 2);
}

} // namespace
} // namespace overturn
