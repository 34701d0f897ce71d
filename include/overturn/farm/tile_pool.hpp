// The tiles that a node has been given, and that its ranks take one by one.
#pragma once

#include "overturn/farm/tile_dispatcher.hpp"

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

namespace overturn {

/// Ranges of tiles in memory that several processes share. It is lock-free: a rank that is
/// suspended or killed, wherever that may be, does not block the others.
///
/// Any rank may take tiles; one rank alone puts ranges and clears.
class TilePool {
public:
    static constexpr int most_ranges = 64;
    static constexpr std::int64_t longest_range = (std::int64_t(1) << 24) - 1;

    /// A tile that no other rank has taken; none if the pool is empty.
    std::optional<std::int64_t> take();

    /// The number of tiles left. Only an upper bound while others take some.
    std::int64_t tiles() const;

    /// The number of ranges that can be put.
    int room() const;

    /// Adds a range of at most longest_range tiles, below 2^40. There must be room for it.
    void put(const TileRange& range);

    /// Removes all tiles.
    void clear();

private:
    /// The first tile in the upper 40 bits, the number of tiles in the lower 24. No value returns:
    /// a tile that was taken is not put again.
    using Packed = std::uint64_t;
    static_assert(std::atomic<Packed>::is_always_lock_free);

    std::array<std::atomic<Packed>, most_ranges> ranges_{};
};

} // namespace overturn
