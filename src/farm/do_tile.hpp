// Computes and writes one tile, and measures both times.
#pragma once

#include "overturn/farm/farm.hpp"

namespace overturn {

inline double busy_seconds(const RankShare& share)
{
    return share.compute_seconds + share.write_seconds;
}

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
