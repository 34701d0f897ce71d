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

/// r_max of a block (Eq. 17), which does not exist for wide ones.
inline std::optional<double> r_max_of(double slenderness)
{
    return slenderness < std::asin(std::sqrt(2.0 / 3))
               ? std::optional(largest_restitution(slenderness))
               : std::nullopt;
}

/// The extents of coordinates over all points of a job.
class JobExtents {
public:
    explicit JobExtents(const Job& job)
        : corners_(corners_of(job.problem.grid)), coordinates_(job.problem.scene, corners_)
    {}

    /// nullopt if the coordinate is not known.
    std::optional<Extent> of(std::string_view name) const
    {
        return coordinates_.has(name) ? std::optional(extent_of(coordinates_.of(name)))
                                      : std::nullopt;
    }

private:
    Grid corners_;
    Coordinates coordinates_;
};

/// A line about the blocks.
inline std::string block_line(const Job& job)
{
    const JobExtents extents(job);
    const Extent alpha = *extents.of("slenderness");
    std::string line;
    if (job.blocks) {
        line = fmt::format("{} of {}: ", job.blocks->table.rows(), job.blocks->file);
    }
    line += "alpha = " + Extent{in_degrees(alpha.first), in_degrees(alpha.last)}.text(" degrees");
    if (job.blocks) {
        line += ", r = " + extents.of("restitution")->text("");
    } else if (const auto least = r_max_of(alpha.last)) {
        line += ", r_max = " + Extent{*least, largest_restitution(alpha.first)}.text("");
    }
    if (const auto size = extents.of("size")) {
        line +=
            fmt::format(", R = {}, p = {} (g = {} m/s2)", size->text(" m"),
                        extents.of("frequency_parameter")->text(" 1/s"), job.problem.scene.gravity);
    }
    return line;
}

/// A line about the ground motions.
inline std::string ground_line(const Job& job)
{
    const JobExtents extents(job);
    std::string line = "peak " + extents.of("pga")->text(" g");
    if (const auto period = extents.of("pulse_period")) {
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
