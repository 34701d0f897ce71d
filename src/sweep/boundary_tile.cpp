#include "boundary_tile.hpp"

#include "overturn/problem/coordinates.hpp"
#include "overturn/sweep/boundary.hpp"

#include <limits>
#include <map>

namespace overturn {

namespace {

/// The fields of a boundary in the making; flips of a line are `stride` values apart.
struct BoundaryFields {
    explicit BoundaryFields(std::size_t flips, std::size_t lines)
        : amplitude(flips, std::numeric_limits<double>::quiet_NaN()), pga(amplitude),
          unsafe_share(lines), undecided_share(lines), below(flips, no_flip), above(flips, no_flip)
    {}

    std::vector<double> amplitude, pga, unsafe_share, undecided_share;
    std::vector<std::uint8_t> below, above;
};

/// The dimensions slower and faster than that of the flips.
struct Extents {
    std::size_t slower = 1;
    std::size_t flips = 1;
    std::size_t faster = 1;
};

Extents extents_of(const Tile& tile, std::size_t strength)
{
    Extents extents;
    for (std::size_t i = 0; i < tile.count.size(); ++i) {
        (i < strength   ? extents.slower
         : i > strength ? extents.faster
                        : extents.flips) *= std::size_t(tile.count[i]);
    }
    return extents;
}

} // namespace

TileFields boundary_tile(const Problem& problem, const Tile& tile, Kernel kernel,
                         const DropRequested& drop_requested)
{
    const auto& [scene, grid, numerics, product, requested] = problem;
    const std::size_t strength = *grid.dimension_of(Role::strength);
    const auto [slower, flips, faster] = extents_of(tile, strength);
    Tile lines = tile; // with the first strength only
    lines.begin[strength] = 0;
    lines.count[strength] = 1;
    const Coordinates coordinates(scene, grid, lines);
    const std::vector<Point> points = coordinates.points();
    const std::vector<std::int64_t> motions = coordinates.motions();
    const Column& strengths = grid.dimensions[strength].columns.front();
    const bool is_pga = strengths.quantity->name == "pga";
    BoundaryFields to(slower * flips * faster, points.size());
    for (std::size_t line = 0; line < points.size(); ++line) {
        const Point& at = points[line];
        const std::int64_t motion = motions.empty() ? 0 : motions[line];
        const double pga_of_unit = scene.is_recorded()
                                       ? scene.records[std::size_t(motion)]->peak()
                                       : uplift_threshold(scene.theory, at.slenderness);
        const double unit = is_pga ? pga_of_unit : 1;
        const Boundary boundary =
            boundary_on(scene,
                        {.slenderness = at.slenderness,
                         .restitution = at.restitution,
                         .frequency = at.frequency,
                         .motion = motion,
                         .unit = unit},
                        strengths.values.values(), kernel, flips, drop_requested);
        const std::size_t first = line / faster * flips * faster + line % faster;
        to.unsafe_share[line] = boundary.unsafe_share;
        to.undecided_share[line] = boundary.undecided_share;
        to.below[first] = std::uint8_t(boundary.region_at_first);
        for (std::size_t i = 0; i < boundary.flips.size(); ++i) {
            const Flip& flip = boundary.flips[i];
            const std::size_t place = first + i * faster;
            to.amplitude[place] = flip.amplitude() / unit;
            to.pga[place] = is_pga ? flip.amplitude() : flip.amplitude() * pga_of_unit;
            to.below[place] = std::uint8_t(flip.region_below);
            to.above[place] = std::uint8_t(flip.region_above);
        }
        if (boundary.has_more) {
            to.above[first + (flips - 1) * faster] = std::uint8_t(Region::undecided);
        }
    }
    const std::map<Field, FieldValues> computed{
        {Field::flip_amplitude, std::move(to.amplitude)},
        {Field::region_below, std::move(to.below)},
        {Field::region_above, std::move(to.above)},
        {Field::flip_pga, std::move(to.pga)},
        {Field::unsafe_share, std::move(to.unsafe_share)},
        {Field::undecided_share, std::move(to.undecided_share)}};
    TileFields result;
    for (const Field field : requested) {
        result.values.push_back(computed.at(field));
    }
    return result;
}

} // namespace overturn
