#include "print.hpp"

#include "overturn/text/quoting.hpp"

#include <cmath>
#include <new>
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

void print_warnings(const std::vector<std::string>& warnings)
{
    std::fflush(stdout);
    for (const std::string& warning : warnings) {
        fmt::print(stderr, "overturn: warning: {}.\n", printable(warning));
    }
}

int exit_code_of(const std::exception& error)
{
    const auto* of_user = dynamic_cast<const Error*>(&error);
    return of_user != nullptr ? of_user->code() : exit_code::internal;
}

std::string message_of(const std::exception& error)
{
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) {
        return "out of memory. Each rank stores the values of the axes, and rank 0 a few bytes for "
               "each tile. Give the axes fewer points, or use a machine with more memory.";
    }
    return printable(error.what());
}

int print_error(const std::exception& error)
{
    std::fflush(stdout);
    std::fprintf(stderr, "overturn: %s\n", message_of(error).c_str());
    return exit_code_of(error);
}

Error stopped_by_signal(const std::string& when)
{
    return {exit_code::stopped,
            "stopped by a signal" + when + ". Run the same command again to resume."};
}

} // namespace overturn
