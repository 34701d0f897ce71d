// Computes the fields of a tile: of a spectrum, the forced stage of each point, then its region; of
// a boundary, the flips of each line.
#pragma once

#include "overturn/problem/problem.hpp"
#include "overturn/sweep/kernel.hpp"

#include <cstdint>
#include <vector>

namespace overturn {

/// Filled points that were integrated as well.
struct AuditCount {
    std::int64_t checked = 0;
    std::int64_t wrong = 0;
};

/// The fields of one tile, in the order of Problem::fields.
struct TileFields {
    std::vector<FieldValues> values;
    AuditCount audit{}; ///< of a filled tile
};

/// Computes a tile of the stored fields. Of a spectrum that is not filled, the values of a point
/// depend only on the point, the scene and the numerics, not on the shape of the tile, the other
/// points, or the kernel.
///
/// Of a boundary, a tile has the flips of one line in ascending order. Values are NaN and
/// no_flip after the last flip, except that region_below of a line without flips is the region at
/// the first strength. If there are more flips than are stored, the last region_above is undecided.
TileFields compute_tile(const Problem& problem, const Tile& tile, Kernel kernel,
                        const DropRequested& drop_requested = nullptr);

/// Makes the allocator of this process keep freed memory. By default, the GNU C library returns
/// the memory of a tile to the system; obtaining new pages for the next tile then takes up a fifth
/// of the run time.
void keep_freed_memory();

} // namespace overturn
