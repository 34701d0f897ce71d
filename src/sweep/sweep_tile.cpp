#include "overturn/sweep/sweep_tile.hpp"

#include "point_run.hpp"

#include <algorithm>
#include <limits>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace overturn {

namespace {

/// The values of of_point(i) for all points.
template <class Value, class OfPoint>
std::vector<Value> for_each_of(const Ends& ends, const OfPoint& of_point)
{
    std::vector<Value> result(std::size_t(ends.size()));
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = Value(of_point(i));
    }
    return result;
}

/// An angle or a velocity with its sign; NaN if the point is undecided.
std::vector<double> with_sign(const std::vector<double>& values, const Ends& ends)
{
    return for_each_of<double>(ends, [&](std::size_t i) {
        const double value = ends.side[i] > 0 ? values[i] : 0.0 - values[i]; // 0 - 0 is +0
        return ends.flags[i] & end_flag::undecided ? std::numeric_limits<double>::quiet_NaN()
                                                   : value;
    });
}

/// recorded: whether the ground motion is a record, under which a block may be lifted again after a
/// bounce series.
FieldValues values_of(Field field, const PointRun& points, const Ends& ends, bool recorded)
{
    switch (field) {
    case Field::angle: return with_sign(ends.tilt, ends);
    case Field::velocity: return with_sign(ends.rate, ends);
    case Field::peak: return points.peaks(ends);
    case Field::fall_time: return points.fall_times(ends);
    case Field::impacts:
        return for_each_of<std::uint16_t>(ends, [&](std::size_t i) {
            return !recorded && (ends.flags[i] & end_flag::rested)
                       ? impact_count::bounce_series
                       : std::min(ends.impacts[i], double(impact_count::largest));
        });
    case Field::steps: return std::vector<std::uint32_t>(ends.steps.begin(), ends.steps.end());
    case Field::status:
        return for_each_of<std::uint8_t>(ends, [&](std::size_t i) {
            const auto flag = [&](std::uint8_t in, std::uint8_t out) {
                return ends.flags[i] & in ? out : 0;
            };
            return flag(end_flag::rested, status::came_to_rest) |
                   flag(end_flag::capped, status::cap_was_hit) |
                   flag(end_flag::not_finite, status::not_finite) |
                   flag(end_flag::unresolved, status::unresolved) |
                   flag(end_flag::free_fall, status::free_fall);
        });
    default: return {}; // fields of a boundary, or fields moved from the ends by the caller
    }
}

} // namespace

TileFields sweep_tile(const Scene& scene, const Numerics& numerics, const Plane& plane,
                      const Tile& tile, const std::vector<Field>& fields, Kernel kernel,
                      DropRequested drop_requested)
{
    const auto wanted = [&](Field field) {
        return std::find(fields.begin(), fields.end(), field) != fields.end();
    };
    const PointRun points(scene, points_of(scene, plane, tile), kernel, std::move(drop_requested),
                          motion_of(scene, tile));
    Ends ends =
        ends_of(points, numerics,
                {.impacts = wanted(Field::impacts),
                 .error = wanted(Field::error),
                 .peak = wanted(Field::peak),
                 .region = wanted(Field::region) || wanted(Field::peak) || wanted(Field::fall_time),
                 .margin = wanted(Field::margin),
                 .steps = wanted(Field::steps),
                 .phase = wanted(Field::fall_time)});
    TileFields result;
    for (const Field field : fields) {
        result.values.push_back(values_of(field, points, ends, scene.is_recorded()));
    }
    for (std::size_t i = 0; i < fields.size(); ++i) { // these arrays are no longer used
        if (fields[i] == Field::region) {
            result.values[i] = std::move(ends.region);
        } else if (fields[i] == Field::margin) {
            result.values[i] = std::move(ends.margin);
        } else if (fields[i] == Field::error) {
            result.values[i] = std::move(ends.error);
        }
    }
    return result;
}

void keep_freed_memory()
{
#if defined(__GLIBC__)
    constexpr int most = 256 << 20; // bytes
    mallopt(M_TRIM_THRESHOLD, most);
    mallopt(M_MMAP_THRESHOLD, 32 << 20); // the largest value that is allowed
#endif
}

} // namespace overturn
