#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace overturn {

/// Positive normal doubles: powers of two, their neighbours and random ones of every size.
inline std::vector<double> positive_numbers()
{
    std::vector<double> numbers{std::numeric_limits<double>::max()};
    std::mt19937_64 generator(2);
    std::uniform_real_distribution<double> uniform(1, 2);
    for (int exponent = -1022; exponent <= 1023; ++exponent) {
        const double power = std::ldexp(1, exponent);
        numbers.push_back(power);
        numbers.push_back(std::nextafter(power, std::numeric_limits<double>::infinity()));
        numbers.push_back(power * std::nextafter(2.0, 0.0));
        numbers.push_back(std::ldexp(uniform(generator), exponent));
    }
    numbers.erase(
        std::remove(numbers.begin(), numbers.end(), std::numeric_limits<double>::infinity()),
        numbers.end());
    return numbers;
}

} // namespace overturn
