#include "overturn/farm/tile_pool.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <numeric>
#include <thread>
#include <vector>

namespace overturn {
namespace {

TEST(TilePool, GivesTheTilesOfItsRanges)
{
    TilePool pool;
    EXPECT_FALSE(pool.take());
    EXPECT_EQ(pool.room(), TilePool::most_ranges);
    // The largest number of a tile and the longest range.
    const std::int64_t end = std::int64_t(1) << 40;
    pool.put({3, 5});
    pool.put({end - 2, end});
    pool.put({100, 100 + TilePool::longest_range});
    EXPECT_EQ(pool.tiles(), 4 + TilePool::longest_range);
    EXPECT_EQ(pool.room(), TilePool::most_ranges - 3);
    for (const std::int64_t expected : {std::int64_t(3), std::int64_t(4), end - 2, end - 1}) {
        EXPECT_EQ(pool.take(), expected);
    }
    EXPECT_EQ(pool.take(), 100);
    EXPECT_EQ(pool.take(), 101);
    EXPECT_EQ(pool.tiles(), TilePool::longest_range - 2);
    EXPECT_EQ(pool.room(), TilePool::most_ranges - 1);
}

TEST(TilePool, HasRoomForItsMostRangesUntilItIsCleared)
{
    TilePool pool;
    for (int i = 0; i < TilePool::most_ranges; ++i) {
        pool.put({2 * i, 2 * i + 1});
    }
    EXPECT_EQ(pool.room(), 0);
    EXPECT_EQ(pool.tiles(), TilePool::most_ranges);
    pool.clear();
    EXPECT_EQ(pool.room(), TilePool::most_ranges);
    EXPECT_FALSE(pool.take());
}

TEST(TilePool, GivesEachTileToOneOfTheThreadsThatTakeIt)
{
    constexpr int threads = 4;
    constexpr std::int64_t tiles = 400'000;
    TilePool pool;
    std::atomic<bool> all_are_put = false;
    std::vector<std::vector<std::int64_t>> taken(threads);
    {
        std::vector<std::jthread> takers;
        for (auto& own : taken) {
            takers.emplace_back([&pool, &all_are_put, &own] {
                while (!all_are_put || pool.tiles() > 0) {
                    if (const auto number = pool.take()) {
                        own.push_back(*number);
                    }
                }
            });
        }
        // Ranges of 1 to 7 tiles, so that the pool is often empty, and often nearly full.
        for (std::int64_t begin = 0; begin < tiles;) {
            const std::int64_t end = std::min(begin + 1 + begin % 7, tiles);
            if (pool.room() > 0) {
                pool.put({begin, end});
                begin = end;
            }
        }
        all_are_put = true;
    }
    std::vector<std::int64_t> all;
    for (const auto& own : taken) {
        all.insert(all.end(), own.begin(), own.end());
    }
    std::sort(all.begin(), all.end());
    std::vector<std::int64_t> expected(tiles);
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_TRUE(all == expected);
}

} // namespace
} // namespace overturn
