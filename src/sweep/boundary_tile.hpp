// The tile of a boundary.
#pragma once

#include "overturn/sweep/compute_tile.hpp"

namespace overturn {

/// See compute_tile().
TileFields boundary_tile(const Problem& problem, const Tile& tile, Kernel kernel,
                         const DropRequested& drop_requested);

} // namespace overturn
