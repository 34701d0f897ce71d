// The kinds of events and their names.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace overturn {

/// The end of a step is recorded like an event but not stored in result files.
enum class EventKind : std::uint8_t { uplift, impact, rest, end_of_pulse, fall, slip, stick, step };

/// Names in result files, in the order of the enumerators.
inline constexpr std::array<std::string_view, 7> event_names{
    "uplift", "impact", "rest", "end_of_pulse", "fall", "slip", "stick"};

} // namespace overturn
