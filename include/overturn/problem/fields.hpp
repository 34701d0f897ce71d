// The fields stored for a point of a spectrum or for a flip of a boundary: names, types and the
// values that mean "not computed".
#pragma once

#include "overturn/text/names.hpp"

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
    friction,
    normal,
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

/// The values of one field in one tile, row by row.
using FieldValues = std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>,
                                 std::vector<std::uint32_t>, std::vector<double>>;

/// The types of a value, in the order of FieldValues.
enum class FieldType { uint8, uint16, uint32, float64 };

template <>
inline constexpr std::array<std::string_view, 4> names_of<FieldType>{"uint8", "uint16", "uint32",
                                                                     "float64"};

/// A code or a bit of a field, with its name in the result file.
struct FieldFlag {
    std::uint32_t value;
    std::string_view meaning;
};

/// A field as it is stored.
struct FieldTraits {
    std::string_view name; ///< in job files and result files
    FieldType type;
    std::string_view long_name;
    std::string_view units; ///< empty: codes
    std::string_view comment;
    std::vector<FieldFlag> flags{};
    bool has_bits = false; ///< the flags are bits that may be combined
};

const FieldTraits& traits_of(Field field);

/// All fields, in the order of the enumerators.
inline constexpr std::size_t count_of_fields = std::size_t(Field::evaluated) + 1;
std::vector<std::string_view> field_names();

/// The fields that a job can request: all except those of a boundary and `evaluated`.
std::vector<std::string_view> spectrum_field_names();

inline std::string_view name_of(Field field)
{
    return traits_of(field).name;
}

/// The fields of a line of a boundary under a record.
inline constexpr std::array line_fields{Field::unsafe_share, Field::undecided_share};

/// Whether a field has one value per line of a boundary: it lacks the dimension `crossing`.
constexpr bool is_of_line(Field field)
{
    return field == line_fields[0] || field == line_fields[1];
}

/// The value of a point that is not computed yet, in the type of the field.
std::variant<std::uint8_t, std::uint16_t, std::uint32_t, double> fill_value(Field field);

/// This value for `points` points.
FieldValues not_computed(Field field, std::int64_t points);

/// Size of one value of the field [bytes].
std::size_t bytes_per_point(Field field);

/// Flags of the field status; 0 for a point that was computed without incident.
namespace status {
inline constexpr std::uint8_t came_to_rest = 1; ///< came to rest during the pulse
inline constexpr std::uint8_t cap_was_hit = 2;  ///< too many steps: undecided
inline constexpr std::uint8_t not_finite = 4;   ///< an infinity or NaN occurred: undecided
inline constexpr std::uint8_t unresolved = 8;   ///< more digits did not settle the verdict
inline constexpr std::uint8_t free_fall = 16; ///< the ground falls as fast as the block: undecided
inline constexpr std::uint8_t lifts_off = 32; ///< the block leaves the ground, if that is computed
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

/// Value of region_below and region_above, in addition to the region codes, if there is no flip.
inline constexpr std::uint8_t no_flip = 253;

} // namespace overturn
