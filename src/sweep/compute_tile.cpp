#include "overturn/sweep/compute_tile.hpp"

#include "boundary_tile.hpp"
#include "point_run.hpp"

#include "overturn/problem/coordinates.hpp"
#include "overturn/sweep/fill.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <type_traits>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace overturn {

namespace {

/// The values of of_point(i) for all points.
template <class Value, class OfPoint>
std::vector<Value> for_each_of(const Outcomes& outcomes, const OfPoint& of_point)
{
    std::vector<Value> result(std::size_t(outcomes.size()));
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = Value(of_point(i));
    }
    return result;
}

/// An angle or a velocity with its sign; NaN if the point is undecided.
std::vector<double> with_sign(const std::vector<double>& values, const Outcomes& outcomes)
{
    return for_each_of<double>(outcomes, [&](std::size_t i) {
        const double value = outcomes.side[i] > 0 ? values[i] : 0.0 - values[i]; // 0 - 0 is +0
        return outcomes.flags[i] & outcome_flag::undecided
                   ? std::numeric_limits<double>::quiet_NaN()
                   : value;
    });
}

/// recorded: whether the ground motion is a record.
FieldValues values_of(Field field, const PointRun& points, const Outcomes& outcomes, bool recorded)
{
    switch (field) {
    case Field::angle: return with_sign(outcomes.tilt, outcomes);
    case Field::velocity: return with_sign(outcomes.rate, outcomes);
    case Field::peak: return points.peaks(outcomes);
    case Field::fall_time: return points.fall_times(outcomes);
    case Field::impacts:
        return for_each_of<std::uint16_t>(
            outcomes, [&](std::size_t i) { return outcomes.stored_impacts(i, recorded); });
    case Field::steps:
        return std::vector<std::uint32_t>(outcomes.steps.begin(), outcomes.steps.end());
    case Field::status:
        return for_each_of<std::uint8_t>(outcomes, [&](std::size_t i) {
            const auto flag = [&](std::uint8_t in, std::uint8_t out) {
                return outcomes.flags[i] & in ? out : 0;
            };
            return flag(outcome_flag::rested, status::came_to_rest) |
                   flag(outcome_flag::capped, status::cap_was_hit) |
                   flag(outcome_flag::not_finite, status::not_finite) |
                   flag(outcome_flag::unresolved, status::unresolved) |
                   flag(outcome_flag::free_fall, status::free_fall);
        });
    default: return {}; // fields of a boundary, or fields moved from the outcomes by the caller
    }
}

TileFields fields_of(const PointRun& points, const Numerics& numerics,
                     const std::vector<Field>& fields, bool recorded)
{
    const auto wanted = [&](Field field) {
        return std::find(fields.begin(), fields.end(), field) != fields.end();
    };
    Outcomes outcomes = outcomes_of(
        points, numerics,
        {.impacts = wanted(Field::impacts),
         .error = wanted(Field::error),
         .peak = wanted(Field::peak),
         .region = wanted(Field::region) || wanted(Field::peak) || wanted(Field::fall_time),
         .margin = wanted(Field::margin),
         .steps = wanted(Field::steps),
         .phase = wanted(Field::fall_time)});
    TileFields result;
    result.values.reserve(fields.size());
    for (const Field field : fields) {
        result.values.push_back(values_of(field, points, outcomes, recorded));
    }
    for (std::size_t i = 0; i < fields.size(); ++i) { // these arrays are no longer used
        if (fields[i] == Field::region) {
            result.values[i] = std::move(outcomes.region);
        } else if (fields[i] == Field::margin) {
            result.values[i] = std::move(outcomes.margin);
        } else if (fields[i] == Field::error) {
            result.values[i] = std::move(outcomes.error);
        }
    }
    return result;
}

/// Copies the values of some points of a tile to their places in it.
void place(const FieldValues& from, const std::vector<std::size_t>& places, FieldValues& to)
{
    std::visit(
        [&](const auto& values) {
            auto& all = std::get<std::decay_t<decltype(values)>>(to);
            for (std::size_t i = 0; i < places.size(); ++i) {
                all[places[i]] = values[i];
            }
        },
        from);
}

TileFields filled_tile(const Problem& problem, const Tile& tile, Kernel kernel,
                       const DropRequested& drop_requested)
{
    FilledTile filled = fill_tile(problem, tile, kernel, drop_requested);
    TileFields result{.values = {}, .audit = filled.audit};
    for (const Field field : problem.fields) {
        if (field == Field::impacts) {
            result.values.emplace_back(std::move(filled.impacts));
        } else {
            result.values.emplace_back(
                std::move(field == Field::evaluated ? filled.evaluated : filled.region));
        }
    }
    return result;
}

/// The places of the points of each motion.
std::map<std::int64_t, std::vector<std::size_t>>
places_by_motion(const std::vector<std::int64_t>& motions)
{
    std::map<std::int64_t, std::vector<std::size_t>> places;
    for (std::size_t i = 0; i < motions.size(); ++i) {
        places[motions[i]].push_back(i);
    }
    return places;
}

TileFields spectrum_tile(const Problem& problem, const Tile& tile, Kernel kernel,
                         const DropRequested& drop_requested)
{
    const auto& [scene, grid, numerics, product, fields] = problem;
    const Coordinates coordinates(scene, grid, tile);
    std::vector<Point> points = coordinates.points();
    const auto places = places_by_motion(coordinates.motions());
    const bool recorded = scene.is_recorded();
    if (places.size() <= 1) {
        const std::int64_t motion = places.empty() ? 0 : places.begin()->first;
        const PointRun run(scene, std::move(points), kernel, drop_requested, motion);
        return fields_of(run, numerics, fields, recorded);
    }
    TileFields result;
    for (const Field field : fields) {
        result.values.push_back(make_field_values(field, points.size()));
    }
    for (const auto& [motion, places_of_motion] : places) {
        std::vector<Point> chosen;
        for (const std::size_t i : places_of_motion) {
            chosen.push_back(points[i]);
        }
        const PointRun run(scene, std::move(chosen), kernel, drop_requested, motion);
        const TileFields part = fields_of(run, numerics, fields, recorded);
        for (std::size_t i = 0; i < fields.size(); ++i) {
            place(part.values[i], places_of_motion, result.values[i]);
        }
    }
    return result;
}

} // namespace

TileFields compute_tile(const Problem& problem, const Tile& tile, Kernel kernel,
                        const DropRequested& drop_requested)
{
    return (problem.product == Product::boundary ? boundary_tile
            : problem.numerics.fill              ? filled_tile
                                    : spectrum_tile)(problem, tile, kernel, drop_requested);
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
