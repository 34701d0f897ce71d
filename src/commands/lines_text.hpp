// How many lines of a boundary have no minimum overturning amplitude, or undecided verdicts.
#pragma once

#include "overturn/file/spectrum_summary.hpp"

#include <fmt/format.h>

#include <string>

namespace overturn {

/// Empty if there is nothing to say.
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
