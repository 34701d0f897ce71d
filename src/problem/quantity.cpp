#include "overturn/problem/quantity.hpp"

#include "overturn/mechanics/pulse_kind.hpp"
#include "overturn/problem/coordinates.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace overturn {

namespace {

constexpr Interval finite{"(-inf, inf)", [](double x) { return std::isfinite(x); }};
constexpr Interval positive{"(0, inf)", [](double x) { return x > 0 && std::isfinite(x); }};
constexpr Interval not_negative{"[0, inf)", [](double x) { return x >= 0 && std::isfinite(x); }};
constexpr Interval frictions{"(0, 10]", [](double x) { return x > 0 && x <= 10; }};
constexpr Interval directions{"[0, 360)", [](double x) { return x >= 0 && x < 360; }};
constexpr Interval inclines{"(-pi/2, pi/2)",
                            [](double x) { return std::abs(x) < pi<double>() / 2; }};
constexpr Interval energy_ratios{"(0, 1]", [](double x) { return x > 0 && x <= 1; }};
constexpr Interval shares{"[0, 1]", [](double x) { return x >= 0 && x <= 1; }};
constexpr Interval phases{"[-2 pi, 2 pi]",
                          [](double x) { return std::abs(x) <= 2 * pi<double>(); }};
// Below 1e-100, squares of velocity over alpha exceed the range of a double.
constexpr Interval angles{"[1e-100, pi/2)",
                          [](double x) { return x >= 1e-100 && x < pi<double>() / 2; }};
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

using Values = Derivation::Values;

const Accelerogram& record_of(const Scene& scene, double motion)
{
    return *scene.records()[Scene::record_index(motion)];
}

/// Not std::hypot: that of the C library rounds differently on other processors. The unit, a power
/// of two, keeps the squares within the range of doubles.
double distance(const Scene&, const Values& of)
{
    const double unit = std::ldexp(1.0, std::ilogb(std::max(std::abs(of[0]), std::abs(of[1]))));
    const double x = of[0] / unit;
    const double y = of[1] / unit;
    return unit * std::sqrt(x * x + y * y);
}

/// p of a side: R and the radius of gyration k.
double frequency_parameter_of_side(const Scene& scene, const Values& of)
{
    const double size = of[0];
    const double gyration = of[1];
    return std::sqrt(scene.gravity * size / (gyration * gyration + size * size));
}

/// J / m: the angular momentum that an impact keeps, over m omega.
/// Infinite on a level base.
double friction_over_incline(const Scene&, const Values& of)
{
    const double slope = std::abs(std::tan(of[1]));
    return slope > 0 ? of[0] / slope : std::numeric_limits<double>::infinity();
}

double moment_kept(const Scene&, const Values& of)
{
    const auto [k, plus, minus, alpha_plus, alpha_minus] = of;
    return k * k + plus * minus * std::cos(alpha_plus + alpha_minus);
}

/// r_max of a block with two different sides.
double largest_restitution_of_sides(const Scene&, const Values& of)
{
    const auto [kept, k, plus, minus, _] = of;
    return kept * kept / ((k * k + plus * plus) * (k * k + minus * minus));
}

/// The incline of a block that is given by angles and distances.
double implied_incline(const Scene&, const Values& of)
{
    const auto [plus, alpha_plus, minus, alpha_minus, _] = of;
    return std::atan((plus * std::cos(alpha_plus) - minus * std::cos(alpha_minus)) /
                     (plus * std::sin(alpha_plus) + minus * std::sin(alpha_minus)));
}

using enum Sides;
constexpr Under pulse = Under::pulse;
constexpr Under record = Under::record;

constexpr auto zero = [](const Scene&, const Values&) { return 0.0; };
constexpr auto half = [](const Scene&, const Values& of) { return of[0] / 2; };
constexpr auto product = [](const Scene&, const Values& of) { return of[0] * of[1]; };
constexpr auto ratio = [](const Scene&, const Values& of) { return of[0] / of[1]; };
constexpr auto period = [](const Scene&, const Values& of) {
    return 2 * pi<double>() / (of[0] * of[1]);
};

// clang-format off
// Axes have this order, slowest first; under records, the size is the fastest. Filling requires
// that the strength and the rate are the last two. Result files store coordinates that follow from
// others in this order.
constexpr Quantity quantities[] = {
    {"motion", "1", Role::motion, "number of the ground motion in the job", positive,
     "It is the number of a record.", {.motion = record}},
    {"direction", "degree", Role::direction, "direction of the motion", directions,
     "It is an angle in degrees: 0 is the given motion, 180 its mirror image."},
    {"width", "m", Role::block, "width of the block", positive, of_length,
     {.shapes = shape::lengths}},
    {"half_width", "m", Role::block, "half width of the block, b", positive, of_length,
     {.same_as = "width", .shapes = shape::lengths}, {{{"width"}, half}}},
    {"height", "m", Role::block, "height of the block", positive, of_length,
     {.shapes = shape::lengths}},
    {"half_height", "m", Role::block, "half height of the block, h", positive, of_length,
     {.same_as = "height", .shapes = shape::lengths}, {{{"height"}, half}}},
    {"center_offset", "m", Role::block, "offset of the centre of mass", finite,
     "It is the distance of the centre of mass from the middle of the base in "
     "metres, positive towards the side plus.",
     {.shapes = shape::lengths | shape::two_sides, .standard = "0"}, {{{}, zero, two}}},
    {"center_height", "m", Role::block, "height of the centre of mass", positive, of_length,
     {.shapes = shape::lengths | shape::two_sides, .standard = "half the height"},
     {{{"half_height"}, [](auto&, auto& of) { return of[0]; }, two}}},
    {"slenderness_plus", "rad", Role::block, "slenderness of the side plus", angles, of_angle,
     {.shapes = shape::sides | shape::two_sides, .is_stored = true},
     {{{"base_plus", "center_height", "incline"},
       [](auto&, auto& of) { return std::atan(of[0] / of[1]) - of[2]; }, two}}},
    {"slenderness_minus", "rad", Role::block, "slenderness of the side minus", angles, of_angle,
     {.shapes = shape::sides | shape::two_sides, .is_stored = true},
     {{{"base_minus", "center_height", "incline"},
       [](auto&, auto& of) { return std::atan(of[0] / of[1]) + of[2]; }, two}}},
    {"size_plus", "m", Role::block, "centre of mass to corner plus, R+", positive, of_length,
     {.shapes = shape::sides | shape::two_sides, .is_stored = true},
     {{{"base_plus", "center_height"}, distance, two}}},
    {"size_minus", "m", Role::block, "centre of mass to corner minus, R-", positive, of_length,
     {.shapes = shape::sides | shape::two_sides, .is_stored = true},
     {{{"base_minus", "center_height"}, distance, two}}},
    {"radius_of_gyration", "m", Role::block, "radius of gyration", positive,
     "It is that about the centre of mass in metres.",
     {.shapes = shape::lengths | shape::sides | shape::two_sides,
      .standard = "that of a box, sqrt((width^2 + height^2) / 12)"},
     {{{"half_width", "half_height"},
       [](auto&, auto& of) { return std::sqrt((of[0] * of[0] + of[1] * of[1]) / 3); }, two}}},
    {"incline", "rad", Role::block, "incline of the base", inclines,
     "It is the angle of the base in radians, positive if the side plus is downhill.",
     {.shapes = shape::lengths | shape::two_sides, .standard = "0"},
     {{{"size_plus", "slenderness_plus", "size_minus", "slenderness_minus"}, implied_incline,
       two}, {{}, zero, two}}},
    {"slenderness", "rad", Role::block, "slenderness of the block, arctan(b/h)", angles,
     "It is arctan(width / height) in radians; a degree is 0.01745.",
     {.shapes = shape::angle, .is_stored = true},
     {{{"aspect_ratio"}, [](auto&, auto& of) { return std::atan(1 / of[0]); }},
      {{"half_width", "half_height"},
       [](auto&, auto& of) { return std::atan(of[0] / of[1]); }, equal}}},
    {"aspect_ratio", "1", Role::block, "aspect ratio of the block, h/b", ratios,
     "It is height / width.", {.same_as = "slenderness", .shapes = shape::angle}},
    {"size", "m", Role::block, "half diagonal of the block, R", positive,
     "It is the half diagonal of the block in metres.",
     {.shapes = shape::angle, .is_stored = true},
     {{{"half_width", "half_height"}, distance, equal},
      {{"frequency_parameter"},
       [](auto& scene, auto& of) { return 3 * scene.gravity / (4 * of[0] * of[0]); }, equal}}},
    {"frequency_parameter", "s-1", Role::block, "frequency parameter, p = sqrt(3g / 4R)", positive,
     "It is p = sqrt(3g / 4R) in 1/s.",
     {.same_as = "size", .shapes = shape::angle, .is_stored = true},
     {{{"size"},
       [](auto& scene, auto& of) { return std::sqrt(3 * scene.gravity / (4 * of[0])); }, equal},
      {{"size_plus", "radius_of_gyration"}, frequency_parameter_of_side, two}}},
    {"frequency_parameter_minus", "s-1", Role::derived, "frequency parameter of the side minus",
     positive, "", {.is_stored = true},
     {{{"size_minus", "radius_of_gyration"}, frequency_parameter_of_side, two}}},
    {"largest_restitution", "1", Role::derived, "largest energy ratio, r_max", shares, "",
     {.is_stored = true},
     {{{"moment_kept", "radius_of_gyration", "size_plus", "size_minus"},
       largest_restitution_of_sides, two}}},
    {"friction", "1", Role::block, "friction coefficient of block and base", frictions,
     "It is the coefficient of friction between block and base, the tangent of the friction angle.",
     {.standard = "none: the block does not slip"}},
    {"restitution", "1", Role::loss, "energy ratio at an impact, r", energy_ratios,
     "A block cannot gain energy at an impact, nor lose all of it.", {.is_stored = true},
     {{{"restitution_of_maximum", "slenderness"},
       [](auto&, auto& of) { return of[0] * largest_restitution(of[1]); }, equal},
      {{"restitution_of_maximum", "largest_restitution"}, product, two},
      {{"velocity_restitution"}, [](auto&, auto& of) { return of[0] * of[0]; }}}},
    {"restitution_of_maximum", "1", Role::loss, "energy ratio at an impact, r / r_max", positive,
     "It is a share of the largest restitution (Eq. 17).", {.same_as = "restitution"}},
    // Of a block with two different sides, the mean of the ratios of the impacts on both: their
    // product is r, because the moments of inertia about the corners cancel.
    {"velocity_restitution", "1", Role::loss, "velocity ratio at an impact, e = sqrt(r)", energy_ratios,
     "It is the ratio of the angular velocities after and before an impact.",
     {.same_as = "restitution"}},
    {"amplitude", "1", Role::strength, "peak acceleration, over that of uplift", not_negative,
     "It is the magnitude of the peak acceleration of the motion.",
     {.motion = pulse, .is_stored = true}, {{{"pga", "uplift_pga"}, ratio, any, pulse}}},
    {"scale", "1", Role::strength, "factor on the record", not_negative,
     "It is the factor on the record.",
     {.same_as = "amplitude", .motion = record, .is_stored = true},
     {{{"pga", "record_pga"}, ratio, any, record}}},
    {"pga", "1", Role::strength, "peak ground acceleration, over g", not_negative,
     "It is the peak acceleration of the motion over g.",
     {.same_as = "amplitude", .is_stored = true, .own_units = "g"},
     {{{"amplitude", "uplift_pga"}, product, any, pulse},
      {{"scale", "record_pga"}, product, any, record}}},
    {"frequency", "1", Role::rate, "frequency of the pulse, omega_p / p", positive,
     "The frequency of a pulse must be positive.", {.motion = pulse, .is_stored = true},
     {{{"pulse_period", "frequency_parameter"}, period, equal, pulse},
      {{"pulse_frequency", "frequency_parameter"},
       [](auto&, auto& of) { return 2 * pi<double>() * of[0] / of[1]; }, equal, pulse}}},
    {"pulse_period", "s", Role::rate, "period of the pulse", positive,
     "It is the period of the pulse in seconds.",
     {.same_as = "frequency", .motion = pulse, .is_stored = true},
     {{{"frequency", "frequency_parameter"}, period, equal, pulse},
      {{"pulse_frequency"}, [](auto&, auto& of) { return 1 / of[0]; }, two, pulse}}},
    {"pulse_frequency", "s-1", Role::rate, "frequency of the pulse", positive,
     "It is the frequency of the pulse in Hz.",
     {.same_as = "frequency", .motion = pulse, .own_units = "Hz"}},
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

/// A coordinate on the way from given quantities to the numbers of a point, or a limit on these.
struct Intermediate {
    std::string_view name;
    Derivation follows[2];
};

constexpr Intermediate intermediates[] = {
    {"record_pga",
     {{{"motion", "direction"},
       [](auto& scene, auto& of) { return record_of(scene, of[0]).in_direction(of[1]).peak(); },
       any, Under::two_components},
      {{"motion"}, [](auto& scene, auto& of) { return record_of(scene, of[0]).peak(); }, any,
       record}}},
    {"vertical_pga",
     {{{"scale", "motion"},
       [](auto& scene, auto& of) { return of[0] * record_of(scene, of[1]).upwards_peak(); }, any,
       record}}},
    {"uplift_pga",
     {{{"slenderness"},
       [](auto& scene, auto& of) { return uplift_threshold(scene.theory, of[0]); }, equal},
      {{"slenderness_plus", "slenderness_minus"},
       [](auto& scene, auto& of) {
           return uplift_threshold(scene.theory, std::min(of[0], of[1]));
       }, two}}},
    {"samples_per_unit",
     {{{"motion", "frequency_parameter"},
       [](auto& scene, auto& of) { return 1 / (of[1] * record_of(scene, of[0]).time_step()); },
       equal, record}}},
    {"samples_per_second",
     {{{"motion"}, [](auto& scene, auto& of) { return 1 / record_of(scene, of[0]).time_step(); },
       two, record}}},
    {"angular_frequency",
     {{{"pulse_period"}, [](auto&, auto& of) { return 2 * pi<double>() / of[0]; }, two, pulse}}},
    {"base_plus",
     {{{"half_width", "center_offset"}, [](auto&, auto& of) { return of[0] - of[1]; }, two}}},
    {"base_minus",
     {{{"half_width", "center_offset"}, [](auto&, auto& of) { return of[0] + of[1]; }, two}}},
    {"moment_kept", {{{"radius_of_gyration", "size_plus", "size_minus", "slenderness_plus",
                       "slenderness_minus"}, moment_kept, two}}},
    {"restitution_over_largest",
     {{{"restitution", "slenderness"},
       [](auto&, auto& of) { return of[0] / largest_restitution(of[1]); }, equal},
      {{"restitution", "largest_restitution"}, ratio, two}}},
    {"friction_over_incline", {{{"friction", "incline"}, friction_over_incline, two}}},
    {"gyration_over_size", {{{"radius_of_gyration", "size_plus"}, ratio, two}}},
    {"center_over_half_height", {{{"center_height", "half_height"}, ratio, two}}}};
// clang-format on

template <std::size_t size>
std::span<const Derivation> possible(const Derivation (&follows)[size])
{
    return {follows, std::ranges::find(follows, nullptr, &Derivation::value)};
}

std::string_view root_of(std::string_view name)
{
    const Quantity* found = find_quantity(name);
    return found == nullptr || found->scope.same_as.empty() ? name : found->scope.same_as;
}

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

std::span<const Derivation> derivations_of(std::string_view coordinate)
{
    if (const Quantity* found = find_quantity(coordinate)) {
        return possible(found->follows);
    }
    const auto found = std::ranges::find(intermediates, coordinate, &Intermediate::name);
    return found == std::end(intermediates) ? std::span<const Derivation>()
                                            : possible(found->follows);
}

bool are_equivalent(std::string_view one, std::string_view other)
{
    return root_of(one) == root_of(other);
}

bool exclude_each_other(std::string_view one, std::string_view other)
{
    const unsigned shapes = quantity(one).scope.shapes & ~shape::two_sides;
    const unsigned others = quantity(other).scope.shapes & ~shape::two_sides;
    return are_equivalent(one, other) || (shapes != 0 && others != 0 && (shapes & others) == 0);
}

std::string pulses_with(ShapeNumber number)
{
    std::vector<std::string_view> names;
    for (std::size_t kind = 0; kind < pulses.size(); ++kind) {
        if (has_number(PulseKind(kind), number)) {
            names.push_back(pulses[kind].name);
        }
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

std::string Quantity::printed_units() const
{
    return std::string(!scope.own_units.empty() ? scope.own_units
                       : units == "1"           ? ""
                       : units == "s-1"         ? "1/s"
                       : units == "m s-2"       ? "m/s2"
                                                : units);
}

std::string Quantity::refusal_of(double value) const
{
    std::string text = fmt::format(" = {} is outside {}. {}", value, interval.text, reason);
    const double in_radians = value * pi<double>() / 180;
    if (units == "rad" && allows(in_radians)) {
        text += fmt::format(" {} degrees are {:.4g} rad.", value, in_radians);
    }
    return text;
}

} // namespace overturn
