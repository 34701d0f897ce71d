// What is stored of a point of a spectrum, or of a flip of a boundary: names, types and what "not
// computed" looks like.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

namespace overturn {

enum class Field {
    region,
    angle,
    velocity,
    margin,
    error,
    peak,
    fall_time,
    impacts,
    steps,
    status,
    // Of a boundary:
    flip_amplitude,
    region_below,
    region_above
};

/// Names as they stand in job files and result files, in the order of the enumerators.
inline constexpr std::array<std::string_view, 13> field_names{
    "region",  "angle", "velocity", "margin",         "error",        "peak",        "fall_time",
    "impacts", "steps", "status",   "flip_amplitude", "region_below", "region_above"};

/// What a job can ask for: all but those of a boundary.
inline constexpr auto spectrum_field_names = [] {
    std::array<std::string_view, 10> names{};
    std::copy_n(field_names.begin(), names.size(), names.begin());
    return names;
}();

/// What is stored of a boundary.
inline constexpr std::array boundary_fields{Field::flip_amplitude, Field::region_below,
                                            Field::region_above};

constexpr std::string_view name_of(Field field)
{
    return field_names[std::size_t(field)];
}

/// The values of one field in one tile, row by row, frequency fastest. regions and status: uint8;
/// impacts: uint16; steps: uint32; all others: double.
using FieldValues = std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>,
                                 std::vector<std::uint32_t>, std::vector<double>>;

/// An array for `points` values of a field.
inline FieldValues make_field_values(Field field, std::size_t points)
{
    switch (field) {
    case Field::region:
    case Field::status:
    case Field::region_below:
    case Field::region_above: return std::vector<std::uint8_t>(points);
    case Field::impacts: return std::vector<std::uint16_t>(points);
    case Field::steps: return std::vector<std::uint32_t>(points);
    default: return std::vector<double>(points);
    }
}

/// Bytes that one point of the field takes.
inline std::size_t bytes_per_point(Field field)
{
    return std::visit([](const auto& values) { return sizeof values[0]; },
                      make_field_values(field, 0));
}

/// Flags of the field status. A point without any flag was computed without incident.
namespace status {
inline constexpr std::uint8_t came_to_rest = 1; ///< lay still for a while during the pulse
inline constexpr std::uint8_t cap_was_hit = 2;  ///< too many steps or impacts: undecided
inline constexpr std::uint8_t not_finite = 4;   ///< a number overflowed: undecided
inline constexpr std::uint8_t unresolved = 8;   ///< no number of digits settled the verdict
inline constexpr std::uint8_t not_computed = 255;
} // namespace status

/// Values of the field impacts beyond a plain count.
namespace impact_count {
inline constexpr std::uint16_t bounce_series = 65535; ///< infinitely many: a series died out
inline constexpr std::uint16_t not_computed = 65534;
inline constexpr std::uint16_t largest = 65533; ///< stands for itself and for more
} // namespace impact_count

/// Values of the field steps beyond a plain count.
namespace step_count {
inline constexpr std::uint32_t not_computed = 0xffffffff;
} // namespace step_count

} // namespace overturn
