// What the ranks of a farm do: rank 0 leads, all others work. Both compute and write tiles.
#pragma once

#include "overturn/farm/farm.hpp"

namespace overturn {

/// Rank 0: answers every request that has arrived, then computes one tile, until no tile is left
/// and all workers are done. Returns its own share and the cost of dealing. Throws SilentRank.
FarmReport lead(const MpiSession& session, const std::vector<std::int64_t>& tiles,
                const TileWork& tile_work,
                const std::function<void(std::int64_t done)>& on_progress, const StopRequest& stop,
                std::chrono::seconds patience);

/// The other ranks: request ranges of tiles and compute them, until rank 0 has sent `end_of_work`.
/// Throws SilentRank.
RankShare work(const MpiSession& session, const TileWork& tile_work, const StopRequest& stop,
               std::chrono::seconds patience);

inline double busy_seconds(const RankShare& share)
{
    return share.compute_seconds + share.write_seconds;
}

/// Computes and writes one tile, and measures both times.
inline void do_tile(std::int64_t number, const TileWork& tile_work,
                    const std::function<bool()>& drop_requested, RankShare& share)
{
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const bool was_computed = tile_work.compute(number, drop_requested);
    const auto computed = Clock::now();
    share.compute_seconds += std::chrono::duration<double>(computed - start).count();
    if (!was_computed) {
        return;
    }
    tile_work.write(number);
    share.write_seconds += std::chrono::duration<double>(Clock::now() - computed).count();
    ++share.tiles;
}

} // namespace overturn
