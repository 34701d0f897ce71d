#include "overturn/farm/tile_dispatcher.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace overturn {

namespace {

/// A range is 1/16 of a rank's fair share of what is left, within the limits: costly tiles are
/// neighbours, and a range of them may take ten times the average. (With 1/4, and 200 tiles of
/// which the first tenth is costly, one of three ranks was busy 1.7 times as long as another.)
constexpr std::size_t ranges_per_share = 16;

constexpr double longest_range = 0.1;      // [s]
constexpr double share_of_answering = 0.5; // of rank 0's time

} // namespace

RangeLimits range_limits(int ranks, double seconds_of_answer, double seconds_of_tile)
{
    constexpr double far_enough = 1e6; // tiles: the measured times do not justify more
    RangeLimits limits;
    if (!(seconds_of_tile > 0)) {
        return limits;
    }
    const auto count = [&](double tiles) {
        return std::size_t(std::clamp(tiles, 1.0, far_enough));
    };
    limits.least =
        count(std::ceil(ranks * seconds_of_answer / (share_of_answering * seconds_of_tile)));
    limits.most = std::max({limits.least, limits.most, count(longest_range / seconds_of_tile)});
    return limits;
}

TileDispatcher::TileDispatcher(std::vector<std::int64_t> tiles, int ranks)
    : tiles_(std::move(tiles)), ranks_(std::size_t(ranks))
{}

TileRange TileDispatcher::next_range(const RangeLimits& limits)
{
    // Never more than half of a fair share: the other ranks would wait for this one at the end.
    const std::size_t left = tiles_.size() - next_;
    const std::size_t least = std::min(limits.least, left / (2 * ranks_));
    const std::size_t share = left / (ranges_per_share * ranks_);
    std::size_t length = std::max<std::size_t>(std::clamp(share, least, limits.most), 1);
    if (left == 0) {
        return {};
    }
    TileRange range{tiles_[next_], tiles_[next_]};
    for (; length > 0 && next_ < tiles_.size() && tiles_[next_] == range.end; --length) {
        ++range.end;
        ++next_;
    }
    return range;
}

} // namespace overturn
