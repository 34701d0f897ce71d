// Divides a list of tile numbers into ranges of consecutive numbers, in the order of the list.
// Guided scheduling: what a node is given is a share of what is left, so that it shrinks towards
// the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace overturn {

/// The tile numbers [begin, end).
struct TileRange {
    std::int64_t begin = 0;
    std::int64_t end = 0;

    std::int64_t length() const { return end - begin; }
    bool operator==(const TileRange&) const = default;
};

/// How many tiles for each of its ranks a node is given at once, while enough are left.
struct TileLimits {
    std::int64_t least = 1;
    std::int64_t most = 16;
};

/// With many nodes and quick tiles, answering requests could occupy rank 0 completely: a node is
/// given so many tiles that it takes at most half of the time. They take at most a tenth of a
/// second, or 16 tiles or `least` per rank if that is longer: more save nothing, and delay a stop,
/// because other nodes finish them.
TileLimits tile_limits(int nodes, double seconds_of_answer, double seconds_of_tile);

/// How many of the tiles left a node of so many ranks is given; `ranks`: those of all nodes.
std::int64_t tiles_for_node(std::int64_t left, int ranks_of_node, int ranks,
                            const TileLimits& limits);

class TileDispatcher {
public:
    /// tiles: numbers, strictly ascending. ranks: those of all nodes.
    TileDispatcher(std::vector<std::int64_t> tiles, int ranks);

    /// The next tiles for a node of so many ranks, in at most most_ranges ranges (at least one);
    /// nothing if no tile is left.
    std::vector<TileRange> next_ranges(int ranks_of_node, const TileLimits& limits,
                                       int most_ranges);

    /// Discards the remaining tiles.
    void stop() { next_ = tiles_.size(); }

private:
    std::vector<std::int64_t> tiles_;
    std::size_t next_ = 0;
    int ranks_;
};

} // namespace overturn
