#include "overturn/sweep/compute_tile.hpp"

#include "point_run.hpp"

#include "overturn/problem/coordinates.hpp"
#include "overturn/sweep/boundary.hpp"
#include "overturn/sweep/fill.hpp"
#include "overturn/text/is_one_of.hpp"
#include "overturn/text/mapped.hpp"

#include <cassert>
#include <cmath>
#include <limits>
#include <map>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace overturn {

namespace {

/// The values of of_point(i, outcome) for all points.
template <class Value, class OfPoint>
FieldValues values_of(const Outcomes& outcomes, const OfPoint& of_point)
{
    std::vector<Value> values(std::size_t(outcomes.size()));
    for (int i = 0; i < outcomes.size(); ++i) {
        values[std::size_t(i)] = Value(of_point(i, outcomes[i]));
    }
    return values;
}

/// A field of a spectrum that is not filled.
FieldValues values_of(Field field, const PointRun& points, const Outcomes& outcomes)
{
    const auto numbers = [&](const auto& of_point) {
        return values_of<double>(outcomes, of_point);
    };
    switch (field) {
    case Field::region:
        return values_of<std::uint8_t>(outcomes, [](int, const Outcome& at) { return at.region; });
    case Field::angle: return numbers([](int, const Outcome& at) { return at.with_sign(at.tilt); });
    case Field::velocity:
        return numbers([&](int i, const Outcome& at) { return points.velocity(i, at); });
    case Field::margin: return numbers([](int, const Outcome& at) { return at.margin; });
    case Field::error: return numbers([](int, const Outcome& at) { return at.error; });
    case Field::peak: return numbers([&](int i, const Outcome& at) { return points.peak(i, at); });
    case Field::fall_time:
        return numbers([&](int i, const Outcome& at) { return points.fall_time(i, at); });
    case Field::friction: return numbers([](int, const Outcome& at) { return at.friction; });
    case Field::normal: return numbers([](int, const Outcome& at) { return at.normal; });
    case Field::impacts:
        return values_of<std::uint16_t>(outcomes, [&](int, const Outcome& at) {
            return at.stored_impacts(points.scene().is_recorded());
        });
    case Field::steps:
        return values_of<std::uint32_t>(outcomes, [](int, const Outcome& at) { return at.steps; });
    default: break;
    }
    assert(field == Field::status);
    return values_of<std::uint8_t>(outcomes, [&](int, const Outcome& at) {
        const bool lifts_off = outcomes.outputs.contact && at.normal <= 0;
        return (at.flags & outcome_flag::of_status) | (lifts_off ? status::lifts_off : 0);
    });
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
    const auto wanted = [&problem](Field field) { return is_one_of(field, problem.fields); };
    const bool has_contact = wanted(Field::friction) || wanted(Field::normal);
    const PointRun points(scene, Coordinates(scene, grid, tile).points(), kernel, drop_requested,
                          !grid.has_two_sides());
    const Outcomes outcomes = outcomes_of(
        points, numerics,
        {.impacts = wanted(Field::impacts),
         .error = wanted(Field::error),
         .peak = wanted(Field::peak),
         .region = wanted(Field::region) || wanted(Field::peak) || wanted(Field::fall_time),
         .margin = wanted(Field::margin),
         .steps = wanted(Field::steps),
         .phase = wanted(Field::fall_time),
         .contact = has_contact});
    const auto computed = [&](Field field) { return values_of(field, points, outcomes); };
    return {.values = mapped(fields, computed)};
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
    return {.values = mapped(fields, [&](Field field) { return computed.at(field); })};
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
