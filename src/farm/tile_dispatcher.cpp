#include "overturn/farm/tile_dispatcher.hpp"

#include "overturn/farm/tile_pool.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace overturn {

namespace {

/// A node is given 1/16 of its fair share of what is left, within the limits: costly tiles are
/// neighbours, and a range of them may take ten times the average. (With 1/4, and 200 tiles of
/// which the first tenth is costly, one of three nodes of one rank was busy 1.7 times as long as
/// another.)
constexpr std::int64_t answers_per_share = 16;

constexpr double longest_time = 0.1;       // [s]
constexpr double share_of_answering = 0.5; // of rank 0's time

} // namespace

TileLimits tile_limits(int nodes, double seconds_of_answer, double seconds_of_tile)
{
    constexpr double far_enough = 1e6; // tiles: the measured times do not justify more
    TileLimits limits;
    if (!(seconds_of_tile > 0)) {
        return limits;
    }
    const auto count = [&](double tiles) {
        return std::int64_t(std::clamp(tiles, 1.0, far_enough));
    };
    limits.least =
        count(std::ceil(nodes * seconds_of_answer / (share_of_answering * seconds_of_tile)));
    limits.most = std::max({limits.least, limits.most, count(longest_time / seconds_of_tile)});
    return limits;
}

std::int64_t tiles_for_node(std::int64_t left, int ranks_of_node, int ranks,
                            const TileLimits& limits)
{
    // Never more than a fair share: the other nodes would wait for this one at the end.
    const std::int64_t fair = (left * ranks_of_node + ranks - 1) / ranks;
    const std::int64_t wanted = std::clamp(fair / answers_per_share, limits.least * ranks_of_node,
                                           limits.most * ranks_of_node);
    return std::min(wanted, fair);
}

TileDispatcher::TileDispatcher(std::vector<std::int64_t> tiles, int ranks)
    : tiles_(std::move(tiles)), ranks_(ranks)
{}

std::vector<TileRange> TileDispatcher::next_ranges(int ranks_of_node, const TileLimits& limits,
                                                   int most_ranges)
{
    const auto left = std::int64_t(tiles_.size() - next_);
    std::int64_t length =
        std::min(tiles_for_node(left, ranks_of_node, ranks_, limits), TilePool::longest_range);
    std::vector<TileRange> ranges;
    for (; length > 0; --length, ++next_) {
        const std::int64_t number = tiles_[next_];
        if (ranges.empty() || ranges.back().end != number) {
            if (int(ranges.size()) == most_ranges) {
                break;
            }
            ranges.push_back({number, number});
        }
        ++ranges.back().end;
    }
    return ranges;
}

} // namespace overturn
