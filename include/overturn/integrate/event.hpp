// What happens to a block on its way, for those who need all of it: a history.
#pragma once

#include "overturn/integrate/rocking_step.hpp"

#include <array>
#include <cstdint>
#include <string_view>

namespace overturn {

/// Steps are recorded, but not stored.
enum class EventKind : std::uint8_t { uplift, impact, rest, end_of_pulse, fall, step };

/// Names as they stand in result files, in the order of the enumerators.
inline constexpr std::array<std::string_view, 5> event_names{"uplift", "impact", "rest",
                                                             "end_of_pulse", "fall"};

/// A block just after an event. Until the next one it rocks on its side, or rests.
template <Number T>
struct Event {
    EventKind kind;
    Rocking<T> rocking;
};

} // namespace overturn
