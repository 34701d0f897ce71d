// What the axes of a job mean in degrees, metres, seconds and g.
#pragma once

#include "overturn/job/job.hpp"
#include "overturn/mechanics/block.hpp"
#include "overturn/sweep/extents.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace overturn {

inline double in_degrees(double angle)
{
    return angle * 180 / std::numbers::pi;
}

/// p [1/s] of the only block of a job; nullopt if the job does not give its size.
inline std::optional<double> parameter_of_only_block(const Job& job)
{
    const auto sizes = sizes_of(job.scene, job.plane);
    return sizes ? std::optional(frequency_parameter(sizes->first, job.scene.gravity))
                 : std::nullopt;
}

/// A line about the blocks of a list, and one about the ground motions.
inline std::vector<std::string> list_lines(const Job& job)
{
    const auto same = [](double value) { return value; };
    const BlockList& list = *job.plane.list;
    std::string block = fmt::format("{} of {}: alpha = {}, r = {}", list.size, job.blocks->file,
                                    extent_of(list.slenderness, in_degrees).text(" degrees"),
                                    extent_of(list.restitution, same).text(""));
    if (!list.frequency_parameter.empty()) {
        block +=
            fmt::format(", p = {} (g = {} m/s2)",
                        extent_of(list.frequency_parameter, same).text(" 1/s"), job.scene.gravity);
    }
    std::string ground = "peak " + accelerations_of(job.scene, job.plane).text(" g");
    if (list.has_own_motions) {
        ground += job.scene.is_recorded() ? ", each block under a record of its own"
                                          : ", each block under a pulse of its own";
    }
    return {block, ground};
}

/// A line about the blocks, and one about the ground motions.
inline std::vector<std::string> dimension_lines(const Job& job)
{
    if (job.plane.list) {
        return list_lines(job);
    }
    const Axis& slenderness = job.plane.slenderness;
    std::string block = "alpha = " + extent_of(slenderness, in_degrees).text(" degrees");
    if (slenderness.last() < std::asin(std::sqrt(2.0 / 3))) { // the limit of Eq. 17
        block += ", r_max = " + extent_of(slenderness, largest_restitution<double>).text("");
    }
    const auto sizes = sizes_of(job.scene, job.plane);
    if (sizes) {
        const Extent p{frequency_parameter(sizes->last, job.scene.gravity),
                       frequency_parameter(sizes->first, job.scene.gravity)};
        block += fmt::format(", R = {}, p = {} (g = {} m/s2)", sizes->text(" m"), p.text(" 1/s"),
                             job.scene.gravity);
    }
    std::string ground = "peak " + accelerations_of(job.scene, job.plane).text(" g");
    if (const auto periods = periods_of(job.scene, job.plane)) {
        ground = fmt::format("period {}, {}", periods->text(" s"), ground);
    }
    return {block, ground};
}

} // namespace overturn
