#include "overturn/sweep/plane.hpp"

#include "overturn/mechanics/block.hpp"
#include "overturn/sweep/tile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace overturn {

namespace {

double value_at(const AxisRange& range, std::int64_t i)
{
    if (i == 0) {
        return range.first;
    }
    if (i == range.count - 1) {
        return range.last;
    }
    const double share = double(i) / double(range.count - 1);
    if (range.spacing == Spacing::log) {
        return range.first * std::pow(range.last / range.first, share);
    }
    return range.first + (range.last - range.first) * double(i) / double(range.count - 1);
}

} // namespace

std::int64_t Axis::size() const
{
    if (const auto* range = std::get_if<AxisRange>(&definition_)) {
        return range->count;
    }
    return std::int64_t(std::get<AxisList>(definition_).size());
}

double Axis::operator[](std::int64_t i) const
{
    if (const auto* range = std::get_if<AxisRange>(&definition_)) {
        return value_at(*range, i);
    }
    return std::get<AxisList>(definition_)[std::size_t(i)];
}

std::vector<double> Axis::values(std::int64_t begin, std::int64_t end) const
{
    std::vector<double> result;
    result.reserve(std::size_t(end - begin));
    for (std::int64_t i = begin; i < end; ++i) {
        result.push_back((*this)[i]);
    }
    return result;
}

std::int64_t Plane::points() const
{
    return count_points(shape_of(*this));
}

double Plane::restitution_ratio(std::int64_t slenderness_index,
                                std::int64_t restitution_index) const
{
    const double value = restitution[restitution_index];
    return restitution_of == RestitutionOf::maximum
               ? value * largest_restitution(slenderness[slenderness_index])
               : value;
}

double half_diagonal(const BlockSize& block)
{
    return std::hypot(block.half_width, block.half_height);
}

double frequency_parameter(double half_diagonal, double gravity)
{
    return std::sqrt(3 * gravity / (4 * half_diagonal));
}

double pga_of_unit_amplitude(const Scene& scene, std::int64_t motion, double slenderness)
{
    return scene.is_recorded() ? scene.records[std::size_t(motion)]->peak()
                               : uplift_threshold(scene.theory, slenderness);
}

double lifting_pga(const Scene& scene, std::int64_t motion, double slenderness)
{
    const double threshold = uplift_threshold(scene.theory, slenderness);
    if (!scene.is_recorded()) {
        return threshold;
    }
    const Accelerogram& record = *scene.records[std::size_t(motion)];
    return record.peak() * record.lifting_scale(threshold);
}

double amplitude_unit(const Scene& scene, const Plane& plane, std::int64_t motion,
                      double slenderness)
{
    return plane.amplitude_is == AmplitudeQuantity::pga
               ? pga_of_unit_amplitude(scene, motion, slenderness)
               : 1;
}

double frequency_of_point(const Scene& scene, FrequencyQuantity quantity, std::int64_t motion,
                          double value, double parameter)
{
    const auto samples_per_unit = [&](double p) {
        return 1 / (p * scene.records[std::size_t(motion)]->time_step());
    };
    switch (quantity) {
    case FrequencyQuantity::frequency: break;
    case FrequencyQuantity::pulse_period: return 2 * std::numbers::pi / (value * parameter);
    case FrequencyQuantity::pulse_frequency: return 2 * std::numbers::pi * value / parameter;
    case FrequencyQuantity::size:
        return samples_per_unit(frequency_parameter(value, scene.gravity));
    case FrequencyQuantity::frequency_parameter: return samples_per_unit(value);
    }
    return value;
}

double frequency_of_point(const Scene& scene, const Plane& plane, std::int64_t motion, double value)
{
    const double parameter = plane.size ? frequency_parameter(*plane.size, scene.gravity) : 0;
    return frequency_of_point(scene, plane.frequency_is, motion, value, parameter);
}

double uplift_threshold(Theory theory, double slenderness)
{
    return with_theory(theory,
                       [&]<Theory known>() { return uplift_acceleration<known>(slenderness); });
}

} // namespace overturn
