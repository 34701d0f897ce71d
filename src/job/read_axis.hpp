// One axis of the plane, and what its values may be.
#pragma once

#include "overturn/sweep/plane.hpp"
#include "toml_reading.hpp"

#include <array>
#include <string_view>

namespace overturn {

/// The interval, within [0, infinity), in which the values of an axis lie, and the reason for it.
struct AxisRule {
    std::string_view interval;
    bool (*allows)(double);
    std::string_view reason;
};

inline constexpr std::array<std::string_view, 5> axis_keys{"values", "first", "last", "count",
                                                           "spacing"};

/// Reads a number, which is an axis of one value, or a table with no other keys than these:
/// { values = [...] } or { first, last, count, spacing }.
Axis read_axis(const Entry& entry, const AxisRule& rule, Names keys = axis_keys);

} // namespace overturn
