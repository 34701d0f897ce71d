// The quantities that describe a block, its ground motion and the integration: names, units and
// allowed values.
#pragma once

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

/// A set of numbers, without NaN.
struct Interval {
    std::string_view text; ///< such as "(0, 1]"
    bool (*contains)(double);
};

/// A quantity as it is named in job files, tables and result files.
struct Quantity {
    std::string_view name;
    std::string_view units; ///< as in result files; "1" if dimensionless
    Role role;
    std::string_view long_name; ///< at most 40 characters: plots take it as the label of an axis
    Interval interval;          ///< of the allowed values
    std::string_view reason;    ///< for the interval

    bool allows(double value) const { return !std::isnan(value) && interval.contains(value); }
    bool is_coordinate() const { return role != Role::derived && role != Role::setting; }

    /// Why a value that is not allowed is refused, as a text that follows the name.
    std::string refusal_of(double value) const;
};

/// All quantities. Axes have the order of their quantities, slowest first.
std::span<const Quantity> all_quantities();

/// The quantity of this name, or nullptr.
const Quantity* find_quantity(std::string_view name);

/// The same for a name that is known to exist.
const Quantity& quantity(std::string_view name);

/// Whether the two are equal, or one follows from the other.
bool are_equivalent(std::string_view one, std::string_view other);

/// Whether only blocks with two different sides are described by this quantity.
bool describes_two_sides(std::string_view name);

/// Whether a point is described by at most one of these two quantities: they are
/// equivalent, or describe a block in different ways.
bool exclude_each_other(std::string_view one, std::string_view other);

} // namespace overturn
