#include "output_lines.hpp"

#include <cmath>
#include <utility>

namespace overturn {

namespace {

constexpr double least_scaled = 999.5; // would be printed as 1000

} // namespace

void print_motion_of(std::string_view name, MotionOf motion_of)
{
    if (motion_of == MotionOf::floor) {
        print_row(name, "that of a floor: pga and pgv are its peaks (PFA, PFV)");
    }
}

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
    constexpr std::pair<std::int64_t, const char*> units[] = {
        {86400, "d"}, {3600, "h"}, {60, "min"}, {1, "s"}};
    const auto whole = std::int64_t(std::llround(seconds));
    for (std::size_t i = 0; units[i].first > 1; ++i) {
        const auto& [unit, name] = units[i];
        const auto& [part, part_name] = units[i + 1];
        if (whole >= unit) {
            return fmt::format("{} {} {:02} {}", whole / unit, name, whole % unit / part,
                               part_name);
        }
    }
    return fmt::format("{} s", whole);
}

std::string human_bytes(double bytes)
{
    return human_count(bytes) + (bytes < least_scaled ? " bytes" : "B");
}

} // namespace overturn
