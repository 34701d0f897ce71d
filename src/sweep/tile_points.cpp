#include "tile_points.hpp"

namespace overturn {

namespace {

std::vector<PlanePoint> points_of_list(const Scene& scene, const Plane& plane, const Tile& tile)
{
    const BlockList& list = *plane.list;
    const bool is_recorded = scene.is_recorded() && !list.has_own_motions;
    const std::size_t block_axis = is_recorded ? 1 : 0;
    const auto axis_values = [&](const Axis& axis, std::size_t dimension) {
        return axis.values(tile.begin[dimension], tile.begin[dimension] + tile.count[dimension]);
    };
    std::vector<PlanePoint> points;
    points.reserve(std::size_t(tile.points()));
    for (std::int64_t i = 0; i < tile.count[block_axis]; ++i) {
        const auto block = std::size_t(tile.begin[block_axis] + i);
        PlanePoint point{list.slenderness[block], list.restitution[block], 0, 0};
        if (list.has_own_motions) {
            point.amplitude = list.amplitude[block];
            point.frequency = list.frequency[block];
            points.push_back(point);
            continue;
        }
        const double p = list.frequency_parameter.empty() ? 0 : list.frequency_parameter[block];
        const std::int64_t motion = motion_of(scene, tile);
        std::vector<double> frequencies =
            is_recorded ? std::vector{p} : axis_values(plane.frequency, 2);
        const auto quantity =
            is_recorded ? FrequencyQuantity::frequency_parameter : plane.frequency_is;
        for (double& value : frequencies) {
            value = frequency_of_point(scene, quantity, motion, value, p);
        }
        const double unit = amplitude_unit(scene, plane, motion, point.slenderness);
        for (const double value : axis_values(plane.amplitude, block_axis + 1)) {
            point.amplitude = value / unit;
            for (const double frequency : frequencies) {
                point.frequency = frequency;
                points.push_back(point);
            }
        }
    }
    return points;
}

} // namespace

std::int64_t motion_of(const Scene& scene, const Tile& tile)
{
    return scene.is_recorded() ? tile.begin.front() : 0;
}

TileAxes::TileAxes(const Scene& scene, const Plane& plane, const Tile& tile)
{
    const std::int64_t* begin = &tile.begin[tile.begin.size() - 4]; // of the last four dimensions
    const std::int64_t* count = &tile.count[tile.count.size() - 4];
    const std::int64_t motion = motion_of(scene, tile);
    slenderness = plane.slenderness[begin[0]];
    restitution = plane.restitution_ratio(begin[0], begin[1]);
    amplitudes = plane.amplitude.values(begin[2], begin[2] + count[2]);
    frequencies = plane.frequency.values(begin[3], begin[3] + count[3]);
    const double unit = amplitude_unit(scene, plane, motion, slenderness);
    for (double& amplitude : amplitudes) {
        amplitude /= unit;
    }
    for (double& frequency : frequencies) {
        frequency = frequency_of_point(scene, plane, motion, frequency);
    }
}

std::vector<PlanePoint> points_of(const Scene& scene, const Plane& plane, const Tile& tile)
{
    if (plane.list) {
        return points_of_list(scene, plane, tile);
    }
    const TileAxes axes(scene, plane, tile);
    std::vector<PlanePoint> points;
    points.reserve(std::size_t(tile.points()));
    for (std::size_t row = 0; row < axes.amplitudes.size(); ++row) {
        for (std::size_t column = 0; column < axes.frequencies.size(); ++column) {
            points.push_back(axes(row, column));
        }
    }
    return points;
}

} // namespace overturn
