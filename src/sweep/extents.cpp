#include "overturn/sweep/extents.hpp"

#include <fmt/format.h>

#include <limits>
#include <numbers>

namespace overturn {

namespace {

double same(double value)
{
    return value;
}

/// R [m] of a block of this p [1/s].
double size_of_parameter(double parameter, double gravity)
{
    return 3 * gravity / (4 * parameter * parameter);
}

/// p [1/s] of the blocks under a pulse; nullopt if it is not known.
std::optional<Extent> parameters_under_pulse(const Scene& scene, const Plane& plane)
{
    if (plane.list) {
        const std::vector<double>& parameters = plane.list->frequency_parameter;
        return parameters.empty() ? std::nullopt : std::optional(extent_of(parameters, same));
    }
    if (!plane.size) {
        return std::nullopt;
    }
    const double parameter = frequency_parameter(*plane.size, scene.gravity);
    return Extent{parameter, parameter};
}

} // namespace

std::string Extent::text(std::string_view unit) const
{
    return first == last ? fmt::format("{:.4g}{}", first, unit)
                         : fmt::format("{:.4g} to {:.4g}{}", first, last, unit);
}

Extent slendernesses_of(const Plane& plane)
{
    return plane.list ? extent_of(plane.list->slenderness, same)
                      : extent_of(plane.slenderness, same);
}

std::optional<Extent> sizes_of(const Scene& scene, const Plane& plane)
{
    const auto size = [&](double parameter) { return size_of_parameter(parameter, scene.gravity); };
    if (plane.list) {
        const std::vector<double>& parameters = plane.list->frequency_parameter;
        return parameters.empty() ? std::nullopt : std::optional(extent_of(parameters, size));
    }
    switch (plane.frequency_is) {
    case FrequencyQuantity::size: return extent_of(plane.frequency, same);
    case FrequencyQuantity::frequency_parameter: return extent_of(plane.frequency, size);
    default: break;
    }
    return plane.size ? std::optional(Extent{*plane.size, *plane.size}) : std::nullopt;
}

std::optional<Extent> periods_of(const Scene& scene, const Plane& plane)
{
    const auto parameters = parameters_under_pulse(scene, plane);
    if (scene.is_recorded() || !parameters) {
        return std::nullopt;
    }
    if (plane.list && plane.list->has_own_motions) {
        Extent all{std::numeric_limits<double>::infinity(), 0};
        for (std::size_t i = 0; i < plane.list->frequency.size(); ++i) {
            const double period = 2 * std::numbers::pi /
                                  (plane.list->frequency_parameter[i] * plane.list->frequency[i]);
            all = {std::min(all.first, period), std::max(all.last, period)};
        }
        return all;
    }
    const auto with_parameter = [&](double parameter) {
        return extent_of(plane.frequency, [&](double value) {
            return 2 * std::numbers::pi /
                   (parameter * frequency_of_point(scene, plane.frequency_is, 0, value, parameter));
        });
    };
    const Extent slow = with_parameter(parameters->first);
    const Extent fast = with_parameter(parameters->last);
    return Extent{std::min(slow.first, fast.first), std::max(slow.last, fast.last)};
}

Extent accelerations_of(const Scene& scene, const Plane& plane)
{
    Extent all{std::numeric_limits<double>::infinity(), 0};
    const auto add = [&](double amplitude, std::size_t motion, double slenderness) {
        const double pga =
            amplitude * pga_of_unit_amplitude(scene, std::int64_t(motion), slenderness);
        all = {std::min(all.first, pga), std::max(all.last, pga)};
    };
    if (plane.list && plane.list->has_own_motions) {
        const BlockList& list = *plane.list;
        for (std::size_t i = 0; i < list.slenderness.size(); ++i) {
            add(list.amplitude[i], list.motion.empty() ? 0 : std::size_t(list.motion[i]),
                list.slenderness[i]);
        }
        return all;
    }
    if (plane.amplitude_is == AmplitudeQuantity::pga) {
        return extent_of(plane.amplitude, same);
    }
    const Extent slenderness = slendernesses_of(plane);
    for (std::size_t motion = 0; motion < std::max<std::size_t>(1, scene.records.size());
         ++motion) {
        add(plane.amplitude.first(), motion, slenderness.first);
        add(plane.amplitude.last(), motion, slenderness.last);
    }
    return all;
}

} // namespace overturn
