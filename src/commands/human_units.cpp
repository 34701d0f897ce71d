#include "human_units.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace overturn {

namespace {

struct Scaled {
    double value;
    const char* prefix;
};

Scaled scaled(double value)
{
    static constexpr std::array<const char*, 6> prefixes{"", "k", "M", "G", "T", "P"};
    std::size_t i = 0;
    // 999.5 would be shown as 1000.
    while (value >= 999.5 && i + 1 < prefixes.size()) {
        value /= 1000;
        ++i;
    }
    return {value, prefixes[i]};
}

/// Three digits of a number below 1000.
std::string three_digits(double value)
{
    return fmt::format("{:.{}f}", value, value < 9.995 ? 2 : value < 99.95 ? 1 : 0);
}

} // namespace

std::string human_count(double count)
{
    const auto [value, prefix] = scaled(count);
    return *prefix == '\0' ? fmt::format("{:.0f}", value)
                           : fmt::format("{} {}", three_digits(value), prefix);
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
    const auto [value, prefix] = scaled(bytes);
    return *prefix == '\0' ? fmt::format("{:.0f} bytes", value)
                           : fmt::format("{} {}B", three_digits(value), prefix);
}

} // namespace overturn
