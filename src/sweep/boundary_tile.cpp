#include "overturn/sweep/boundary.hpp"

#include "point_run.hpp"

#include <limits>

namespace overturn {

TileFields boundary_tile(const Scene& scene, const Plane& plane,
                         const std::vector<double>& amplitudes, const Tile& tile, Kernel kernel,
                         DropRequested drop_requested)
{
    const auto points = std::size_t(tile.points());
    std::vector<double> amplitude(points, std::numeric_limits<double>::quiet_NaN());
    std::vector<double> pga = amplitude;
    std::vector<std::uint8_t> below(points, no_flip);
    std::vector<std::uint8_t> above(points, no_flip);
    const auto columns = std::size_t(tile.columns());
    const std::size_t rows = points / columns;
    std::vector<double> unsafe_share(columns);
    std::vector<double> undecided_share(columns);
    const std::vector<PlanePoint> blocks = points_of(scene, plane, tile); // without their amplitude
    const std::int64_t motion = motion_of(scene, tile);
    const bool is_pga = plane.amplitude_is == AmplitudeQuantity::pga;
    for (std::size_t column = 0; column < columns; ++column) {
        const PlanePoint& block = blocks[column];
        const double pga_of_unit = pga_of_unit_amplitude(scene, motion, block.slenderness);
        const double unit = is_pga ? pga_of_unit : 1;
        const Boundary boundary = boundary_on(scene,
                                              {.slenderness = block.slenderness,
                                               .restitution = block.restitution,
                                               .frequency = block.frequency,
                                               .motion = motion,
                                               .unit = unit},
                                              amplitudes, kernel, rows, drop_requested);
        unsafe_share[column] = boundary.unsafe_share;
        undecided_share[column] = boundary.undecided_share;
        below[column] = std::uint8_t(boundary.region_at_first);
        for (std::size_t row = 0; row < boundary.flips.size(); ++row) {
            const Flip& flip = boundary.flips[row];
            const std::size_t point = row * columns + column;
            amplitude[point] = flip.amplitude() / unit;
            pga[point] = is_pga ? flip.amplitude() : flip.amplitude() * pga_of_unit;
            below[point] = std::uint8_t(flip.region_below);
            above[point] = std::uint8_t(flip.region_above);
        }
        if (boundary.has_more) {
            above[(rows - 1) * columns + column] = std::uint8_t(Region::undecided);
        }
    }
    TileFields fields;
    fields.values = {std::move(amplitude), std::move(below),        std::move(above),
                     std::move(pga),       std::move(unsafe_share), std::move(undecided_share)};
    if (!scene.is_recorded()) {
        fields.values.resize(boundary_fields(scene, plane).size());
    }
    return fields;
}

} // namespace overturn
