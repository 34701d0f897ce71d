#include "overturn/farm/simulated_farm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace overturn {
namespace {

constexpr FarmCosts equal_tiles{.answer = 1e-6, .take = 1e-7, .tile = 0.002, .spread = 0};

TEST(SimulatedFarm, OfOneRankTakesTheTimeOfAllTiles)
{
    constexpr FarmCosts costs{.answer = 0, .take = 0, .tile = 0.002, .spread = 0};
    const SimulatedFarm found = simulate_farm(costs, 1, 1, 777);
    // A sum of 777 terms, each rounded, after the first request and its answer, of 2 us each.
    const double rounding = 777 * found.seconds * std::numeric_limits<double>::epsilon();
    EXPECT_NEAR(found.seconds, 777 * 0.002 + 4e-6, rounding);
    EXPECT_NEAR(found.efficiency * found.seconds, 777 * 0.002, rounding);
    EXPECT_EQ(found.answering, 0);
}

TEST(SimulatedFarm, SpendsTheTimeOfEachTileOnce)
{
    for (const int ranks : {1, 2, 3, 64}) {
        for (const int ranks_per_node : {1, 2, 64}) {
            for (const std::int64_t tiles : {1, 2, 100, 5000}) {
                const SimulatedFarm found =
                    simulate_farm(equal_tiles, ranks, ranks_per_node, tiles);
                const double busy = found.efficiency * ranks * found.seconds;
                // A sum of up to 5000 terms, each rounded; a tile too many or too few is 2e-4 of
                // it.
                EXPECT_NEAR(busy, double(tiles) * 0.002, 1e-11 * busy) << ranks << " " << tiles;
            }
        }
    }
}

TEST(SimulatedFarm, EndsWithinTwoTilesOfTheIdealTime)
{
    for (const int ranks : {2, 3, 64}) {
        for (const int ranks_per_node : {1, 2, 64}) {
            const std::int64_t tiles = 1000 * ranks;
            const double ideal = double(tiles) / ranks * equal_tiles.tile;
            const double seconds = simulate_farm(equal_tiles, ranks, ranks_per_node, tiles).seconds;
            EXPECT_GE(seconds, ideal * (1 - 1e-11)) << ranks;
            // At the end, nodes of one rank wait for a tile in progress and one ahead. The messages
            // and answers of the start take 4 us and 1 us per rank; requests that are late in the
            // end, 1.1 ms; taking 1000 tiles, 0.1 ms, and as much for each rank of the node.
            EXPECT_LE(seconds, ideal + 2 * equal_tiles.tile + 1.1e-3 + 4e-6 + ranks * 1.1e-6 +
                                   1e-4 * std::min(ranks, ranks_per_node))
                << ranks << " " << ranks_per_node;
        }
    }
}

TEST(SimulatedFarm, KeepsTheMeanTimeIfTilesDiffer)
{
    // 10^4 tiles whose deviation is their mean: the sum deviates by 1 %, and by 5 % once in a
    // million.
    constexpr FarmCosts costs{.answer = 1e-6, .take = 0, .tile = 0.002, .spread = 1};
    EXPECT_NEAR(simulate_farm(costs, 1, 1, 10'000).seconds, 20, 1);
}

TEST(SimulatedFarm, OfManyTilesIsThatOfFewerLongerOnes)
{
    // 10^8 tiles are simulated as 4 million of 25 each. A tile waits for at most 63 ranks that take
    // one before.
    const double seconds = simulate_farm(equal_tiles, 64, 64, 100'000'000).seconds;
    EXPECT_NEAR(seconds, 1e8 / 64 * (equal_tiles.tile + equal_tiles.take),
                2 * 25 * equal_tiles.tile + 1e-5 + 64 * (1e-6 + 25 * equal_tiles.take));
}

TEST(SimulatedFarm, TakesTilesOfANodeOneAfterTheOther)
{
    // 64 ranks cannot take more than a tile per microsecond, however quick they compute it.
    constexpr FarmCosts costs{.answer = 0, .take = 1e-6, .tile = 1e-6, .spread = 0};
    const double seconds =
        simulate_farm(costs, 64, 64, 100'000, {.least = 1000, .most = 1000}).seconds;
    EXPECT_GE(seconds, 0.1);
    EXPECT_LE(seconds, 0.1 + 2e-6 + 2e-3); // the first answer comes late twice at most
}

} // namespace
} // namespace overturn
