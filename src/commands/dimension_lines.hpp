// What the coordinates of a job mean in degrees, metres, seconds and g.
#pragma once

#include "overturn/job/job.hpp"
#include "overturn/mechanics/block.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/problem/given.hpp"

#include <fmt/format.h>

#include <cmath>
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

/// A line about the blocks.
inline std::string block_line(const Job& job)
{
    const Extent alpha = *extent_of(job, "slenderness");
    std::string line;
    if (job.blocks) {
        line = fmt::format("{} of {}: ", job.blocks->table.rows(), job.blocks->file);
    }
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
