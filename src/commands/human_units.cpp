#include "human_units.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string_view>

namespace overturn {

namespace {

constexpr double least_scaled = 999.5; // would be printed as 1000

} // namespace

std::string human_count(double count)
{
    if (!(count >= least_scaled)) {
        return fmt::format("{:.0f}", count);
    }
    constexpr std::string_view prefixes = "kMGTP";
    std::size_t i = 0;
    for (count /= 1000; count >= least_scaled && i + 1 < prefixes.size(); ++i) {
        count /= 1000;
    }
    const int decimals = count < 9.995 ? 2 : count < 99.95 ? 1 : 0;
    return fmt::format("{:.{}f} {}", count, decimals, prefixes[i]);
}

std::string human_duration(double seconds)
{
    if (seconds < 0.9995) {
        return fmt::format("{:.0f} ms", 1000 * seconds);
    }
    if (seconds < 9.995) {
        return fmt::format("{:.2f} s", seconds);
    }
    constexpr std::int64_t minute = 60;
    constexpr std::int64_t hour = 60 * minute;
    constexpr std::int64_t day = 24 * hour;
    const auto whole = std::int64_t(std::llround(seconds));
    if (whole < minute) {
        return fmt::format("{} s", whole);
    }
    if (whole < hour) {
        return fmt::format("{} min {:02} s", whole / minute, whole % minute);
    }
    if (whole < day) {
        return fmt::format("{} h {:02} min", whole / hour, whole % hour / minute);
    }
    return fmt::format("{} d {:02} h", whole / day, whole % day / hour);
}

std::string human_bytes(double bytes)
{
    return human_count(bytes) + (bytes < least_scaled ? " bytes" : "B");
}

} // namespace overturn
