#include "overturn/problem/quantity.hpp"

#include "overturn/mechanics/pulse_kind.hpp"
#include "overturn/text/is_one_of.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace overturn {

namespace {

using std::numbers::pi;

constexpr Interval finite{"(-inf, inf)", [](double x) { return std::isfinite(x); }};
constexpr Interval positive{"(0, inf)", [](double x) { return x > 0 && std::isfinite(x); }};
constexpr Interval not_negative{"[0, inf)", [](double x) { return x >= 0 && std::isfinite(x); }};
constexpr Interval directions{"[0, 360)", [](double x) { return x >= 0 && x < 360; }};
constexpr Interval inclines{"(-pi/2, pi/2)", [](double x) { return std::abs(x) < pi / 2; }};
constexpr Interval energy_ratios{"(0, 1]", [](double x) { return x > 0 && x <= 1; }};
constexpr Interval shares{"[0, 1]", [](double x) { return x >= 0 && x <= 1; }};
constexpr Interval phases{"[-2 pi, 2 pi]", [](double x) { return std::abs(x) <= 2 * pi; }};
// Below 1e-100, squares of velocity over alpha exceed the range of a double.
constexpr Interval angles{"[1e-100, pi/2)", [](double x) { return x >= 1e-100 && x < pi / 2; }};
// The slenderness arctan(b/h) is in its own range.
constexpr Interval ratios{"[1e-3, 1e100]", [](double x) { return x >= 1e-3 && x <= 1e100; }};
// At 8 periods the wavelets are below 1e-178 of their peak.
constexpr Interval windows{"(0, 8]", [](double x) { return x > 0 && x <= 8; }};
static_assert(most_cycles == 10 && largest_gamma == 10);
constexpr Interval gammas{"(1, 10]", [](double x) { return x > 1 && x <= largest_gamma; }};
constexpr Interval half_periods{"{0.5, 1, 1.5, ..., 10}", [](double x) {
                                    return x >= 0.5 && x <= most_cycles && std::fmod(x, 0.5) == 0;
                                }};
// Below this range the round-off of a step is as large as the tolerance; above it verdicts are not
// reliable.
constexpr Interval tolerances{"[1e-14, 0.01]", [](double x) { return x >= 1e-14 && x <= 1e-2; }};

constexpr std::string_view of_length = "It is a length in metres.";
constexpr std::string_view of_angle = "It is the angle between gravity and the line from the "
                                      "corner to the centre of mass, in radians.";

// Axes have this order, slowest first; under records, the size is the fastest. Filling requires
// that the strength and the rate are the last two.
constexpr Quantity quantities[] = {
    {"motion", "1", Role::motion, "number of the ground motion in the job", positive,
     "It is the number of a record."},
    {"direction", "degree", Role::direction, "direction of the motion", directions,
     "It is an angle in degrees: 0 is the given motion, 180 its mirror image."},
    {"width", "m", Role::block, "width of the block", positive, of_length},
    {"half_width", "m", Role::block, "half width of the block, b", positive, of_length},
    {"height", "m", Role::block, "height of the block", positive, of_length},
    {"half_height", "m", Role::block, "half height of the block, h", positive, of_length},
    {"center_offset", "m", Role::block, "offset of the centre of mass", finite,
     "It is the distance of the centre of mass from the middle of the base in "
     "metres, positive towards the side plus."},
    {"center_height", "m", Role::block, "height of the centre of mass", positive, of_length},
    {"slenderness_plus", "rad", Role::block, "slenderness of the side plus", angles, of_angle},
    {"slenderness_minus", "rad", Role::block, "slenderness of the side minus", angles, of_angle},
    {"size_plus", "m", Role::block, "centre of mass to corner plus, R+", positive, of_length},
    {"size_minus", "m", Role::block, "centre of mass to corner minus, R-", positive, of_length},
    {"radius_of_gyration", "m", Role::block, "radius of gyration", positive,
     "It is that about the centre of mass in metres."},
    {"incline", "rad", Role::block, "incline of the base", inclines,
     "It is the angle of the base in radians, positive if the side plus is downhill."},
    {"slenderness", "rad", Role::block, "slenderness of the block, arctan(b/h)", angles,
     "It is arctan(width / height) in radians; a degree is 0.01745."},
    {"aspect_ratio", "1", Role::block, "aspect ratio of the block, h/b", ratios,
     "It is height / width."},
    {"size", "m", Role::block, "half diagonal of the block, R", positive,
     "It is the half diagonal of the block in metres."},
    {"frequency_parameter", "s-1", Role::block, "frequency parameter, p = sqrt(3g / 4R)", positive,
     "It is p = sqrt(3g / 4R) in 1/s."},
    {"restitution", "1", Role::loss, "energy ratio at an impact, r", energy_ratios,
     "A block cannot gain energy at an impact, nor lose all of it."},
    {"restitution_of_maximum", "1", Role::loss, "energy ratio at an impact, r / r_max", positive,
     "It is a share of the largest restitution (Eq. 17)."},
    {"amplitude", "1", Role::strength, "peak acceleration, over that of uplift", not_negative,
     "It is the magnitude of the peak acceleration of the motion."},
    {"scale", "1", Role::strength, "factor on the record", not_negative,
     "It is the factor on the record."},
    {"pga", "1", Role::strength, "peak ground acceleration, over g", not_negative,
     "It is the peak acceleration of the motion over g."},
    {"frequency", "1", Role::rate, "frequency of the pulse, omega_p / p", positive,
     "The frequency of a pulse must be positive."},
    {"pulse_period", "s", Role::rate, "period of the pulse", positive,
     "It is the period of the pulse in seconds."},
    {"pulse_frequency", "s-1", Role::rate, "frequency of the pulse", positive,
     "It is the frequency of the pulse in Hz."},
    {"frequency_parameter_minus", "s-1", Role::derived, "frequency parameter of the side minus",
     positive, ""},
    {"largest_restitution", "1", Role::derived, "largest energy ratio, r_max", shares, ""},
    {"window", "1", Role::setting, "half width of the window", windows,
     "It is the half width in pulse periods."},
    {"cycles", "1", Role::setting, "duration of the pulse", half_periods,
     "It is the duration in pulse periods, a multiple of 0.5."},
    {"gamma", "1", Role::setting, "duration of the pulse", gammas,
     "It is the duration in pulse periods."},
    {"nu", "rad", Role::setting, "phase in the middle of the pulse", phases,
     "It is the phase of the oscillation in the middle of the pulse, in radians."},
    {"gravity", "m s-2", Role::setting, "gravity, g", positive, "It is g in m/s2."},
    {"time_step", "s", Role::setting, "time between two samples", positive,
     "It is the time between two samples in seconds."},
    {"audit", "1", Role::setting, "share of the filled points", shares,
     "It is the share of the filled points that are integrated as well."},
    {"tolerance", "1", Role::setting, "local error per step", tolerances,
     "It is the local error per step, relative to the size of the motion."},
};

using NameSet = std::initializer_list<std::string_view>;

/// Quantities of which a point has at most one.
const NameSet equivalents[] = {{"width", "half_width"},
                               {"height", "half_height"},
                               {"slenderness", "aspect_ratio"},
                               {"size", "frequency_parameter"},
                               {"restitution", "restitution_of_maximum"},
                               {"amplitude", "scale", "pga"},
                               {"frequency", "pulse_period", "pulse_frequency"}};

/// The ways to describe a block.
const NameSet ways[] = {
    {"slenderness", "aspect_ratio", "size", "frequency_parameter"},
    {"width", "half_width", "height", "half_height", "center_offset", "center_height",
     "radius_of_gyration", "incline"},
    {"slenderness_plus", "slenderness_minus", "size_plus", "size_minus", "radius_of_gyration"}};

/// What the blocks of the first way, and boxes, lack.
const NameSet of_two_sides{"center_offset", "center_height",    "radius_of_gyration",
                           "incline",       "slenderness_plus", "slenderness_minus",
                           "size_plus",     "size_minus"};

} // namespace

std::span<const Quantity> all_quantities()
{
    return quantities;
}

const Quantity* find_quantity(std::string_view name)
{
    const auto found = std::ranges::find(quantities, name, &Quantity::name);
    return found == std::end(quantities) ? nullptr : found;
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
           std::any_of(std::begin(equivalents), std::end(equivalents), [&](const NameSet& names) {
               return is_one_of(one, names) && is_one_of(other, names);
           });
}

bool describes_two_sides(std::string_view name)
{
    return is_one_of(name, of_two_sides);
}

bool exclude_each_other(std::string_view one, std::string_view other)
{
    const auto is_in_a_way = [](const auto&... names) {
        return std::any_of(std::begin(ways), std::end(ways),
                           [&](const NameSet& way) { return (is_one_of(names, way) && ...); });
    };
    return are_equivalent(one, other) ||
           (is_in_a_way(one) && is_in_a_way(other) && !is_in_a_way(one, other));
}

std::string Quantity::refusal_of(double value) const
{
    std::string text = fmt::format(" = {} is outside {}. {}", value, interval.text, reason);
    const double in_radians = value * pi / 180;
    if (units == "rad" && allows(in_radians)) {
        text += fmt::format(" {} degrees are {:.4g} rad.", value, in_radians);
    }
    return text;
}

} // namespace overturn
