// Boundaries as fields: a line in each column.
#include "overturn/sweep/boundary.hpp"

namespace overturn {

TileFields boundary_tile(const Scene& scene, const Plane& plane,
                         const std::vector<double>& amplitudes, const Tile& tile, Kernel kernel,
                         DropRequested drop_requested)
{
    const auto points = std::size_t(tile.points());
    std::vector<double> amplitude(points, std::numeric_limits<double>::quiet_NaN());
    std::vector<std::uint8_t> below(points, no_flip);
    std::vector<std::uint8_t> above(points, no_flip);
    const auto rows = std::size_t(tile.amplitude_count);
    const auto columns = std::size_t(tile.frequency_count);
    for (std::size_t column = 0; column < columns; ++column) {
        const BoundaryLine line{
            .slenderness = plane.slenderness[tile.slenderness],
            .restitution = plane.restitution_ratio(tile.slenderness, tile.restitution),
            .frequency = plane.frequency[tile.frequency_begin + std::int64_t(column)]};
        const Boundary boundary =
            boundary_on(scene, line, amplitudes, kernel, rows, drop_requested);
        below[column] = std::uint8_t(boundary.region_at_first);
        for (std::size_t row = 0; row < boundary.flips.size(); ++row) {
            const Flip& flip = boundary.flips[row];
            const std::size_t point = row * columns + column;
            amplitude[point] = flip.amplitude();
            below[point] = std::uint8_t(flip.region_below);
            above[point] = std::uint8_t(flip.region_above);
        }
        if (boundary.has_more) {
            above[(rows - 1) * columns + column] = std::uint8_t(Region::undecided);
        }
    }
    TileFields fields;
    fields.values = {std::move(amplitude), std::move(below), std::move(above)};
    return fields;
}

} // namespace overturn
