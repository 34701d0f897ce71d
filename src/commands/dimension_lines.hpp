// What the axes of a job mean in degrees, metres, seconds and g, and what looks mistaken.
#pragma once

#include "overturn/job/job.hpp"
#include "overturn/mechanics/block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace overturn {

inline double in_degrees(double angle)
{
    return angle * 180 / std::numbers::pi;
}

/// A range of values; only the first if both are equal.
struct Extent {
    double first;
    double last;

    /// unit: begins with a blank unless it is empty.
    std::string text(std::string_view unit) const
    {
        return first == last ? fmt::format("{:.4g}{}", first, unit)
                             : fmt::format("{:.4g} to {:.4g}{}", first, last, unit);
    }
};

/// f of the ends of an axis, ascending.
template <class Function>
Extent extent_of(const Axis& axis, const Function& f)
{
    const auto [first, last] = std::minmax({f(axis.first()), f(axis.last())});
    return {first, last};
}

/// Sizes R [m] of the blocks; nullopt if the job does not give them.
inline std::optional<Extent> sizes_of(const Job& job)
{
    const Plane& plane = job.plane;
    switch (plane.frequency_is) {
    case FrequencyQuantity::size: return Extent{plane.frequency.first(), plane.frequency.last()};
    case FrequencyQuantity::frequency_parameter:
        return extent_of(plane.frequency,
                         [&](double p) { return 3 * job.scene.gravity / (4 * p * p); });
    default: break;
    }
    return plane.size ? std::optional(Extent{*plane.size, *plane.size}) : std::nullopt;
}

/// p [1/s] of the only block of a job; nullopt if the job does not give its size.
inline std::optional<double> parameter_of_only_block(const Job& job)
{
    const auto sizes = sizes_of(job);
    return sizes ? std::optional(frequency_parameter(sizes->first, job.scene.gravity))
                 : std::nullopt;
}

/// Periods of the pulse [s]; nullopt under a record, or if the size of the block is not known.
inline std::optional<Extent> periods_of(const Job& job)
{
    const Plane& plane = job.plane;
    if (!plane.size) {
        return std::nullopt;
    }
    const double p = frequency_parameter(*plane.size, job.scene.gravity);
    return extent_of(plane.frequency, [&](double value) {
        return 2 * std::numbers::pi / (p * frequency_of_point(job.scene, plane, 0, value));
    });
}

/// Peak ground accelerations over g of all blocks and motions.
inline Extent accelerations_of(const Job& job)
{
    const Plane& plane = job.plane;
    if (plane.amplitude_is == AmplitudeQuantity::pga) {
        return {plane.amplitude.first(), plane.amplitude.last()};
    }
    Extent units{job.motions.empty() ? uplift_threshold(job.scene.theory, plane.slenderness.first())
                                     : job.motions.front().measures.pga,
                 0};
    units.last = job.motions.empty() ? uplift_threshold(job.scene.theory, plane.slenderness.last())
                                     : units.first;
    for (const Motion& motion : job.motions) {
        units = {std::min(units.first, motion.measures.pga),
                 std::max(units.last, motion.measures.pga)};
    }
    return {plane.amplitude.first() * units.first, plane.amplitude.last() * units.last};
}

/// f of all values of a list, which is not empty.
template <class Function>
Extent extent_of(const std::vector<double>& values, const Function& f)
{
    Extent extent{f(values.front()), f(values.front())};
    for (const double value : values) {
        extent = {std::min(extent.first, f(value)), std::max(extent.last, f(value))};
    }
    return extent;
}

/// The peak ground accelerations over g of the points of a list.
inline Extent accelerations_of_list(const Job& job)
{
    const BlockList& list = *job.plane.list;
    Extent all{std::numeric_limits<double>::infinity(), 0};
    for (std::size_t i = 0; i < list.slenderness.size(); ++i) {
        const auto add = [&](double amplitude, std::int64_t motion) {
            const double pga =
                amplitude * pga_of_unit_amplitude(job.scene, motion, list.slenderness[i]);
            all = {std::min(all.first, pga), std::max(all.last, pga)};
        };
        if (list.has_own_motions) {
            add(list.amplitude[i], list.motion.empty() ? 0 : list.motion[i]);
            continue;
        }
        for (std::int64_t motion = 0; motion < std::max<std::int64_t>(1, job.plane.motions);
             ++motion) {
            const double unit = amplitude_unit(job.scene, job.plane, motion, list.slenderness[i]);
            add(job.plane.amplitude.first() / unit, motion);
            add(job.plane.amplitude.last() / unit, motion);
        }
    }
    return all;
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
    std::string ground = "peak " + accelerations_of_list(job).text(" g");
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
    const auto sizes = sizes_of(job);
    if (sizes) {
        const Extent p{frequency_parameter(sizes->last, job.scene.gravity),
                       frequency_parameter(sizes->first, job.scene.gravity)};
        block += fmt::format(", R = {}, p = {} (g = {} m/s2)", sizes->text(" m"), p.text(" 1/s"),
                             job.scene.gravity);
    }
    std::string ground = "peak " + accelerations_of(job).text(" g");
    if (const auto periods = periods_of(job)) {
        ground = fmt::format("period {}, {}", periods->text(" s"), ground);
    }
    return {block, ground};
}

/// What looks like a mistake in the units.
inline std::vector<std::string> dimension_warnings(const Job& job)
{
    std::vector<std::string> lines;
    const Plane& plane = job.plane;
    if (plane.list) {
        const double alpha =
            extent_of(plane.list->slenderness, [](double value) { return value; }).last;
        if (alpha > 1) {
            lines.push_back(fmt::format("alpha reaches {:.4g} degrees, a block wider than 1.5 "
                                        "times its height; the column slenderness is in radians",
                                        in_degrees(alpha)));
        }
        return lines;
    }
    if (plane.slenderness.last() > 1) {
        lines.push_back(
            fmt::format("alpha reaches {:.4g} degrees, a block wider than 1.5 times its "
                        "height; plane.slenderness is in radians",
                        in_degrees(plane.slenderness.last())));
    }
    const auto periods = periods_of(job);
    if (periods && (periods->first < 0.02 || periods->last > 20)) {
        lines.push_back(fmt::format(
            "the period of the pulse {} {}; values outside 0.02 to 20 s suggest an error in the "
            "units. plane.frequency is omega_p / p, plane.pulse_frequency is in Hz, and lengths "
            "are in metres",
            periods->first == periods->last ? "is" : "ranges from", periods->text(" s")));
    }
    const double alpha = plane.slenderness.first();
    const double r = plane.restitution_ratio(0, plane.restitution.size() - 1);
    if (r > largest_restitution(alpha) * (1 + 1e-9)) {
        lines.push_back(fmt::format("r reaches {:.4g}, but r_max = {:.4g} for alpha = {:.4g} "
                                    "degrees (Eq. 17)",
                                    r, largest_restitution(alpha), in_degrees(alpha)));
    }
    return lines;
}

} // namespace overturn
