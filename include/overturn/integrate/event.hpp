// What happens to a block on its way, by name.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace overturn {

/// Steps are recorded, but not stored.
enum class EventKind : std::uint8_t { uplift, impact, rest, end_of_pulse, fall, step };

/// Names as they stand in result files, in the order of the enumerators.
inline constexpr std::array<std::string_view, 5> event_names{"uplift", "impact", "rest",
                                                             "end_of_pulse", "fall"};

} // namespace overturn
