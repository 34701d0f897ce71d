#include "overturn/number/digits50.hpp"
#include "overturn/number/elementary.hpp"
#ifdef __AVX2__
#include "overturn/number/pack.hpp"
#endif

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <random>
#include <vector>

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

constexpr double smallest_normal = std::numeric_limits<double>::min();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Positive normal doubles: powers of two, their neighbours and random ones of every size.
std::vector<double> positive_numbers()
{
    std::vector<double> numbers{std::numeric_limits<double>::max()};
    std::mt19937_64 generator(2);
    std::uniform_real_distribution<double> uniform(1, 2);
    for (int exponent = -1022; exponent <= 1023; ++exponent) {
        const double power = std::ldexp(1, exponent);
        numbers.push_back(power);
        numbers.push_back(std::nextafter(power, infinity));
        numbers.push_back(power * std::nextafter(2.0, 0.0));
        numbers.push_back(std::ldexp(uniform(generator), exponent));
    }
    numbers.erase(std::remove(numbers.begin(), numbers.end(), infinity), numbers.end());
    return numbers;
}

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

#ifdef __AVX2__
/// The packs available with the compiled instructions; see CMakeLists.txt.
template <class T>
class EveryPack : public testing::Test {};
using Packs = testing::Types<Pack<xsimd::fma3<xsimd::avx2>>
#ifdef __AVX512DQ__
                             ,
                             Pack<xsimd::avx512dq>
#endif
                             >;
TYPED_TEST_SUITE(EveryPack, Packs);

/// Expects every lane of f(pack) to have the bits of f(double), also for NaN.
template <class T, class F>
void expect_equal_bits(const std::vector<double>& arguments, const F& f)
{
    constexpr std::size_t lanes = lanes_v<T>;
    static_assert(lanes > 1);
    for (std::size_t i = 0; i + lanes <= arguments.size(); ++i) { // every number in every lane
        const auto together = lanes_of(T(f(load<T>(&arguments[i]))));
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const double alone = f(arguments[i + lane]);
            ASSERT_EQ(std::bit_cast<std::uint64_t>(together[lane]),
                      std::bit_cast<std::uint64_t>(alone))
                << "argument " << arguments[i + lane] << " in lane " << lane;
        }
    }
}

std::vector<double> random_numbers(double low, double high)
{
    std::mt19937_64 generator(3);
    std::uniform_real_distribution<double> uniform(low, high);
    std::vector<double> numbers(20000);
    std::generate(numbers.begin(), numbers.end(), [&] { return uniform(generator); });
    return numbers;
}

TYPED_TEST(EveryPack, SplitsAndComputesRoughLogarithmsLikeADouble)
{
    std::vector<double> numbers = positive_numbers();
    numbers.insert(numbers.end(),
                   {0.0, -0.0, 5e-324, smallest_normal / 2, -1.0, infinity, -infinity, not_a_number,
                    -not_a_number, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0});
    expect_equal_bits<TypeParam>(
        numbers, []<class T>(const T& x) -> T { return number_traits<T>::split(x).mantissa; });
    expect_equal_bits<TypeParam>(
        numbers, []<class T>(const T& x) -> T { return number_traits<T>::split(x).exponent; });
    expect_equal_bits<TypeParam>(numbers, []<class T>(const T& x) -> T { return rough_log2(x); });
}

TYPED_TEST(EveryPack, ComputesRoughPowersOfTwoLikeADouble)
{
    const auto power = []<class T>(const T& x) -> T { return rough_power_of_two(x); };
    expect_equal_bits<TypeParam>(random_numbers(-1000, 1000), power);
    expect_equal_bits<TypeParam>(random_numbers(-1, 1), power);
    std::vector<double> halves; // ties of the rounding
    for (int k = -1999; k < 2000; ++k) {
        halves.push_back(0.5 * k);
    }
    expect_equal_bits<TypeParam>(halves, power);
}

TYPED_TEST(EveryPack, ComputesSinesCosinesAndExponentialsLikeADouble)
{
    const auto sine = []<class T>(const T& x) -> T { return sine_and_cosine_of_period(x).sine; };
    const auto cosine = []<class T>(const T& x) -> T {
        return sine_and_cosine_of_period(x).cosine;
    };
    const auto decay = []<class T>(const T& x) -> T { return exponential_decay(x); };
    expect_equal_bits<TypeParam>(random_numbers(-1.6, 7.9), sine);
    expect_equal_bits<TypeParam>(random_numbers(-1.6, 7.9), cosine);
    expect_equal_bits<TypeParam>(random_numbers(0, 700), decay);
}
#endif

} // namespace
} // namespace overturn
