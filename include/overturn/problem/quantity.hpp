// The quantities that describe a block, its ground motion and the integration: names, units,
// allowed values, and how they follow from each other.
#pragma once

#include "overturn/problem/scene.hpp"

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

namespace overturn {

/// What a quantity describes.
enum class Role {
    motion,    ///< which record
    direction, ///< of the motion
    block,     ///< shape and size of the block
    loss,      ///< of energy at an impact
    strength,  ///< of the motion
    rate,      ///< of a pulse
    derived,   ///< of the block; follows from the others and is not given
    setting    ///< of the pulse or of the computation; the same at all points
};

template <>
inline constexpr std::array<std::string_view, 8> names_of<Role>{
    "motion", "direction", "block", "loss", "strength", "rate", "derived", "setting"};

/// A set of numbers, without NaN.
struct Interval {
    std::string_view text; ///< such as "(0, 1]"
    bool (*contains)(double);
};

/// The ways to describe a block, each a bit, and what only blocks with two different sides have.
namespace shape {
inline constexpr unsigned angle = 1;   ///< and the half diagonal
inline constexpr unsigned lengths = 2; ///< of a box, and where its centre of mass is
inline constexpr unsigned sides = 4;   ///< angles and distances of both
inline constexpr unsigned two_sides = 8;
} // namespace shape

/// The blocks to which a derivation applies.
enum class Sides { any, equal, two };

/// How a coordinate follows from at most five others; a constant default follows from none.
struct Derivation {
    using Values = std::array<double, 5>;
    std::array<std::string_view, 5> from;
    double (*value)(const Scene& scene, const Values& of) = nullptr;
    Sides sides = Sides::any;
    Under motion = Under::any_motion;
};

/// A quantity as it is named in job files, tables and result files.
struct Quantity {
    std::string_view name;
    std::string_view units; ///< as in result files; "1" if dimensionless
    Role role;
    std::string_view long_name; ///< at most 40 characters: plots take it as the label of an axis
    Interval interval;          ///< of the allowed values
    std::string_view reason;    ///< for the interval

    struct Scope {
        std::string_view same_as{};       ///< another spelling of that quantity
        unsigned shapes = 0;              ///< see shape
        Under motion = Under::any_motion; ///< under which a job may give it
        bool is_stored = false;           ///< also if it is not given but follows from what is
        std::string_view own_units{};     ///< beside numbers in sentences, if not `units`
        std::string_view standard{};      ///< in words: the value if a job gives none
    } scope{};

    Derivation follows[3]{}; ///< in this order; the first possible one applies

    bool allows(double value) const { return !std::isnan(value) && interval.contains(value); }
    bool is_coordinate() const { return role != Role::derived && role != Role::setting; }

    /// Whether a job with this motion may give the quantity: there is no factor on a pulse, and no
    /// period of a record.
    bool applies_under(const MotionTraits& motion) const
    {
        return is_coordinate() && scope.motion != motion.under_others;
    }

    /// The units beside a number in sentences; empty if there are none.
    std::string printed_units() const;

    /// Why a value that is not allowed is refused, as a text that follows the name.
    std::string refusal_of(double value) const;
};

/// All quantities. Axes have the order of their quantities, slowest first.
std::span<const Quantity> all_quantities();

/// The quantity of this name, or nullptr.
const Quantity* find_quantity(std::string_view name);

/// The same for a name that is known to exist.
const Quantity& quantity(std::string_view name);

/// How a coordinate may follow from others: that of a quantity, or one of
///   record_pga        the peak of the record over g, not scaled, in the direction of the point
///                     [1]
///   uplift_pga        the ground acceleration over g that lifts the block at rest [1]
///   vertical_pga      the peak of the scaled vertical motion over g [1]
///   samples_per_unit  samples of the record per time unit 1/p [1]
///   angular_frequency, samples_per_second  of the motion of a block with two different sides
///                     [1/s]
///   moment_kept, gyration_over_size, center_over_half_height  J / m [m2], k / R+ and the height of
///                     the centre of mass over half the height [1] of a block with two different
///                     sides, if it has them
std::span<const Derivation> derivations_of(std::string_view coordinate);

/// Whether the two are equal, or one follows from the other.
bool are_equivalent(std::string_view one, std::string_view other);

/// The names of the pulses that have this number of their shape, which is a setting.
std::string pulses_with(ShapeNumber number);

/// Whether a point is described by at most one of these two quantities: they are
/// equivalent, or describe a block in different ways.
bool exclude_each_other(std::string_view one, std::string_view other);

} // namespace overturn
