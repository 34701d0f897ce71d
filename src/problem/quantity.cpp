#include "overturn/problem/quantity.hpp"

#include "overturn/mechanics/pulse_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace overturn {

namespace {

bool is_positive(double value)
{
    return value > 0 && std::isfinite(value);
}

bool is_not_negative(double value)
{
    return value >= 0 && std::isfinite(value);
}

bool is_finite(double value)
{
    return std::isfinite(value);
}

bool is_direction(double value)
{
    return value >= 0 && value < 360;
}

bool is_incline(double value)
{
    return std::abs(value) < std::numbers::pi / 2;
}

bool is_energy_ratio(double value)
{
    return value > 0 && value <= 1;
}

// Below 1e-100, squares of velocity over alpha exceed the range of a double.
bool is_slenderness(double value)
{
    return value >= 1e-100 && value < std::numbers::pi / 2;
}

// The slenderness arctan(b/h) is in its own range.
bool is_aspect_ratio(double value)
{
    return value >= 1e-3 && value <= 1e100;
}

// At 8 periods the wavelets are below 1e-178 of their peak.
bool is_window(double value)
{
    return value > 0 && value <= 8;
}

bool is_count_of_cycles(double value)
{
    static_assert(most_cycles == 10);
    return value >= 0.5 && value <= most_cycles && 2 * value == std::floor(2 * value);
}

bool is_gamma(double value)
{
    static_assert(largest_gamma == 10);
    return value > 1 && value <= largest_gamma;
}

bool is_share(double value)
{
    return value >= 0 && value <= 1;
}

bool is_phase(double value)
{
    return std::abs(value) <= 2 * std::numbers::pi;
}

// Below this range the round-off of a step is as large as the tolerance; above it verdicts are not
// reliable.
bool is_tolerance(double value)
{
    return value >= 1e-14 && value <= 1e-2;
}

constexpr std::string_view positive = "(0, inf)";
constexpr std::string_view not_negative = "[0, inf)";
constexpr std::string_view of_length = "It is a length in metres.";
constexpr std::string_view of_angle = "It is the angle between gravity and the line from the "
                                      "corner to the centre of mass, in radians.";

// Axes have this order, slowest first; under records, the size is the fastest. Filling requires
// that the strength and the rate are the last two.
constexpr std::array quantities{
    Quantity{"motion", "1", Role::motion, "number of the ground motion in the job", positive,
             is_positive, "It is the number of a record."},
    Quantity{"direction", "degree", Role::direction, "direction of the motion", "[0, 360)",
             is_direction,
             "It is an angle in degrees: 0 is the motion as it stands, 180 its mirror image."},
    Quantity{"width", "m", Role::block, "width of the block", positive, is_positive, of_length},
    Quantity{"half_width", "m", Role::block, "half width of the block, b", positive, is_positive,
             of_length},
    Quantity{"height", "m", Role::block, "height of the block", positive, is_positive, of_length},
    Quantity{"half_height", "m", Role::block, "half height of the block, h", positive, is_positive,
             of_length},
    Quantity{"center_offset", "m", Role::block, "offset of the centre of mass", "(-inf, inf)",
             is_finite,
             "It is the distance of the centre of mass from the middle of the base in "
             "metres, positive towards the side plus."},
    Quantity{"center_height", "m", Role::block, "height of the centre of mass", positive,
             is_positive, of_length},
    Quantity{"slenderness_plus", "rad", Role::block, "slenderness of the side plus",
             "[1e-100, pi/2)", is_slenderness, of_angle},
    Quantity{"slenderness_minus", "rad", Role::block, "slenderness of the side minus",
             "[1e-100, pi/2)", is_slenderness, of_angle},
    Quantity{"size_plus", "m", Role::block, "centre of mass to corner plus, R+", positive,
             is_positive, of_length},
    Quantity{"size_minus", "m", Role::block, "centre of mass to corner minus, R-", positive,
             is_positive, of_length},
    Quantity{"radius_of_gyration", "m", Role::block, "radius of gyration", positive, is_positive,
             "It is that about the centre of mass in metres."},
    Quantity{"incline", "rad", Role::block, "incline of the base", "(-pi/2, pi/2)", is_incline,
             "It is the angle of the base in radians, positive if the side plus is downhill."},
    Quantity{"slenderness", "rad", Role::block, "slenderness of the block, arctan(b/h)",
             "[1e-100, pi/2)", is_slenderness,
             "It is arctan(width / height) in radians; a degree is 0.01745."},
    Quantity{"aspect_ratio", "1", Role::block, "aspect ratio of the block, h/b", "[1e-3, 1e100]",
             is_aspect_ratio, "It is height / width."},
    Quantity{"size", "m", Role::block, "half diagonal of the block, R", positive, is_positive,
             "It is the half diagonal of the block in metres."},
    Quantity{"frequency_parameter", "s-1", Role::block, "frequency parameter, p = sqrt(3g / 4R)",
             positive, is_positive, "It is p = sqrt(3g / 4R) in 1/s."},
    Quantity{"restitution", "1", Role::loss, "energy ratio at an impact, r", "(0, 1]",
             is_energy_ratio, "A block cannot gain energy at an impact, nor lose all of it."},
    Quantity{"restitution_of_maximum", "1", Role::loss, "energy ratio at an impact, r / r_max",
             positive, is_positive, "It is a share of the largest restitution (Eq. 17)."},
    Quantity{"amplitude", "1", Role::strength, "peak acceleration, over that of uplift",
             not_negative, is_not_negative, "It is the magnitude of the peak ground acceleration."},
    Quantity{"scale", "1", Role::strength, "factor on the record", not_negative, is_not_negative,
             "It is the factor on the record."},
    Quantity{"pga", "1", Role::strength, "peak ground acceleration, over g", not_negative,
             is_not_negative, "It is the peak ground acceleration over g."},
    Quantity{"frequency", "1", Role::rate, "frequency of the pulse, omega_p / p", positive,
             is_positive, "The frequency of a pulse must be positive."},
    Quantity{"pulse_period", "s", Role::rate, "period of the pulse", positive, is_positive,
             "It is the period of the pulse in seconds."},
    Quantity{"pulse_frequency", "s-1", Role::rate, "frequency of the pulse", positive, is_positive,
             "It is the frequency of the pulse in Hz."},
    Quantity{"frequency_parameter_minus", "s-1", Role::derived,
             "frequency parameter of the side minus", positive, is_positive, ""},
    Quantity{"largest_restitution", "1", Role::derived, "largest energy ratio, r_max", "[0, 1]",
             is_share, ""},
    Quantity{"window", "1", Role::setting, "half width of the window", "(0, 8]", is_window,
             "It is the half width in pulse periods."},
    Quantity{"cycles", "1", Role::setting, "duration of the pulse", "{0.5, 1, 1.5, ..., 10}",
             is_count_of_cycles, "It is the duration in pulse periods, a multiple of 0.5."},
    Quantity{"gamma", "1", Role::setting, "duration of the pulse", "(1, 10]", is_gamma,
             "It is the duration in pulse periods."},
    Quantity{"nu", "rad", Role::setting, "phase in the middle of the pulse", "[-2 pi, 2 pi]",
             is_phase,
             "It is the phase of the oscillation in the middle of the pulse, in radians."},
    Quantity{"gravity", "m s-2", Role::setting, "gravity, g", positive, is_positive,
             "It is g in m/s2."},
    Quantity{"time_step", "s", Role::setting, "time between two samples", positive, is_positive,
             "It is the time between two samples in seconds."},
    Quantity{"audit", "1", Role::setting, "share of the filled points", "[0, 1]", is_share,
             "It is the share of the filled points that are integrated as well."},
    Quantity{"tolerance", "1", Role::setting, "local error per step", "[1e-14, 0.01]", is_tolerance,
             "It is the local error per step, relative to the size of the motion."},
};

using Names = std::initializer_list<std::string_view>;

bool has(const Names& names, std::string_view name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Quantities of which a point has at most one.
const Names equivalents[] = {{"width", "half_width"},
                             {"height", "half_height"},
                             {"slenderness", "aspect_ratio"},
                             {"size", "frequency_parameter"},
                             {"restitution", "restitution_of_maximum"},
                             {"amplitude", "scale", "pga"},
                             {"frequency", "pulse_period", "pulse_frequency"}};

/// The ways to describe a block.
const Names ways[] = {
    {"slenderness", "aspect_ratio", "size", "frequency_parameter"},
    {"width", "half_width", "height", "half_height", "center_offset", "center_height",
     "radius_of_gyration", "incline"},
    {"slenderness_plus", "slenderness_minus", "size_plus", "size_minus", "radius_of_gyration"}};

/// What the blocks of the first way, and boxes, lack.
const Names of_two_sides{"center_offset", "center_height",    "radius_of_gyration",
                         "incline",       "slenderness_plus", "slenderness_minus",
                         "size_plus",     "size_minus"};

} // namespace

std::span<const Quantity> all_quantities()
{
    return quantities;
}

const Quantity* find_quantity(std::string_view name)
{
    const auto found = std::find_if(quantities.begin(), quantities.end(),
                                    [&](const Quantity& each) { return each.name == name; });
    return found == quantities.end() ? nullptr : &*found;
}

const Quantity& quantity(std::string_view name)
{
    const Quantity* found = find_quantity(name);
    assert(found != nullptr);
    return *found;
}

bool are_equivalent(std::string_view one, std::string_view other)
{
    return one == other ||
           std::any_of(std::begin(equivalents), std::end(equivalents),
                       [&](const Names& names) { return has(names, one) && has(names, other); });
}

bool describes_two_sides(std::string_view name)
{
    return has(of_two_sides, name);
}

bool exclude_each_other(std::string_view one, std::string_view other)
{
    const auto is_in_a_way = [](const auto&... names) {
        return std::any_of(std::begin(ways), std::end(ways),
                           [&](const Names& way) { return (has(way, names) && ...); });
    };
    return are_equivalent(one, other) ||
           (is_in_a_way(one) && is_in_a_way(other) && !is_in_a_way(one, other));
}

std::string Quantity::refusal_of(double value) const
{
    std::string text = fmt::format(" = {} is outside {}. {}", value, interval, reason);
    const double in_radians = value * std::numbers::pi / 180;
    if (units == "rad" && allows(in_radians)) {
        text += fmt::format(" {} degrees are {:.4g} rad.", value, in_radians);
    }
    return text;
}

} // namespace overturn
