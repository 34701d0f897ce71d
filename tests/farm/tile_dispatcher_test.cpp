#include "overturn/farm/tile_dispatcher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace overturn {
namespace {

std::vector<std::int64_t> first_numbers(std::size_t count)
{
    std::vector<std::int64_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

std::vector<TileRange> dispatch_all(TileDispatcher dispatcher)
{
    std::vector<TileRange> ranges;
    while (true) {
        const TileRange range = dispatcher.next_range();
        if (range.empty()) {
            return ranges;
        }
        ranges.push_back(range);
    }
}

std::vector<std::int64_t> numbers_in(const std::vector<TileRange>& ranges)
{
    std::vector<std::int64_t> numbers;
    for (const TileRange& range : ranges) {
        for (std::int64_t number = range.begin; number < range.end; ++number) {
            numbers.push_back(number);
        }
    }
    return numbers;
}

TEST(TileDispatcher, DispatchesEachTileOnceInOrder)
{
    for (const std::size_t count : {0, 1, 2, 7, 100, 1001}) {
        for (const int ranks : {1, 2, 3, 64}) {
            const auto tiles = first_numbers(count);
            EXPECT_EQ(numbers_in(dispatch_all({tiles, ranks})), tiles) << count << " for " << ranks;
        }
    }
}

TEST(TileDispatcher, SplitsRangesWhereNumbersAreMissing)
{
    // Missing tiles of an interrupted run: scattered where its ranks had computed.
    std::vector<std::int64_t> tiles;
    for (std::int64_t number = 0; number < 500; ++number) {
        if (number % 7 != 3) {
            tiles.push_back(number);
        }
    }
    EXPECT_EQ(numbers_in(dispatch_all({tiles, 2})), tiles);
}

TEST(TileDispatcher, DispatchesShorterRangesTowardsTheEnd)
{
    const auto ranges = dispatch_all({first_numbers(1000), 2});
    const auto length = [](const TileRange& range) { return range.end - range.begin; };
    for (std::size_t i = 1; i < ranges.size(); ++i) {
        EXPECT_LE(length(ranges[i]), length(ranges[i - 1]));
    }
    EXPECT_GT(length(ranges.front()), 8);
    // Two ranks with one range each in progress and one ahead: the last four decide the balance.
    for (std::size_t i = ranges.size() - 4; i < ranges.size(); ++i) {
        EXPECT_EQ(length(ranges[i]), 1);
    }
}

TEST(TileDispatcher, DispatchesRangesWithinLimitsUntilTheEnd)
{
    TileDispatcher dispatcher(first_numbers(10000), 4);
    const RangeLimits limits{.least = 5, .most = 40};
    std::int64_t left = 10000;
    while (left > 0) {
        const TileRange range = dispatcher.next_range(limits);
        const std::int64_t length = range.end - range.begin;
        EXPECT_LE(length, 40);
        EXPECT_GE(length, std::clamp<std::int64_t>(left / 8, 1, 5)); // half of a fair share
        left -= length;
    }
    EXPECT_TRUE(dispatcher.next_range(limits).empty());
}

TEST(RangeLimits, LeaveRank0HalfOfItsTimeForTiles)
{
    // 10,000 ranks with tiles of 0.4 ms send 25 million requests per second for single tiles; an
    // answer takes 0.4 us, so that rank 0 gives 1.25 million in half of its time: 20 tiles each.
    const RangeLimits limits = range_limits(10000, 4e-7, 4e-4);
    EXPECT_EQ(limits.least, 20u);
    EXPECT_EQ(limits.most, 250u); // 0.1 s
}

TEST(RangeLimits, AreThoseOfAFewRanksIfRank0HasTime)
{
    EXPECT_EQ(range_limits(8, 1e-6, 1e-2).least, 1u);
    EXPECT_EQ(range_limits(8, 1e-6, 1e-2).most, 16u);
    EXPECT_EQ(range_limits(8, 1e-6, 100).most, 16u);
    EXPECT_EQ(range_limits(8, 1e-6, 0).least, 1u); // no measurements yet
    EXPECT_GE(range_limits(1 << 20, 1e-3, 1e-9).most, range_limits(1 << 20, 1e-3, 1e-9).least);
}

TEST(TileDispatcher, DispatchesNothingAfterAStop)
{
    TileDispatcher dispatcher(first_numbers(10), 1);
    EXPECT_FALSE(dispatcher.next_tile().empty());
    dispatcher.stop();
    EXPECT_TRUE(dispatcher.next_range().empty());
    EXPECT_TRUE(dispatcher.next_tile().empty());
}

} // namespace
} // namespace overturn
