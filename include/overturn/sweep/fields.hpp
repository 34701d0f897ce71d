// The fields stored for a point of a spectrum or for a flip of a boundary: names, types and the
// values that mean "not computed".
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
    // Fields of a boundary:
    flip_amplitude,
    region_below,
    region_above,
    flip_pga,
    // Fields of a line of a boundary under a record:
    unsafe_share,
    undecided_share,
    // Added to a filled spectrum:
    evaluated
};

/// Names in job files and result files, in the order of the enumerators.
inline constexpr std::array<std::string_view, 17> field_names{
    "region",       "angle",    "velocity",     "margin",          "error",          "peak",
    "fall_time",    "impacts",  "steps",        "status",          "flip_amplitude", "region_below",
    "region_above", "flip_pga", "unsafe_share", "undecided_share", "evaluated"};

/// The fields that a job can request: all except those of a boundary and `evaluated`.
inline constexpr auto spectrum_field_names = [] {
    std::array<std::string_view, 10> names{};
    std::copy_n(field_names.begin(), names.size(), names.begin());
    return names;
}();

/// The fields of a line of a boundary under a record.
inline constexpr std::array line_fields{Field::unsafe_share, Field::undecided_share};

/// Whether the field has one value per line of a boundary: it lacks the dimension `crossing`.
constexpr bool is_of_line(Field field)
{
    return std::find(line_fields.begin(), line_fields.end(), field) != line_fields.end();
}

constexpr std::string_view name_of(Field field)
{
    return field_names[std::size_t(field)];
}

/// The values of one field in one tile, row by row, frequency fastest. Regions, status and
/// evaluated: uint8; impacts: uint16; steps: uint32; all others: double.
using FieldValues = std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>,
                                 std::vector<std::uint32_t>, std::vector<double>>;

/// An array for `points` values of a field.
inline FieldValues make_field_values(Field field, std::size_t points)
{
    switch (field) {
    case Field::region:
    case Field::status:
    case Field::region_below:
    case Field::region_above:
    case Field::evaluated: return std::vector<std::uint8_t>(points);
    case Field::impacts: return std::vector<std::uint16_t>(points);
    case Field::steps: return std::vector<std::uint32_t>(points);
    default: return std::vector<double>(points);
    }
}

/// Size of one value of the field [bytes].
inline std::size_t bytes_per_point(Field field)
{
    return std::visit([](const auto& values) { return sizeof values[0]; },
                      make_field_values(field, 0));
}

/// Flags of the field status; 0 for a point that was computed without incident.
namespace status {
inline constexpr std::uint8_t came_to_rest = 1; ///< came to rest during the pulse
inline constexpr std::uint8_t cap_was_hit = 2;  ///< too many steps: undecided
inline constexpr std::uint8_t not_finite = 4;   ///< an infinity or NaN occurred: undecided
inline constexpr std::uint8_t unresolved = 8;   ///< more digits did not settle the verdict
inline constexpr std::uint8_t free_fall = 16; ///< the ground falls as fast as the block: undecided
inline constexpr std::uint8_t not_computed = 255;
} // namespace status

/// Values of the field evaluated.
namespace point_origin {
inline constexpr std::uint8_t filled = 0;
inline constexpr std::uint8_t integrated = 1;
inline constexpr std::uint8_t not_computed = 255;
} // namespace point_origin

/// Values of the field impacts that are not plain counts.
namespace impact_count {
inline constexpr std::uint16_t bounce_series = 65535; ///< infinitely many: a series died out
inline constexpr std::uint16_t not_computed = 65534;
inline constexpr std::uint16_t largest = 65533; ///< this number or more
} // namespace impact_count

/// Values of the field steps that are not plain counts.
namespace step_count {
inline constexpr std::uint32_t not_computed = 0xffffffff;
} // namespace step_count

} // namespace overturn
