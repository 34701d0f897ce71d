#include "overturn/farm/tile_dealer.hpp"

#include <algorithm>
#include <utility>

namespace overturn {

namespace {

/// A rank gets at most 1/16 of its fair share of what is left: costly tiles are neighbours, and a
/// range of nothing else may take ten times the average. (At 1/4, 200 tiles with a costly tenth in
/// front kept one of three ranks busy 1.7 times as long as another.)
constexpr std::size_t ranges_per_share = 16;

/// A tile takes milliseconds and a message microseconds: longer ranges would save nothing, and
/// would let the ranks see a stop later.
constexpr std::size_t longest_range = 16;

} // namespace

TileDealer::TileDealer(std::vector<std::int64_t> tiles, int ranks)
    : tiles_(std::move(tiles)), ranks_(std::size_t(ranks))
{}

TileRange TileDealer::deal()
{
    const std::size_t share = (tiles_.size() - next_) / (ranges_per_share * ranks_);
    return take(std::clamp<std::size_t>(share, 1, longest_range));
}

TileRange TileDealer::take(std::size_t at_most)
{
    if (next_ == tiles_.size()) {
        return {};
    }
    TileRange range{tiles_[next_], tiles_[next_]};
    while (at_most > 0 && next_ < tiles_.size() && tiles_[next_] == range.end) {
        ++range.end;
        ++next_;
        --at_most;
    }
    return range;
}

} // namespace overturn
