#include "overturn/sweep/compute_tile.hpp"

#include "point_run.hpp"

#include "overturn/problem/coordinates.hpp"
#include "overturn/sweep/boundary.hpp"
#include "overturn/sweep/fill.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

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

/// An angle or a velocity with its sign; NaN if the integration did not reach the end.
std::vector<double> with_sign(const std::vector<double>& values, const Outcomes& outcomes)
{
    return for_each_of<double>(outcomes, [&](std::size_t i) {
        const double value = outcomes.side[i] > 0 ? values[i] : 0.0 - values[i]; // 0 - 0 is +0
        return outcomes.flags[i] & outcome_flag::without_end
                   ? std::numeric_limits<double>::quiet_NaN()
                   : value;
    });
}

/// The rates in units of p of the side plus.
std::vector<double> rates_of(const PointRun& points, const Outcomes& outcomes)
{
    std::vector<double> rates = outcomes.rate;
    for (std::size_t i = 0; i < rates.size(); ++i) {
        const Block<double>& block = points.point(int(i)).block;
        if (!block.is_symmetric()) {
            rates[i] *= points.block_at_end(i, outcomes).pace / block.pace;
        }
    }
    return rates;
}

/// A field of a spectrum that is not filled. `region`, `margin` and `error` are not computed here:
/// spectrum_tile() moves them from the outcomes. A filled spectrum has its own values, see
/// filled_tile().
FieldValues values_of(Field field, const PointRun& points, const Outcomes& outcomes,
                      const std::vector<ContactDemand<double>>& demands)
{
    switch (field) {
    case Field::angle: return with_sign(outcomes.tilt, outcomes);
    case Field::velocity:
        return points.are_symmetric() ? with_sign(outcomes.rate, outcomes)
                                      : with_sign(rates_of(points, outcomes), outcomes);
    case Field::peak: return points.peaks(outcomes);
    case Field::fall_time: return points.fall_times(outcomes);
    case Field::friction:
    case Field::normal:
        return for_each_of<double>(outcomes, [&](std::size_t i) {
            return field == Field::friction ? demands[i].friction : demands[i].normal;
        });
    case Field::impacts:
        return for_each_of<std::uint16_t>(outcomes, [&](std::size_t i) {
            return outcomes.stored_impacts(i, points.scene().is_recorded());
        });
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
                   flag(outcome_flag::free_fall, status::free_fall) |
                   (!demands.empty() && demands[i].normal <= 0 ? status::lifts_off : 0);
        });
    default:
        return {}; // moved from the outcomes later, because `peak` and `fall_time` read the
                   // regions; or fields of other products
    }
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

TileFields spectrum_tile(const Problem& problem, const Tile& tile, Kernel kernel,
                         const DropRequested& drop_requested)
{
    const auto& [scene, grid, numerics, product, fields] = problem;
    const auto wanted = [&fields = fields](Field field) {
        return std::find(fields.begin(), fields.end(), field) != fields.end();
    };
    const bool watches = wanted(Field::friction) || wanted(Field::normal);
    const PointRun points(scene, Coordinates(scene, grid, tile).points(), kernel, drop_requested,
                          !grid.has_two_sides());
    Outcomes outcomes = outcomes_of(points, numerics,
                                    {.impacts = wanted(Field::impacts),
                                     .error = wanted(Field::error),
                                     .peak = wanted(Field::peak),
                                     .region = wanted(Field::region) || wanted(Field::peak) ||
                                               wanted(Field::fall_time) || watches,
                                     .margin = wanted(Field::margin),
                                     .steps = wanted(Field::steps),
                                     .phase = wanted(Field::fall_time)});
    const auto demands = watches ? points.contact_demands(numerics, outcomes.region)
                                 : std::vector<ContactDemand<double>>();
    TileFields result;
    for (const Field field : fields) {
        result.values.push_back(values_of(field, points, outcomes, demands));
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

TileFields boundary_tile(const Problem& problem, const Tile& tile, Kernel kernel,
                         const DropRequested& drop_requested)
{
    const auto& [scene, grid, numerics, product, fields] = problem;
    const std::size_t along = *grid.dimension_of(Role::strength);
    Tile beginning = tile; // at the first strength
    beginning.begin[along] = 0;
    beginning.count[along] = 1;
    const Point point = Coordinates(scene, grid, beginning).points().front();
    const Column& strengths = grid.dimensions[along].columns.front();
    const bool is_pga = strengths.quantity->name == "pga";
    const double unit = pga_of_unit(scene, point);
    FlipSearch search = flip_search(scene);
    search.most_flips = std::size_t(tile.points());
    search.drop_requested = drop_requested;
    const double of_direction = std::signbit(point.amplitude) ? -1 : 1; // mirrored
    const Boundary boundary =
        boundary_on(scene, {.point = point, .unit = of_direction * (is_pga ? unit : 1)},
                    strengths.values.values(), kernel, search);
    std::vector<double> amplitude(search.most_flips, std::numeric_limits<double>::quiet_NaN());
    std::vector<double> pga = amplitude;
    std::vector<std::uint8_t> below(search.most_flips, no_flip);
    std::vector<std::uint8_t> above = below;
    below.front() = std::uint8_t(boundary.region_at_first);
    for (std::size_t i = 0; i < boundary.flips.size(); ++i) {
        const Flip& flip = boundary.flips[i];
        amplitude[i] = is_pga ? flip.amplitude() / unit : flip.amplitude();
        pga[i] = is_pga ? flip.amplitude() : flip.amplitude() * unit;
        below[i] = std::uint8_t(flip.region_below);
        above[i] = std::uint8_t(flip.region_above);
    }
    if (boundary.has_more) {
        above.back() = std::uint8_t(Region::undecided);
    }
    const std::map<Field, FieldValues> computed{
        {Field::flip_amplitude, std::move(amplitude)},
        {Field::region_below, std::move(below)},
        {Field::region_above, std::move(above)},
        {Field::flip_pga, std::move(pga)},
        {Field::unsafe_share, std::vector{boundary.unsafe_share}},
        {Field::undecided_share, std::vector{boundary.undecided_share}}};
    TileFields result;
    for (const Field field : fields) {
        result.values.push_back(computed.at(field));
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
