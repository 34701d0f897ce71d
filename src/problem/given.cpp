#include "overturn/problem/given.hpp"

#include "check_lengths.hpp"

#include "overturn/mechanics/theory/theories.hpp"
#include "overturn/problem/coordinates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace overturn {

namespace {

void expect_no_alternatives(const std::vector<Given>& given)
{
    for (std::size_t i = 1; i < given.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const Given& one = given[i];
            const Given& other = given[j];
            if (!exclude_each_other(one.quantity->name, other.quantity->name)) {
                continue;
            }
            const bool is_column = other.as == GivenAs::column && one.as != GivenAs::column;
            throw GivenError(
                GivenError::no_row, one.quantity->name,
                fmt::format(" cannot be combined with {}{}, which {}. Remove one of them.",
                            is_column ? "the column " : "", other.label,
                            are_equivalent(one.quantity->name, other.quantity->name)
                                ? "gives the same quantity"
                                : "describes the block in another way"));
        }
    }
}

/// The place of an axis among the dimensions; smaller is slower.
int order_of(std::string_view dimension, const MotionTraits& motion)
{
    const auto place = [](std::string_view name) {
        return int(find_quantity(name) - all_quantities().data());
    };
    const std::string_view fastest = motion.fastest_dimension;
    return dimension == table_dimension                             ? place("width")
           : !fastest.empty() && are_equivalent(dimension, fastest) ? int(all_quantities().size())
                                                                    : place(dimension);
}

[[noreturn]] void refuse(std::string_view quantity, const std::string& message)
{
    throw GivenError(GivenError::no_row, quantity, message);
}

void expect(const Coordinates& coordinates, std::string_view coordinate, std::string_view name,
            std::string_view advice)
{
    if (!coordinates.has(coordinate)) {
        refuse(name, fmt::format(" is missing. {}", advice));
    }
}

void expect_block(const Coordinates& coordinates, const Grid& grid)
{
    constexpr std::string_view sides[]{"slenderness_plus", "slenderness_minus", "size_plus",
                                       "size_minus"};
    if (std::ranges::any_of(sides, [&](auto name) { return grid.find(name) != nullptr; })) {
        for (const std::string_view name : sides) {
            expect(coordinates, name, name,
                   "A block that is not a box has slenderness_plus and slenderness_minus [rad], "
                   "size_plus and size_minus [m].");
        }
        expect(coordinates, "radius_of_gyration", "radius_of_gyration",
               "Give that about the centre of mass, in metres.");
    } else if (grid.has_two_sides() || coordinates.has("half_width") ||
               coordinates.has("half_height")) {
        constexpr std::string_view advice = "Give width and height, or their halves, in metres.";
        expect(coordinates, "half_width", "width", advice);
        expect(coordinates, "half_height", "height", advice);
    } else {
        expect(coordinates, "slenderness", "slenderness",
               "Give the slenderness [rad]; or width and height [m], or their halves.");
    }
    expect(
        coordinates, "restitution", "restitution",
        "Give restitution, the energy ratio r, or restitution_of_maximum, its share of r_max, or "
        "velocity_restitution, its root.");
}

void expect_motion(const Scene& scene, const Coordinates& coordinates, const Grid& grid)
{
    const auto refuse_given = [&](std::string_view name, const std::string& reason) {
        if (grid.find(name) != nullptr) {
            refuse(name, reason);
        }
    };
    if (grid.has_two_sides()) {
        constexpr std::string_view reason =
            " has no meaning for a block with two different sides, which have two slendernesses "
            "and two frequency parameters. Give {} instead.";
        refuse_given("amplitude", fmt::format(reason, "pga [g]"));
        refuse_given("frequency", fmt::format(reason, "pulse_period [s] or pulse_frequency [Hz]"));
    }
    if (scene.is_under(Under::record)) {
        expect(coordinates, "scale", "scale", "Give scale, a factor on the record, or pga [g].");
        expect(coordinates, "frequency_parameter", "size",
               "Give size [m] or frequency_parameter [1/s], or width and height [m].");
    } else if (grid.has_two_sides()) {
        expect(coordinates, "pga", "pga",
               scene.worded("Give the peak ground acceleration over g."));
        expect(coordinates, "pulse_period", "pulse_period",
               "Give it in s, or pulse_frequency in Hz.");
    } else {
        expect(coordinates, "amplitude", "amplitude", "Give amplitude, or pga [g].");
        for (const std::string_view rate : {"pulse_period", "pulse_frequency"}) {
            if (!coordinates.has("frequency_parameter")) {
                refuse_given(rate, " needs the dimensions of the block. Give width and height, or "
                                   "the half diagonal size, in metres.");
            }
        }
        expect(coordinates, "frequency", "frequency",
               "Give frequency, or pulse_period [s] or pulse_frequency [Hz] and the dimensions of "
               "the block.");
    }
}

/// A limit on a coordinate that follows from given quantities.
struct Limit {
    std::string_view coordinate;
    Interval interval;
    std::vector<std::string_view> causes; ///< of which the first that is given is refused
    std::string_view advice;
    bool applies = true;
};

/// Refuses the first corner beyond a limit: the block, if only the table of blocks says which one
/// it is.
void expect_within(const Limit& limit, const Coordinates& coordinates, const Grid& corners)
{
    const auto given = std::ranges::find_if(
        limit.causes, [&](std::string_view name) { return corners.find(name) != nullptr; });
    if (!limit.applies || given == limit.causes.end() || !coordinates.has(limit.coordinate)) {
        return;
    }
    constexpr std::string_view shape[] = {"width", "half_width", "slenderness", "slenderness_plus"};
    const auto of_block = std::ranges::find_if(
        shape, [&](std::string_view name) { return corners.has_table_column(name); });
    const std::string_view cause =
        corners.has_table_column(*given) || of_block == std::end(shape) ? *given : *of_block;
    const std::vector<std::size_t> dimensions =
        coordinates.dimensions_of_any({limit.coordinate, cause});
    const std::vector<double> values = coordinates.along(dimensions, limit.coordinate);
    const auto beyond = std::ranges::find_if_not(values, limit.interval.contains);
    if (beyond == values.end()) {
        return;
    }
    const auto place = beyond - values.begin();
    throw GivenError(corners.row_of_table(cause, dimensions, place), cause,
                     fmt::format(" = {}: {} = {} is outside {}. {}",
                                 coordinates.along(dimensions, cause)[std::size_t(place)],
                                 limit.coordinate, *beyond, limit.interval.text, limit.advice));
}

/// Refuses blocks and factors on records that do not exist.
void expect_limits(const Coordinates& coordinates, const Grid& corners)
{
    const Interval& angle = quantity("slenderness").interval;
    const std::vector<std::string_view> sides{"incline", "center_offset", "size_plus", "width",
                                              "half_width"};
    constexpr std::string_view stands = "The block does not stand, or leans by a right angle: its "
                                        "centre of mass must be above the base, between both "
                                        "corners. Lower the incline, which is in radians, or the "
                                        "offset, in metres.";
    constexpr std::string_view overflow =
        "The factor on a record, or its vertical motion, exceeds the range of double precision. "
        "Correct the unit of the record, or give a lower value.";
    const Limit limits[] = {
        {"slenderness",
         angle,
         {"width", "half_width"},
         "Choose a ratio of width and height closer to 1."},
        {"slenderness_plus", angle, sides, stands},
        {"slenderness_minus", angle, sides, stands},
        {"moment_kept", quantity("size").interval, sides,
         "J / m [m2] must be positive for the block to rock on after an impact: it must be more "
         "slender, or have a larger radius of gyration."},
        // A share above 1 is allowed: r_max is the maximum for a block on a flat base, not a
        // physical limit.
        {"slenderness",
         {"(0, 0.9553)", [](double alpha) { return alpha < limit_of_r_max; }},
         {"restitution_of_maximum"},
         "r_max is defined only for a slenderness below arcsin sqrt(2/3) rad (Eq. 17). Choose a "
         "more slender block, or give restitution, r itself."},
        {"restitution_of_maximum",
         {"(0, 1]", [](double share) { return share <= 1; }},
         {"restitution_of_maximum"},
         "The restitution of a block with two different sides is at most r_max. Give at most 1, or "
         "restitution, r itself.",
         corners.has_two_sides()},
        {"restitution",
         quantity("restitution").interval,
         {"restitution_of_maximum", "velocity_restitution"},
         quantity("restitution").reason},
        {"restitution_over_largest",
         {"(0, 1]", [](double share) { return share <= 1 + 1e-12; }},
         {"restitution_of_maximum", "restitution", "velocity_restitution"},
         "With friction, the restitution is at most r_max, that of an impact on a corner that does "
         "not slip. Give at most r_max, or remove friction.",
         corners.may_slip()},
        {"friction_over_incline",
         {"(1, inf]", [](double ratio) { return ratio > 1; }},
         {"friction", "incline"},
         "The block would slide down at rest: the friction coefficient must be larger than the "
         "tangent of the incline. Lower the incline, or give a larger friction."},
        {"scale", quantity("scale").interval, {"pga"}, overflow},
        {"vertical_pga", quantity("pga").interval, {"pga", "scale"}, overflow}};
    for (const Limit& limit : limits) {
        expect_within(limit, coordinates, corners);
    }
}

/// With one component of motion, only the motion itself and its mirror image have a direction.
void expect_directions(const Scene& scene, const Grid& grid)
{
    const Column* const directions = grid.find("direction");
    const auto is_zero = [](double value) { return value == 0; };
    if (!scene.has_two_components()) {
        for (const double value :
             directions == nullptr ? AxisList() : directions->values.values()) {
            if (value != 0 && value != 180) {
                refuse("direction",
                       fmt::format(" = {} needs two horizontal components. With one, give 0, the "
                                   "given motion, or 180, its mirror image.",
                                   value));
            }
        }
        return;
    }
    if (grid.find("pga") != nullptr) {
        refuse("pga", " is not unique: the peak of two horizontal components depends on the "
                      "direction. Give scale, a factor on the record.");
    }
    if (directions == nullptr) {
        refuse("direction", " is missing. Two horizontal components need a direction in degrees, "
                            "from the first component towards the second one.");
    }
    for (const auto& record : scene.records()) {
        if (record->peak() == 0 || std::ranges::all_of(record->second(), is_zero)) {
            refuse("direction", " needs two horizontal components, but one of them is zero at all "
                                "times. Correct it, or give the other one alone.");
        }
    }
}

/// Refuses strengths at all of which the vertical motion of every record cancels gravity.
void expect_gravity(const Scene& scene, const Grid& grid)
{
    const std::vector<Extent> scales = scales_of(scene, grid);
    if (scales.empty()) {
        return;
    }
    const Accelerogram* weakest = nullptr; // of those with points
    for (std::size_t i = 0; i < scales.size(); ++i) {
        const Accelerogram& record = *scene.records()[i];
        if (scales[i].first < record.free_fall_scale()) {
            return;
        }
        if (std::isfinite(scales[i].first) && weakest == nullptr) {
            weakest = &record;
        }
    }
    const std::string_view name = grid.find("pga") != nullptr ? "pga" : "scale";
    refuse(name,
           fmt::format(" = {:.6g}: from here on, the vertical motion cancels gravity under "
                       "every record. Choose a value below the scale {:.6g}, at which the "
                       "horizontal peak is {:.6g} g.",
                       extent_of(Coordinates(scene, grid).of(name).values).first,
                       weakest->free_fall_scale(), weakest->free_fall_scale() * weakest->peak()));
}

/// Throws GivenError unless the quantities describe the block, its loss at impacts and the motion
/// completely, and what follows from them is allowed.
void expect_valid(const Scene& scene, const Grid& grid)
{
    const Grid corners = corners_of(grid);
    const Coordinates coordinates(scene, corners);
    expect_block(coordinates, grid);
    expect_motion(scene, coordinates, grid);
    expect_directions(scene, grid);
    expect_limits(coordinates, corners);
    expect_metres(scene, coordinates, corners);
    expect_gravity(scene, corners);
    if (grid.may_slip() && !has_contact_forces(scene.theory)) {
        refuse("friction",
               fmt::format(" is not possible: the {} theory has no forces of the contact. "
                           "Remove it, or use theory = \"nonlinear\".",
                           name_of(scene.theory)));
    }
}

} // namespace

Grid grid_of(const Scene& scene, std::vector<Given> given)
{
    // In the order of all_quantities(), into which these are pointers.
    std::ranges::stable_sort(given, {}, &Given::quantity);
    expect_no_alternatives(given);
    Grid grid;
    Dimension table{std::string(table_dimension), {}};
    for (Given& each : given) {
        Column column{each.quantity, std::move(each.values)};
        if (each.as == GivenAs::column) {
            table.columns.push_back(std::move(column));
        } else if (each.as == GivenAs::number) {
            grid.numbers.push_back(std::move(column));
        } else {
            grid.dimensions.push_back({std::string(each.quantity->name), {std::move(column)}});
        }
    }
    if (!table.columns.empty()) {
        grid.dimensions.push_back(std::move(table));
    }
    // The rows of a table have the place of the width, the first quantity of a block.
    std::ranges::stable_sort(grid.dimensions, {}, [&](const Dimension& dimension) {
        return order_of(dimension.name, scene.motion_traits());
    });
    expect_valid(scene, grid);
    return grid;
}

} // namespace overturn
