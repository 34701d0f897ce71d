// Compiled once per instruction set; CMake defines OVERTURN_NUMBER.
#include "positive_numbers.hpp"

#include "overturn/number/elementary.hpp"
#include "overturn/number/pack.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <string>

namespace overturn {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <class T>
class EveryPack : public testing::Test {};

struct NameOfLanes {
    template <class T>
    static std::string GetName(int)
    {
        return "of" + std::to_string(lanes_v<T>);
    }
};

TYPED_TEST_SUITE(EveryPack, testing::Types<OVERTURN_NUMBER>, NameOfLanes);

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
                   {0.0, -0.0, 5e-324, std::numeric_limits<double>::min() / 2, -1.0, infinity,
                    -infinity, not_a_number, -not_a_number, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0});
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

} // namespace
} // namespace overturn
