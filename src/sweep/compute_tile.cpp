#include "overturn/sweep/compute_tile.hpp"

#include "point_run.hpp"

#include "overturn/problem/coordinates.hpp"
#include "overturn/sweep/boundary.hpp"
#include "overturn/sweep/fill.hpp"
#include "overturn/text/mapped.hpp"

#include <cmath>
#include <map>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace overturn {

namespace {

/// A field of a spectrum that is not filled.
FieldValues values_of(Field field, const PointRun& points, const Outcomes& outcomes)
{
    FieldValues computed = not_computed({field.name}, points.size());
    traits_of(field).value.everywhere({points, outcomes.of_points.get()}, computed);
    return as_stored(field, std::move(computed));
}

/// What the fields of a spectrum need of the integration.
Outputs outputs_of(const std::vector<Field>& fields)
{
    Outputs outputs;
    for (const Field field : fields) {
        for (const auto output : traits_of(field).needs) {
            outputs.*output = true;
        }
    }
    return outputs;
}

TileFields fields_of(const FilledSpectrum&, const Problem& problem, const Tile& tile, Kernel kernel,
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

TileFields fields_of(const Spectrum&, const Problem& problem, const Tile& tile, Kernel kernel,
                     const DropRequested& drop_requested)
{
    const auto& [scene, grid, numerics, product, fields] = problem;
    const PointRun points(scene, Coordinates(scene, grid, tile).points(), kernel, drop_requested,
                          !grid.has_two_sides());
    const Outcomes outcomes = outcomes_of(points, numerics, outputs_of(fields));
    const auto computed = [&](Field field) { return values_of(field, points, outcomes); };
    return {.values = mapped(fields, computed)};
}

TileFields fields_of(const Boundaries& boundaries, const Problem& problem, const Tile& tile,
                     Kernel kernel, const DropRequested& drop_requested)
{
    const auto& [scene, grid, numerics, product, fields] = problem;
    const std::size_t along = boundaries.dimension(grid);
    Tile beginning = tile; // at the first value
    beginning.begin[along] = 0;
    beginning.count[along] = 1;
    const Point point = Coordinates(scene, grid, beginning).points().front();
    const Column& scanned = grid.dimensions[along].columns.front();
    const std::vector<double> values = scanned.values.values();
    const bool is_pga = scanned.quantity->name == "pga";
    const double unit = pga_of_unit(scene, point);
    FlipSearch search = flip_search(scene, may_slip(point));
    search.most_flips = std::size_t(tile.points());
    search.drop_requested = drop_requested;
    const double of_direction = std::signbit(point.amplitude) ? -1 : 1; // mirrored
    const BoundaryLine strengths{.point = point, .unit = of_direction * (is_pga ? unit : 1)};
    const Boundary boundary =
        boundaries.along == nullptr
            ? boundary_on(scene, strengths, values, kernel, search)
            : boundary_on(scene, line_along(*boundaries.along, grid, beginning.begin), values,
                          kernel, search);
    std::vector<double> value(search.most_flips, unknown_value);
    std::vector<double> amplitude = value;
    std::vector<double> pga = value;
    std::vector<std::uint8_t> below(search.most_flips, no_flip);
    std::vector<std::uint8_t> above = below;
    below.front() = std::uint8_t(boundary.region_at_first);
    for (std::size_t i = 0; i < boundary.flips.size(); ++i) {
        const Flip& flip = boundary.flips[i];
        value[i] = flip.value();
        amplitude[i] = is_pga ? flip.value() / unit : flip.value();
        pga[i] = is_pga ? flip.value() : flip.value() * unit;
        below[i] = std::uint8_t(flip.region_below);
        above[i] = std::uint8_t(flip.region_above);
    }
    if (boundary.has_more) {
        above.back() = std::uint8_t(Region::undecided);
    }
    const std::map<std::string_view, FieldValues> computed{
        {"flip_amplitude", std::move(amplitude)},
        {"flip_value", std::move(value)},
        {"region_below", std::move(below)},
        {"region_above", std::move(above)},
        {"flip_pga", std::move(pga)},
        {"unsafe_share", std::vector{boundary.unsafe_share}},
        {"undecided_share", std::vector{boundary.undecided_share}}};
    return {.values = mapped(fields, [&](Field field) { return computed.at(field.name); })};
}

} // namespace

TileFields compute_tile(const Problem& problem, const Tile& tile, Kernel kernel,
                        const DropRequested& drop_requested)
{
    const auto of = [&](const auto& product) {
        return fields_of(product, problem, tile, kernel, drop_requested);
    };
    return std::visit(of, problem.product);
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
