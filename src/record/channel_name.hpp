// The name of a channel in the headers of CSMIP and COSMOS.
#pragma once

#include "lines.hpp"

#include <string>
#include <string_view>

namespace overturn {

/// The direction in the first line such as `Chan  1:  90 Deg` or `Sta Chan  1: 340 deg (Rcrdr Chan
/// 1) Location: roof`, before the line `end`: the text between the last colon before a bracket and
/// this bracket. Empty if there is none.
inline std::string channel_name(Lines header, std::size_t end)
{
    while (header.number() + 1 < end && header.next()) {
        const std::string_view line = trimmed(header.line());
        if (lower(line).starts_with("chan") || lower(line).starts_with("sta cha")) {
            const std::string_view text = line.substr(0, line.find('('));
            const std::size_t colon = text.rfind(':');
            return std::string(colon == text.npos ? "" : trimmed(text.substr(colon + 1)));
        }
    }
    return "";
}

} // namespace overturn
