// Which tiles go next: ranges of consecutive tile numbers out of a list, in its order.
// Guided: a share of what is left, so that ranges shrink as the end comes near. No messages here.
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
};

/// How many tiles a range has, while there are enough.
struct RangeLimits {
    std::size_t least = 1;
    std::size_t most = 16;
};

/// With many ranks and quick tiles rank 0 could do nothing but answer: ranges are so long that it
/// does so for half of its time. While many tiles are left they take a tenth of a second: longer
/// ones would save nothing, and ranks that hear of a stop from rank 0 alone would hear of it later.
RangeLimits range_limits(int ranks, double seconds_of_answer, double seconds_of_tile);

class TileDealer {
public:
    /// The tile numbers to deal, strictly ascending, and the ranks that will ask for them.
    TileDealer(std::vector<std::int64_t> tiles, int ranks);

    /// The next range; empty when there is nothing left.
    TileRange deal(const RangeLimits& limits = {});

    /// The next tile alone; empty when there is nothing left.
    TileRange deal_one() { return take(1); }

    /// Deals nothing from now on.
    void stop() { next_ = tiles_.size(); }

private:
    TileRange take(std::size_t at_most);

    std::vector<std::int64_t> tiles_;
    std::size_t next_ = 0;
    std::size_t ranks_;
};

} // namespace overturn
