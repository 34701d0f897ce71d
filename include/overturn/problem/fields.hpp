// The fields stored for a point of a spectrum or for a flip of a boundary: names, types, values,
// and the values that mean "not computed".
#pragma once

#include "overturn/integrate/outputs.hpp"
#include "overturn/text/names.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

namespace overturn {

struct EndOfPoint;
struct EndsOfPoints;

/// What is unknown, as a floating-point number.
inline constexpr double unknown_value = std::numeric_limits<double>::quiet_NaN();

/// Of the fields that are floating-point numbers: float32 or float64.
enum class Precision { single_precision, double_precision };

template <>
inline constexpr std::array<std::string_view, 2> names_of<Precision>{"single", "double"};

/// The name of a field, and how its floating-point numbers are stored.
struct Field {
    std::string_view name;
    Precision precision = Precision::double_precision;

    /// Whether it is the same field, in any precision.
    bool operator==(const Field& other) const { return name == other.name; }

    /// Those that are known by name outside their row.
    static const Field region, angle, velocity, margin, error, peak, fall_time, friction_demand,
        slide, slide_peak, normal, impacts, steps, status, flip_amplitude, flip_value, region_below,
        region_above, flip_pga, unsafe_share, undecided_share, evaluated;
};

inline constexpr Field Field::region{"region"};
inline constexpr Field Field::angle{"angle"};
inline constexpr Field Field::velocity{"velocity"};
inline constexpr Field Field::margin{"margin"};
inline constexpr Field Field::error{"error"};
inline constexpr Field Field::peak{"peak"};
inline constexpr Field Field::fall_time{"fall_time"};
inline constexpr Field Field::friction_demand{"friction_demand"};
inline constexpr Field Field::slide{"slide"};
inline constexpr Field Field::slide_peak{"slide_peak"};
inline constexpr Field Field::normal{"normal"};
inline constexpr Field Field::impacts{"impacts"};
inline constexpr Field Field::steps{"steps"};
inline constexpr Field Field::status{"status"};
inline constexpr Field Field::flip_amplitude{"flip_amplitude"};
inline constexpr Field Field::flip_value{"flip_value"};
inline constexpr Field Field::region_below{"region_below"};
inline constexpr Field Field::region_above{"region_above"};
inline constexpr Field Field::flip_pga{"flip_pga"};
inline constexpr Field Field::unsafe_share{"unsafe_share"};
inline constexpr Field Field::undecided_share{"undecided_share"};
inline constexpr Field Field::evaluated{"evaluated"};

/// What has a value of a field.
enum class FieldOf {
    point,        ///< of a spectrum that is not filled
    filled_point, ///< of any spectrum
    filling,      ///< every point of a filled spectrum, without being requested
    flip,         ///< of a boundary
    line          ///< of a boundary under a record: the field lacks the dimension `crossing`
};

/// The values of one field in one tile, row by row.
using FieldValues =
    std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<std::uint32_t>,
                 std::vector<double>, std::vector<float>>;

/// The types of a value as it is computed.
enum class FieldType { uint8, uint16, uint32, float64 };

template <>
inline constexpr std::array<std::string_view, 4> names_of<FieldType>{"uint8", "uint16", "uint32",
                                                                     "float64"};

/// A code or a bit of a field, with its name in the result file.
struct FieldFlag {
    std::uint32_t value;
    std::string_view meaning;
};

/// The value of a field at the end of a point, and the same for all of them in one loop.
struct FieldFunction {
    double (*at)(const EndOfPoint& end) = nullptr;
    void (*everywhere)(EndsOfPoints ends, FieldValues& values) = nullptr;
};

/// All that is known of a field.
struct FieldTraits {
    std::string_view name; ///< in job files and result files
    FieldType type;
    std::string_view long_name;
    std::string_view units; ///< empty: codes
    std::string_view comment;
    std::vector<bool Outputs::*> needs{}; ///< of the integration
    FieldFunction value{};                ///< of points that are not filled
    std::vector<FieldFlag> flags{};
    FieldOf of = FieldOf::point;
    bool has_bits = false; ///< the flags are bits that may be combined
};

/// All fields.
std::span<const FieldTraits> all_fields();

/// The field of this name, or nullptr.
const FieldTraits* find_field(std::string_view name);

/// The same for a field that is known to exist.
const FieldTraits& traits_of(Field field);

/// The fields that a job can request.
std::vector<Field> spectrum_fields();

inline std::string_view name_of(Field field)
{
    return field.name;
}

/// The value of a point that is not computed yet, in the type in which it is stored.
std::variant<std::uint8_t, std::uint16_t, std::uint32_t, double, float> fill_value(Field field);

/// This value for `points` points.
FieldValues not_computed(Field field, std::int64_t points);

/// The float next to a number, and on the same side of 0 and of 1: neither the verdict of a margin
/// nor that of a peak changes. Finite numbers stay finite.
float in_single_precision(double value);

/// Values as they are computed, in the type in which they are stored.
FieldValues as_stored(Field field, FieldValues computed);

/// Size of one stored value of the field [bytes].
std::size_t bytes_per_point(Field field);

/// Flags of the field status; 0 for a point that was computed without incident.
namespace status {
inline constexpr std::uint8_t came_to_rest = 1; ///< came to rest during the pulse
inline constexpr std::uint8_t cap_was_hit = 2;  ///< too many steps: undecided
inline constexpr std::uint8_t not_finite = 4;   ///< an infinity or NaN occurred: undecided
inline constexpr std::uint8_t unresolved = 8;   ///< more digits did not settle the verdict
inline constexpr std::uint8_t free_fall = 16; ///< the ground falls as fast as the block: undecided
inline constexpr std::uint8_t lifts_off = 32; ///< the block leaves the ground, if that is computed
inline constexpr std::uint8_t slipped = 64;   ///< on its base
inline constexpr std::uint8_t jammed = 128;   ///< a corner that slips would be held fast: undecided
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
