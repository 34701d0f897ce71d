#include "grid_checks.hpp"

#include "overturn/problem/coordinates.hpp"
#include "overturn/problem/given.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

namespace overturn {

namespace {

[[noreturn]] void refuse(std::string_view quantity, const std::string& message)
{
    throw GivenError(GivenError::no_row, quantity, message);
}

/// What a block with two different sides needs.
template <class Expect>
void expect_two_sides(const Scene& scene, const Grid& grid, const Expect& expect)
{
    constexpr std::string_view angles[]{"slenderness_plus", "slenderness_minus", "size_plus",
                                        "size_minus"};
    if (std::ranges::any_of(angles, [&](auto name) { return grid.find(name) != nullptr; })) {
        for (const std::string_view name : angles) {
            expect(name, name,
                   "A block that is not a box has slenderness_plus and slenderness_minus [rad], "
                   "size_plus and size_minus [m].");
        }
        expect("radius_of_gyration", "radius_of_gyration",
               "Give that about the centre of mass, in metres.");
    } else {
        constexpr std::string_view advice = "Give width and height, or their halves, in metres.";
        expect("half_width", "width", advice);
        expect("half_height", "height", advice);
    }
    expect("restitution", "restitution",
           "Give restitution, the energy ratio r, or restitution_of_maximum, its share of r_max.");
    constexpr std::string_view reason =
        " has no meaning for a block with two different sides, which have two slendernesses and "
        "two frequency parameters. Give {} instead.";
    for (const auto& [name, other] :
         {std::pair("amplitude", "pga [g]"),
          std::pair("frequency", "pulse_period [s] or pulse_frequency [Hz]")}) {
        if (grid.find(name) != nullptr) {
            refuse(name, fmt::format(fmt::runtime(reason), other));
        }
    }
    if (scene.is_recorded()) {
        expect("scale", "scale", "Give scale, a factor on the record, or pga [g].");
    } else {
        expect("pga", "pga", "Give the peak ground acceleration over g.");
        expect("pulse_period", "pulse_period", "Give it in s, or pulse_frequency in Hz.");
    }
}

/// What a block needs, in the order in which it is asked for.
void expect_complete(const Scene& scene, const Grid& grid)
{
    const Coordinates coordinates(scene, grid);
    const auto has = [&](std::string_view name) { return coordinates.has(name); };
    const auto expect = [&](std::string_view coordinate, std::string_view name,
                            std::string_view advice) {
        if (!has(coordinate)) {
            refuse(name, fmt::format(" is missing. {}", advice));
        }
    };
    if (grid.has_two_sides()) {
        expect_two_sides(scene, grid, expect);
        return;
    }
    const bool has_side = has("half_width") || has("half_height");
    if (has_side) {
        constexpr std::string_view advice = "Give width and height, or their halves, in metres.";
        expect("half_width", "width", advice);
        expect("half_height", "height", advice);
    }
    expect("slenderness", "slenderness",
           "Give the slenderness [rad]; or width and height [m], or their halves.");
    expect("restitution", "restitution",
           "Give restitution, the energy ratio r, or restitution_of_maximum, its share of r_max.");
    if (scene.is_recorded()) {
        expect("scale", "scale", "Give scale, a factor on the record, or pga [g].");
        expect("frequency_parameter", "size",
               "Give size [m] or frequency_parameter [1/s], or width and height [m].");
        return;
    }
    expect("amplitude", "amplitude", "Give amplitude, or pga [g].");
    for (const std::string_view rate : {"pulse_period", "pulse_frequency"}) {
        if (grid.find(rate) != nullptr && !has("frequency_parameter")) {
            refuse(rate, " needs the dimensions of the block. Give width and height, or the half "
                         "diagonal size, in metres.");
        }
    }
    expect("frequency", "frequency",
           "Give frequency, or pulse_period [s] or pulse_frequency [Hz] and the dimensions of the "
           "block.");
}

/// Refuses the first corner for which message(values) is not empty. values: of these coordinates,
/// the first of which varies along the dimensions of all. quantity: given, from which they follow.
template <std::size_t count, class Message>
void refuse_where(const Coordinates& coordinates, const Grid& corners, std::string_view quantity,
                  const std::array<std::string_view, count>& names, const Message& message)
{
    const std::vector<std::size_t>& dimensions = coordinates.of(names[0]).dimensions;
    std::array<std::vector<double>, count> values;
    for (std::size_t n = 0; n < count; ++n) {
        values[n] = coordinates.along(dimensions, names[n]);
    }
    for (std::size_t i = 0; i < values[0].size(); ++i) {
        std::array<double, count> at;
        for (std::size_t n = 0; n < count; ++n) {
            at[n] = values[n][i];
        }
        const std::string text = std::apply(message, at);
        if (text.empty()) {
            continue;
        }
        auto row = std::int64_t(i);
        if (!corners.has_table_column(quantity)) {
            throw GivenError(GivenError::no_row, quantity, text);
        }
        const std::size_t table = *corners.dimension_of(quantity);
        for (auto faster = dimensions.rbegin(); *faster != table; ++faster) {
            row /= corners.dimensions[*faster].size();
        }
        throw GivenError(row % corners.dimensions[table].size(), quantity, text);
    }
}

void expect_slenderness(const Coordinates& coordinates, const Grid& corners)
{
    if (!coordinates.has("half_width")) {
        return; // given, or from the aspect ratio: its range is that of the quantity
    }
    const Quantity& rule = quantity("slenderness");
    refuse_where(coordinates, corners, corners.find("width") != nullptr ? "width" : "half_width",
                 std::array<std::string_view, 3>{"slenderness", "half_width", "half_height"},
                 [&](double alpha, double b, double h) {
                     return rule.allows(alpha)
                                ? ""
                                : fmt::format(" makes the block {} m wide and {} m high: its "
                                              "slenderness {} is outside {}. Choose a ratio closer "
                                              "to 1.",
                                              2 * b, 2 * h, alpha, rule.interval.text);
                 });
}

/// r_max (Eq. 17) must exist, and r must be in (0, 1]. A share above 1 is allowed: r_max is the
/// maximum for a block on a flat base, not a physical limit.
void expect_restitution(const Coordinates& coordinates, const Grid& corners)
{
    constexpr std::string_view name = "restitution_of_maximum";
    if (corners.find(name) == nullptr) {
        return;
    }
    if (corners.has_two_sides()) {
        const double largest = extent_of(coordinates.of(name)).last;
        if (largest > 1) {
            refuse(name,
                   fmt::format(" = {}: the restitution of a block with two different sides is "
                               "at most r_max. Give at most 1, or restitution, r itself.",
                               largest));
        }
        return;
    }
    constexpr std::array<std::string_view, 3> names{"restitution", name, "slenderness"};
    refuse_where(coordinates, corners, name, names, [&](double, double share, double alpha) {
        return alpha < limit_of_r_max
                   ? ""
                   : fmt::format(" = {}: r_max is defined only for a slenderness below arcsin "
                                 "sqrt(2/3) = {} rad (Eq. 17), but that of the block is {} rad. "
                                 "Choose a more slender block, or give restitution, r itself.",
                                 share, limit_of_r_max, alpha);
    });
    const Quantity& rule = quantity("restitution");
    refuse_where(coordinates, corners, name, names, [&](double r, double share, double alpha) {
        return rule.allows(r)
                   ? ""
                   : fmt::format(" = {} gives r = {}, which is outside {}, at the slenderness {} "
                                 "rad. {}",
                                 share, r, rule.interval.text, alpha, rule.reason);
    });
}

/// A block with two different sides must stand on its base and rock on after an impact.
void expect_standing(const Coordinates& coordinates, const Grid& corners)
{
    const auto given = [&](std::string_view name) { return corners.find(name) != nullptr; };
    const std::string_view at = given("incline")         ? "incline"
                                : given("center_offset") ? "center_offset"
                                : given("size_plus")     ? "size_plus"
                                : given("width")         ? "width"
                                                         : "half_width";
    const Quantity& rule = quantity("slenderness");
    const auto degrees = [](double angle) { return angle * 180 / std::numbers::pi; };
    refuse_where(
        coordinates, corners, at,
        std::array<std::string_view, 3>{"moment_kept", "slenderness_plus", "slenderness_minus"},
        [&](double kept, double plus, double minus) -> std::string {
            for (const auto& [alpha, side] : {std::pair(plus, "plus"), std::pair(minus, "minus")}) {
                if (!rule.allows(alpha)) {
                    const bool stands = alpha > 0;
                    return fmt::format(
                        ": the block {}: its slenderness is {:.6g} rad ({:.4g} degrees) on the "
                        "side {}. {} Lower the incline or the offset.",
                        stands ? "leans by too much" : "does not stand", alpha, degrees(alpha),
                        side,
                        stands
                            ? "The equations hold below a right angle."
                            : "The centre of mass must be above the base, between both corners.");
                }
            }
            return kept > 0
                       ? ""
                       : fmt::format(
                             ": the block does not rock on after an impact: J/m = {:.6g} m2 is "
                             "not positive. It must be more slender, or have a larger radius "
                             "of gyration.",
                             kept);
        });
}

/// With one component of motion, only the motion itself and its mirror image have a direction.
void expect_directions(const Scene& scene, const Grid& grid)
{
    if (scene.has_two_components()) {
        if (grid.find("pga") != nullptr) {
            refuse("pga", " is not unique: the peak of two horizontal components depends on the "
                          "direction. Give scale, a factor on the record.");
        }
        if (grid.find("direction") == nullptr) {
            refuse("direction", " is missing. Two horizontal components need a direction in "
                                "degrees, from the first component towards the second one.");
        }
        const auto is_zero = [](const std::vector<double>& values) {
            return std::ranges::all_of(values, [](double value) { return value == 0; });
        };
        for (const auto& record : scene.records) {
            if (is_zero(record->horizontal()) || is_zero(record->second())) {
                refuse("direction", " needs two horizontal components, but one of them is zero at "
                                    "all times. Correct it, or give the other one alone.");
            }
        }
    } else if (const Column* directions = grid.find("direction")) {
        for (const double value : directions->values.values()) {
            if (value != 0 && value != 180) {
                refuse(
                    "direction",
                    fmt::format(
                        " = {} needs two horizontal components. With one, give 0, the motion as it "
                        "stands, or 180, its mirror image.",
                        value));
            }
        }
    }
}

/// The factor on a record, and the scaled vertical motion, must not overflow.
void expect_finite_scales(const Scene& scene, const Coordinates& coordinates, const Grid& corners)
{
    const bool is_pga = corners.find("pga") != nullptr;
    const std::string_view name = is_pga ? "pga" : "scale";
    // The first, which is the one of scale and pga that is not given, varies along the dimensions
    // of all.
    const std::array<std::string_view, 4> names{is_pga ? "scale" : "pga", "scale", name, "motion"};
    refuse_where(coordinates, corners, name, names,
                 [&](double, double scale, double strength, double motion) {
                     const Accelerogram& record = *scene.records[Scene::record_index(motion)];
                     return std::isfinite(scale) && std::isfinite(scale * record.upwards_peak())
                                ? ""
                                : fmt::format(" = {} exceeds the range of double precision as a "
                                              "factor on the record, whose peak is {} g. Correct "
                                              "the unit of the record, or lower {}.",
                                              strength, record.peak(), name);
                 });
}

/// Refuses strengths at all of which the vertical motion of every record cancels gravity.
void expect_gravity(const Scene& scene, const Grid& grid)
{
    const std::vector<ScaleRange> scales = scales_of(scene, grid);
    const Accelerogram* weakest = nullptr; // of those with points
    for (std::size_t i = 0; i < scales.size(); ++i) {
        const Accelerogram& record = *scene.records[i];
        if (scales[i].smallest < record.free_fall_scale()) {
            return;
        }
        if (std::isfinite(scales[i].smallest) && weakest == nullptr) {
            weakest = &record;
        }
    }
    const std::string_view name = grid.find("pga") != nullptr ? "pga" : "scale";
    const Coordinates coordinates(scene, grid);
    refuse(name, fmt::format(" = {:.6g}{}: the vertical motion cancels gravity{}. Choose a value "
                             "below the scale {:.6g}{}.",
                             extent_of(coordinates.of(name)).first,
                             coordinates.of(name).values.size() > 1 ? " and more" : "",
                             scene.records.size() > 1 ? " under every record" : "",
                             weakest->free_fall_scale(),
                             scene.has_two_components()
                                 ? ""
                                 : fmt::format(", which is a PGA of {:.6g} g",
                                               weakest->free_fall_scale() * weakest->peak())));
}

} // namespace

void expect_valid(const Scene& scene, const Grid& grid)
{
    expect_complete(scene, grid);
    const Grid corners = corners_of(grid);
    const Coordinates coordinates(scene, corners);
    expect_directions(scene, grid);
    if (grid.has_two_sides()) {
        expect_standing(coordinates, corners);
    } else {
        expect_slenderness(coordinates, corners);
    }
    expect_restitution(coordinates, corners);
    if (scene.is_recorded()) {
        expect_finite_scales(scene, coordinates, corners);
        expect_gravity(scene, corners);
    }
}

} // namespace overturn
