#include "estimate.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace overturn {

namespace {

constexpr double sampling_time = 0.3; // [s]

/// Points of a sample: along frequency, as the lanes of a kernel want them.
constexpr std::int64_t sample_length = 16;

/// The i-th index of an axis. Over many i all four axes are covered evenly: the fractions are those
/// of a Kronecker sequence with powers of 1/g, where g^5 = g + 1.
std::int64_t spread_index(std::int64_t i, int axis, std::int64_t size)
{
    constexpr double g = 1.1673039782614187;
    double whole = 0;
    const double fraction = std::modf(0.5 + double(i) * std::pow(g, -(axis + 1)), &whole);
    return std::min(std::int64_t(fraction * double(size)), size - 1);
}

Tile sample_tile(const Plane& plane, std::int64_t i)
{
    Tile tile;
    tile.outer = {spread_index(i, 0, plane.slenderness.size()),
                  spread_index(i, 1, plane.restitution.size())};
    tile.row_begin = spread_index(i, 2, plane.amplitude.size());
    tile.row_count = 1;
    tile.column_count = std::min(sample_length, plane.frequency.size());
    tile.column_begin = spread_index(i, 3, plane.frequency.size() - tile.column_count + 1);
    return tile;
}

} // namespace

double estimated_seconds(const Job& job, Kernel kernel)
{
    using Clock = std::chrono::steady_clock;
    const auto compute_sample = [&](std::int64_t i) {
        const Tile tile = sample_tile(job.plane, i);
        sweep_tile(job.scene, job.numerics, job.plane, tile, job.fields, kernel);
        return tile.points();
    };
    compute_sample(0); // the first one pays for cold caches

    const std::int64_t all_points = job.plane.points();
    std::int64_t points = 0;
    double seconds = 0;
    const auto start = Clock::now();
    for (std::int64_t i = 0; seconds < sampling_time && points < all_points; ++i) {
        points += compute_sample(i);
        seconds = std::chrono::duration<double>(Clock::now() - start).count();
    }
    return seconds * (double(all_points) / double(points));
}

} // namespace overturn
