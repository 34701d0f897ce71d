// What the coordinates of a job mean in degrees, metres, seconds and g.
#pragma once

#include "overturn/job/job.hpp"
#include "overturn/mechanics/block.hpp"
#include "overturn/mechanics/contact.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/problem/given.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

namespace overturn {

inline double in_degrees(double angle)
{
    return angle * 180 / std::numbers::pi;
}

/// The extent of a coordinate over all points of a job; nullopt if the coordinate is not known.
inline std::optional<Extent> extent_of(const Job& job, std::string_view name)
{
    const Grid corners = corners_of(job.problem.grid);
    const Coordinates coordinates(job.problem.scene, corners);
    return coordinates.has(name) ? std::optional(extent_of(coordinates.of(name))) : std::nullopt;
}

inline std::string degrees_text(const Extent& angle)
{
    return Extent{in_degrees(angle.first), in_degrees(angle.last)}.text(" degrees");
}

/// What describes blocks with two different sides: alpha, p and R of the sides plus and minus,
/// r_max.
inline std::string two_sides_line(const Job& job)
{
    const auto of_both = [&](std::string_view plus, std::string_view minus, const auto& text) {
        return fmt::format("{} (+), {} (-)", text(*extent_of(job, plus)),
                           text(*extent_of(job, minus)));
    };
    const auto in = [](std::string_view unit) {
        return [unit](const Extent& extent) { return extent.text(unit); };
    };
    return fmt::format("alpha = {}; R = {}; p = {} (g = {} m/s2); r_max = {}{}",
                       of_both("slenderness_plus", "slenderness_minus", degrees_text),
                       of_both("size_plus", "size_minus", in(" m")),
                       of_both("frequency_parameter", "frequency_parameter_minus", in(" 1/s")),
                       job.problem.scene.gravity, extent_of(job, "largest_restitution")->text(""),
                       job.blocks ? ", r = " + extent_of(job, "restitution")->text("") : "");
}

/// r_max of the only block of a job, if it exists.
inline std::optional<double> r_max_of_only_block(const Job& job)
{
    return job.problem.grid.has_two_sides()
               ? std::optional(extent_of(job, "largest_restitution")->first)
               : r_max_of(extent_of(job, "slenderness")->first);
}

/// A line about the blocks.
inline std::string block_line(const Job& job)
{
    std::string line;
    if (job.blocks) {
        line = fmt::format("{} of {}: ", job.blocks->table.rows(), job.blocks->file);
    }
    if (job.problem.grid.has_two_sides()) {
        return line + two_sides_line(job);
    }
    const Extent alpha = *extent_of(job, "slenderness");
    line += "alpha = " + Extent{in_degrees(alpha.first), in_degrees(alpha.last)}.text(" degrees");
    if (job.blocks) {
        line += ", r = " + extent_of(job, "restitution")->text("");
    } else if (const auto least = r_max_of(alpha.last)) {
        line += ", r_max = " + Extent{*least, largest_restitution(alpha.first)}.text("");
    }
    if (const auto size = extent_of(job, "size")) {
        line += fmt::format(", R = {}, p = {} (g = {} m/s2)", size->text(" m"),
                            extent_of(job, "frequency_parameter")->text(" 1/s"),
                            job.problem.scene.gravity);
    }
    return line;
}

/// A line about the friction coefficients that rocking needs.
inline std::string contact_line(const Job& job)
{
    constexpr double large = 0.7;
    constexpr double never = std::numeric_limits<double>::infinity();
    Extent lift{never, 0};
    Extent impact{never, 0};
    const auto include = [](Extent& extent, double value) {
        extent = {std::min(extent.first, value), std::max(extent.last, value)};
    };
    const Grid corners = corners_of(job.problem.grid);
    for (const Point& point : Coordinates(job.problem.scene, corners).points()) {
        const ContactSides<double> sides(point.block, point.gyration);
        const Block<double> other = point.block.turned();
        include(lift, friction_to_lift(sides.plus, point.block.slenderness));
        include(lift, friction_to_lift(sides.minus, other.slenderness));
        include(impact, friction_of_impact(point.block, sides.plus, sides.minus));
        include(impact, friction_of_impact(other, sides.minus, sides.plus));
    }
    const auto text = [](const Extent& extent) {
        return extent.first == extent.last
                   ? fmt::format("{:.3g}", extent.first)
                   : fmt::format("{:.3g} to {:.3g}", extent.first, extent.last);
    };
    return fmt::format("lifting needs a friction coefficient of {} (b / h), an impact {}{}",
                       text(lift), text(impact),
                       lift.last > large ? fmt::format("; few contacts have more than {}", large)
                                         : "");
}

/// A line about the ground motions.
inline std::string ground_line(const Job& job)
{
    std::string line = "peak " + extent_of(job, "pga")->text(" g");
    if (const auto period = extent_of(job, "pulse_period")) {
        line = fmt::format("period {}, {}", period->text(" s"), line);
    }
    const Dimension* table = job.problem.grid.table();
    const auto has = [&](Role role) {
        return table != nullptr && std::ranges::any_of(table->columns, [&](const Column& column) {
                   return column.quantity->role == role;
               });
    };
    if (has(Role::motion) || has(Role::rate)) {
        line += has(Role::motion) ? ", each block under a record of its own"
                                  : ", each block under a pulse of its own";
    }
    return line;
}

} // namespace overturn
