// Divides a list of tile numbers into ranges of consecutive numbers, in the order of the list.
// Guided scheduling: a range is a share of what is left, so ranges shrink towards the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace overturn {

/// The tile numbers [begin, end).
struct TileRange {
    std::int64_t begin = 0;
    std::int64_t end = 0;

    bool empty() const { return begin == end; }
    bool operator==(const TileRange&) const = default;
};

/// The number of tiles in a range, while enough are left.
struct RangeLimits {
    std::size_t least = 1;
    std::size_t most = 16;
};

/// With many ranks and quick tiles, answering requests could occupy rank 0 completely: ranges are
/// long enough that it takes at most half of the time. A range takes at most a tenth of a second,
/// or 16 tiles or `least` if that is longer: longer ones save nothing, and delay a stop, because
/// workers finish them.
RangeLimits range_limits(int ranks, double seconds_of_answer, double seconds_of_tile);

class TileDispatcher {
public:
    /// tiles: numbers, strictly ascending.
    TileDispatcher(std::vector<std::int64_t> tiles, int ranks);

    /// The next range; empty if no tile is left.
    TileRange next_range(const RangeLimits& limits = {});

    /// The next tile as a range; empty if no tile is left.
    TileRange next_tile() { return next_range({.least = 1, .most = 1}); }

    /// Discards the remaining tiles.
    void stop() { next_ = tiles_.size(); }

private:
    std::vector<std::int64_t> tiles_;
    std::size_t next_ = 0;
    std::size_t ranks_;
};

} // namespace overturn
