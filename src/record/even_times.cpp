#include "even_times.hpp"

#include "numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>

namespace overturn {

namespace {

// Thirty years: a larger value cannot be a time in a record, and might overflow.
constexpr double largest_time = 1e9; // [s]

/// The unit of the last printed digit: 0.001 for 1.250 and 10 for 1e1 [s].
double printed_unit(std::string_view word)
{
    const std::size_t end = std::min(word.find_first_of("eEdD"), word.size());
    const std::size_t point = std::min(word.find('.'), end);
    const std::size_t decimals = point == end ? 0 : end - point - 1;
    // Stays 0 if there is none, or if it is beyond int, which only the number 0 may have.
    int exponent = 0;
    if (end < word.size()) {
        const std::string_view digits =
            word.substr(word[end + 1] == '+' ? end + 2 : end + 1); // a number has digits here
        std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    }
    // 10^-400 is 0; a unit is not larger than the largest time.
    return std::pow(10.0, std::clamp(double(exponent) - double(decimals), -400.0, 9.0));
}

/// The number in [low, high] with the fewest decimal digits; of several, the one nearest to `near`.
double simplest_decimal(double low, double high, double near)
{
    // 10^22 is the largest power of ten that is exact, so that the quotient is correctly rounded.
    constexpr int most_decimals = 22;
    constexpr double most = 0x1p53; // larger numbers are all integers
    double scale = 1;
    for (int decimals = 0; decimals <= most_decimals && near * scale < most; ++decimals) {
        const double first = std::max(1.0, std::ceil(low * scale));
        const double last = std::floor(high * scale);
        if (first <= last) {
            return std::clamp(std::round(near * scale), first, last) / scale;
        }
        scale *= 10;
    }
    return near;
}

} // namespace

void EvenTimes::add(const Lines& lines, std::string_view word)
{
    const double time = number_of(lines, word);
    if (std::abs(time) > largest_time) {
        lines.refuse(fmt::format("the time {} s is outside {} to {} s. The first of two columns "
                                 "must be the time in seconds.",
                                 word, -largest_time, largest_time));
    }
    if (size_ == 0) {
        first_ = time;
    } else if (!(time > last_)) {
        lines.refuse(fmt::format("the time {} s is not after the previous time, {} s. Give "
                                 "ascending times with enough digits, or one column and time_step.",
                                 word, last_));
    } else {
        // Rounding: of both times, of their difference, of its sum with the half unit.
        constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
        const double half_unit =
            printed_unit(word) / 2 + rounding * (std::abs(time) + std::abs(first_));
        const double least = std::max(least_, (time - first_ - half_unit) / double(size_));
        const double most = std::min(most_, (time - first_ + half_unit) / double(size_));
        if (!(least <= most)) {
            lines.refuse(fmt::format(
                "the time is {} s, but must be {:.9g} s to within half a unit of its last digit: "
                "times must be evenly spaced, and those before have the step {:.9g} s. "
                "Resample the record, or give one column and time_step.",
                word, first_ + double(size_) * step(), step()));
        }
        least_ = least;
        most_ = most;
    }
    last_ = time;
    ++size_;
}

double EvenTimes::step() const
{
    assert(size_ > 1);
    return simplest_decimal(least_, most_, (last_ - first_) / double(size_ - 1));
}

} // namespace overturn
