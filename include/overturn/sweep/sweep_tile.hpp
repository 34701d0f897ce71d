// Computes the fields of a tile: the forced stage of each point, then its region.
#pragma once

#include "overturn/sweep/fields.hpp"
#include "overturn/sweep/fill.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/sweep/plane.hpp"
#include "overturn/sweep/scene.hpp"
#include "overturn/sweep/tile.hpp"

#include <vector>

namespace overturn {

/// The requested fields of one tile, in the order in which they were requested.
struct TileFields {
    std::vector<FieldValues> values;
    AuditCount audit{}; ///< of a filled tile
};

/// Computes every point of a tile, or fills it, see fill.hpp. Without filling, the values of a
/// point depend only on the point, the scene and the numerics, not on the shape of the tile, the
/// other points, or the kernel; except that under a record with `resolve`, whether a point is left
/// undecided also depends on the other points of the tile, see Numerics::most_in_50_digits.
TileFields sweep_tile(const Scene& scene, const Numerics& numerics, const Plane& plane,
                      const Tile& tile, const std::vector<Field>& fields, Kernel kernel,
                      DropRequested drop_requested = nullptr);

/// Makes the allocator of this process keep freed memory. By default, the GNU C library returns
/// the memory of a tile to the system; obtaining new pages for the next tile then takes up a fifth
/// of the run time.
void keep_freed_memory();

} // namespace overturn
