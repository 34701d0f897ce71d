// Lines that commands print: messages, and rows of a name and what there is to say about it.
#pragma once

#include "overturn/file/spectrum_summary.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace overturn {

/// Prints a line and flushes it, so that a log has it as soon as it is there, and before the
/// progress of a run that follows. If its reader is gone, the run continues.
inline void say(const std::string& line)
{
    std::puts(line.c_str());
    std::fflush(stdout);
}

inline void print_row(std::string_view name, std::string_view text)
{
    fmt::print("{:<12} {}\n", name, text);
}

/// The row of an axis; `ending` follows the values.
inline void print_axis(std::string_view name, std::int64_t size, double first, double last,
                       std::string_view ending)
{
    print_row(name, size == 1
                        ? fmt::format("{}{}", first, ending)
                        : fmt::format("{} values from {} to {}{}", size, first, last, ending));
}

/// How many lines of a boundary have no minimum overturning amplitude, or undecided verdicts; empty
/// if none has.
inline std::string lines_text(const BoundaryLines& lines)
{
    std::string text;
    const auto add = [&](std::int64_t count, const char* what) {
        if (count > 0) {
            text +=
                fmt::format("{}{} of {} {}", text.empty() ? "" : "; ", count, lines.computed, what);
        }
    };
    add(lines.unsafe_at_first, "lines overturn at the first amplitude looked at");
    add(lines.undecided, "lines have undecided amplitudes, or more flips than are stored");
    return text;
}

} // namespace overturn
