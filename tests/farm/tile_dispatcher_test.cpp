#include "overturn/farm/tile_dispatcher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace overturn {
namespace {

std::vector<std::int64_t> first_numbers(std::size_t count)
{
    std::vector<std::int64_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

/// The answers to requests of nodes that have so many ranks, and take turns.
std::vector<std::vector<TileRange>> dispatch_all(const std::vector<std::int64_t>& tiles,
                                                 const std::vector<int>& ranks_of_nodes,
                                                 int most_ranges = 64,
                                                 const TileLimits& limits = {})
{
    TileDispatcher dispatcher(tiles,
                              std::accumulate(ranks_of_nodes.begin(), ranks_of_nodes.end(), 0));
    std::vector<std::vector<TileRange>> answers;
    while (true) {
        const int ranks = ranks_of_nodes[answers.size() % ranks_of_nodes.size()];
        answers.push_back(dispatcher.next_ranges(ranks, limits, most_ranges));
        if (answers.back().empty()) {
            answers.pop_back();
            return answers;
        }
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

std::vector<std::int64_t> numbers_in(const std::vector<std::vector<TileRange>>& answers)
{
    std::vector<TileRange> ranges;
    for (const auto& answer : answers) {
        ranges.insert(ranges.end(), answer.begin(), answer.end());
    }
    return numbers_in(ranges);
}

std::int64_t tiles_in(const std::vector<TileRange>& ranges)
{
    return std::int64_t(numbers_in(ranges).size());
}

TEST(TileDispatcher, DispatchesEachTileOnceInOrder)
{
    for (const std::size_t count : {0, 1, 2, 7, 100, 1001}) {
        for (const std::vector<int>& nodes : std::vector<std::vector<int>>{
                 {1}, {2}, {1, 1}, {3, 1}, std::vector<int>(10, 1), std::vector<int>(3, 64)}) {
            const auto tiles = first_numbers(count);
            EXPECT_EQ(numbers_in(dispatch_all(tiles, nodes)), tiles)
                << count << " for " << nodes.size();
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
    for (const int most_ranges : {1, 2, 64}) {
        const auto answers = dispatch_all(tiles, {2, 2}, most_ranges);
        EXPECT_EQ(numbers_in(answers), tiles);
        for (const auto& answer : answers) {
            EXPECT_LE(answer.size(), std::size_t(most_ranges));
        }
    }
}

TEST(TileDispatcher, GivesLessTowardsTheEnd)
{
    const auto answers = dispatch_all(first_numbers(1000), {1, 1});
    for (std::size_t i = 1; i < answers.size(); ++i) {
        EXPECT_LE(tiles_in(answers[i]), tiles_in(answers[i - 1]));
    }
    EXPECT_GT(tiles_in(answers.front()), 8);
    // Two nodes with one answer each in progress and one ahead: the last four decide the balance.
    for (std::size_t i = answers.size() - 4; i < answers.size(); ++i) {
        EXPECT_EQ(tiles_in(answers[i]), 1);
    }
}

TEST(TileDispatcher, GivesEachNodeByItsRanksWithinTheLimits)
{
    constexpr TileLimits limits{.least = 5, .most = 40};
    for (const auto& [large, small] : {std::pair{64, 1}, {4, 4}, {3, 2}}) {
        std::int64_t left = 100'000;
        std::int64_t answers = 0;
        for (const auto& answer :
             dispatch_all(first_numbers(100'000), {large, small}, 64, limits)) {
            const int ranks = answers % 2 == 0 ? large : small;
            const double fair = double(left) * ranks / (large + small);
            EXPECT_LE(double(tiles_in(answer)), std::min(40.0 * ranks, std::ceil(fair)));
            EXPECT_GE(double(tiles_in(answer)), std::min(5.0 * ranks, std::floor(fair)));
            left -= tiles_in(answer);
            ++answers;
        }
        EXPECT_EQ(left, 0);
    }
}

TEST(TileLimits, LeaveRank0HalfOfItsTimeForTiles)
{
    // 10,000 nodes whose ranks compute a tile in 0.4 ms request 25 million times per second if they
    // are given a tile for each rank; an answer takes 0.4 us, so that rank 0 gives 1.25 million in
    // half of its time: 20 tiles for each rank.
    const TileLimits limits = tile_limits(10000, 4e-7, 4e-4);
    EXPECT_EQ(limits.least, 20);
    EXPECT_EQ(limits.most, 250); // 0.1 s
}

TEST(TileLimits, AreThoseOfAFewNodesIfRank0HasTime)
{
    EXPECT_EQ(tile_limits(8, 1e-6, 1e-2).least, 1);
    EXPECT_EQ(tile_limits(8, 1e-6, 1e-2).most, 16);
    EXPECT_EQ(tile_limits(8, 1e-6, 100).most, 16);
    EXPECT_EQ(tile_limits(8, 1e-6, 0).least, 1); // no measurements yet
    EXPECT_GE(tile_limits(1 << 20, 1e-3, 1e-9).most, tile_limits(1 << 20, 1e-3, 1e-9).least);
}

TEST(TileDispatcher, DispatchesNothingAfterAStop)
{
    TileDispatcher dispatcher(first_numbers(10), 1);
    EXPECT_FALSE(dispatcher.next_ranges(1, {}, 64).empty());
    dispatcher.stop();
    EXPECT_TRUE(dispatcher.next_ranges(1, {}, 64).empty());
}

} // namespace
} // namespace overturn
