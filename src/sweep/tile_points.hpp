// The points of a tile.
#pragma once

#include "overturn/sweep/plane.hpp"
#include "overturn/sweep/tile.hpp"

#include <vector>

namespace overturn {

/// The points of a tile of a plane: one per amplitude and frequency.
struct TileAxes {
    TileAxes(const Scene& scene, const Plane& plane, const Tile& tile);

    PlanePoint operator()(std::size_t row, std::size_t column) const
    {
        return {slenderness, restitution, amplitudes[row], frequencies[column]};
    }

    double slenderness;
    double restitution;
    std::vector<double> amplitudes;
    std::vector<double> frequencies;
};

/// The points of a tile, the last dimension fastest.
std::vector<PlanePoint> points_of(const Scene& scene, const Plane& plane, const Tile& tile);

/// The number of the record of a tile; 0 under a pulse. Not for blocks with motions of their own.
std::int64_t motion_of(const Scene& scene, const Tile& tile);

} // namespace overturn
