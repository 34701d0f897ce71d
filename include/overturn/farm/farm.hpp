// The farm: rank 0 hands out ranges of tile numbers and computes too, answering requests in
// between; the other ranks ask one range ahead, so that nobody waits. What travels: a worker's
// words (tiles done, stop; asking, alive or leaving) and ranges. Tiles themselves never do.
#pragma once

#include "overturn/farm/mpi_session.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <vector>

namespace overturn {

/// What is done with a tile, by its number, on one rank after the other.
struct TileWork {
    /// Asks every second or more often whether the tile is to be dropped: that keeps the messages
    /// going. False if it was.
    std::function<bool(std::int64_t number, const std::function<bool()>& drop_requested)> compute;
    std::function<void(std::int64_t number)> write;
};

/// How a rank is asked to stop. Both stay true once they are.
struct StopRequest {
    std::function<bool()> requested; ///< finish the tile in hand, and leave
    std::function<bool()> overdue;   ///< drop it
};

/// Of a rank nothing was heard for too long: it was stopped, hangs on its disk, or is cut off.
class SilentRank : public std::runtime_error {
public:
    SilentRank(int silent_rank, std::chrono::seconds for_so_long);

    int rank;
    std::chrono::seconds silence;
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
/// rank 0, is called now and then. A rank that is asked to stop finishes or drops the tile in hand
/// and leaves, the others what they were given before rank 0 heard of it. An exception leaves
/// farm_out on its rank alone, so the caller must abort the session: it is SilentRank where rank 0
/// hears nothing of a worker for `patience`, or a worker nothing of rank 0.
FarmReport farm_out(const MpiSession& session, const std::vector<std::int64_t>& tiles,
                    const TileWork& tile_work,
                    const std::function<void(std::int64_t done)>& on_progress,
                    const StopRequest& stop, std::chrono::seconds patience);

} // namespace overturn
