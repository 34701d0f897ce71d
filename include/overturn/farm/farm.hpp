// The farm: rank 0 hands out ranges of tile numbers to the nodes, whose ranks, rank 0 among them,
// take tiles from a pool in the memory that they share. A node requests ranges ahead, so that no
// rank waits. Messages hold ranges and the state of nodes (tiles done, asked to stop), never values
// of tiles.
#pragma once

#include "overturn/farm/mpi_session.hpp"
#include "overturn/farm/node.hpp"
#include "overturn/problem/tile.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

namespace overturn {

/// Computes and writes a tile, given its number, and reports the progress.
struct TileWork {
    /// Returns false if the tile was dropped because drop_requested() has returned true.
    std::function<bool(std::int64_t number, const DropRequested& drop_requested)> compute;
    /// Called after compute() has returned true, before the next tile.
    std::function<void(std::int64_t number)> write;
    /// Called on rank 0 at intervals, with the number of tiles done by all ranks.
    std::function<void(std::int64_t done)> on_progress;
};

/// Whether a rank is asked to stop. Once true, both remain true.
struct StopRequest {
    std::function<bool()> requested; ///< finish the current tile, then stop
    std::function<bool()> overdue;   ///< drop the current tile
};

/// The work of one rank. It spent the rest of its time on messages and waiting.
struct RankShare {
    std::int64_t tiles = 0;
    double compute_seconds = 0;
    double write_seconds = 0;
};

/// The cost of handing out the tiles.
struct DispatchCost {
    std::int64_t requests = 0; ///< of other nodes than that of rank 0
    double seconds = 0;        ///< spent on the answers
};

struct FarmReport {
    bool stopped = false;         ///< tiles are left because a rank was asked to stop
    RankShare all = {};           ///< the sum over all ranks
    std::vector<RankShare> ranks; ///< rank 0 only: one per rank
    DispatchCost dispatch;        ///< rank 0 only
};

/// Computes and writes each of the tiles once, on some rank. Collective. A node serves one call.
///
/// tiles: strictly ascending numbers, on rank 0; ignored elsewhere. A rank that is asked to stop
/// finishes or drops its current tile, and so do the others of its node; other nodes finish the
/// tiles that they were given before rank 0 received the stop. An exception leaves farm_out on one
/// rank only, so the caller must abort the session. Throws Error if a rank gives the leader of its
/// node, or a leader rank 0, or these those, no sign of life for `patience`.
FarmReport farm_out(const MpiSession& session, const Node& node,
                    const std::vector<std::int64_t>& tiles, const TileWork& tile_work,
                    const StopRequest& stop, std::chrono::seconds patience);

} // namespace overturn
