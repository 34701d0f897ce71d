// The farm: rank 0 hands out ranges of tile numbers and computes too, answering requests between
// its own tiles; the other ranks ask one range ahead, so that nobody waits.
// What travels: requests (tiles done, stop, leaving) and ranges. Tiles themselves never do.
#pragma once

#include "overturn/farm/mpi_session.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace overturn {

/// What is done with a tile, by its number, on one rank after the other.
struct TileWork {
    std::function<void(std::int64_t number)> compute;
    std::function<void(std::int64_t number)> write;
};

/// What one rank did. Time that is in neither was spent waiting, or on messages.
struct RankShare {
    std::int64_t tiles = 0;
    double compute_seconds = 0;
    double write_seconds = 0;
};

/// What handing out the tiles took.
struct DealingShare {
    std::int64_t requests = 0; ///< answered by rank 0
    double seconds = 0;        ///< that it took for them
};

struct FarmReport {
    std::int64_t tiles = 0;       ///< done by all ranks together
    bool stopped = false;         ///< tiles are left because a rank was asked to stop
    std::vector<RankShare> ranks; ///< rank 0 only: one per rank
    DealingShare dealing;         ///< rank 0 only
};

/// Computes and writes each of the tiles once, on some rank; all ranks call it and leave it
/// together.
///
/// tiles: strictly ascending numbers, on rank 0; ignored elsewhere. on_progress(tiles done), on
/// rank 0, is called between tiles and while waiting. stop_requested(), once true on a rank, stays
/// true: that rank finishes the tile in hand and leaves, the others what they were given before
/// rank 0 heard of it. An exception leaves farm_out on its rank alone, so the caller must abort the
/// session.
FarmReport farm_out(const MpiSession& session, const std::vector<std::int64_t>& tiles,
                    const TileWork& tile_work,
                    const std::function<void(std::int64_t done)>& on_progress,
                    const std::function<bool()>& stop_requested);

} // namespace overturn
