// The farm: rank 0 hands out ranges of tile numbers and computes too, answering requests between
// its own tiles; the other ranks ask one range ahead, so that nobody waits.
// What travels: requests (tiles done, stop, leaving) and ranges. Tiles themselves never do.
#pragma once

#include "overturn/farm/mpi_session.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace overturn {

/// What one rank did.
struct RankShare {
    std::int64_t tiles = 0;
    double busy_seconds = 0; ///< spent within compute_and_write
};

struct FarmReport {
    std::int64_t tiles = 0;       ///< done by all ranks together
    bool stopped = false;         ///< tiles are left because a rank was asked to stop
    std::vector<RankShare> ranks; ///< rank 0 only: one per rank
};

/// Computes each of the tiles once, on some rank; all ranks call it and leave it together.
///
/// tiles: strictly ascending numbers, on rank 0; ignored elsewhere. compute_and_write(number) does
/// one tile. on_progress(tiles done), on rank 0, is called between tiles and while waiting.
/// stop_requested(), once true on a rank, stays true: that rank finishes the tile in hand
/// and leaves, the others what they were given before rank 0 heard of it. An exception leaves
/// farm_out on its rank alone, so the caller must abort the session.
FarmReport farm_out(const MpiSession& session, const std::vector<std::int64_t>& tiles,
                    const std::function<void(std::int64_t number)>& compute_and_write,
                    const std::function<void(std::int64_t done)>& on_progress,
                    const std::function<bool()>& stop_requested);

} // namespace overturn
