#include "overturn/farm/simulated_farm.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace overturn {
namespace {

TEST(SimulatedFarm, OfOneRankTakesTheTimeOfAllTiles)
{
    const SimulatedFarm found = simulate_farm({.answer = 1e-6, .tile = 0.002, .spread = 0}, 1, 777);
    // A sum of 777 terms, each rounded.
    EXPECT_NEAR(found.seconds, 777 * 0.002,
                777 * found.seconds * std::numeric_limits<double>::epsilon());
    EXPECT_NEAR(found.efficiency, 1, 777 * std::numeric_limits<double>::epsilon());
    EXPECT_EQ(found.answering, 0);
}

TEST(SimulatedFarm, SpendsTheTimeOfEachTileOnce)
{
    for (const int ranks : {1, 2, 3, 64}) {
        for (const std::int64_t tiles : {1, 2, 100, 5000}) {
            const SimulatedFarm found =
                simulate_farm({.answer = 1e-6, .tile = 0.002, .spread = 0}, ranks, tiles);
            const double busy = found.efficiency * ranks * found.seconds;
            // A sum of up to 5000 terms, each rounded; a tile too many or too few is 2e-4 of it.
            EXPECT_NEAR(busy, double(tiles) * 0.002, 1e-11 * busy) << ranks << " " << tiles;
        }
    }
}

TEST(SimulatedFarm, EndsWithinARangeOfTheIdealTime)
{
    const FarmCosts costs{.answer = 1e-6, .tile = 0.002, .spread = 0};
    for (const int ranks : {2, 3, 64}) {
        const std::int64_t tiles = 1000 * ranks;
        const double ideal = double(tiles) / ranks * costs.tile;
        const double seconds = simulate_farm(costs, ranks, tiles).seconds;
        EXPECT_GE(seconds, ideal * (1 - 1e-11)) << ranks;
        // At the end, a rank waits for the tile that another one computes, and may have asked for
        // one more; the messages and answers of the start take 2 us and 1 us per rank.
        EXPECT_LE(seconds, ideal + 2 * costs.tile + 1e-5 + ranks * 1e-6) << ranks;
    }
}

TEST(SimulatedFarm, KeepsTheMeanTimeIfTilesDiffer)
{
    // 10^4 tiles whose deviation is their mean: the sum deviates by 1 %, and by 5 % once in a
    // million.
    const FarmCosts costs{.answer = 1e-6, .tile = 0.002, .spread = 1};
    EXPECT_NEAR(simulate_farm(costs, 1, 10'000).seconds, 20, 1);
}

TEST(SimulatedFarm, OfManyTilesIsThatOfFewerLongerOnes)
{
    const FarmCosts costs{.answer = 1e-6, .tile = 0.002, .spread = 0};
    // 10^8 tiles are simulated as 4 million of 25 each.
    EXPECT_NEAR(simulate_farm(costs, 64, 100'000'000).seconds, 2e5 / 64,
                2 * 25 * costs.tile + 1e-5 + 64 * 1e-6);
}

} // namespace
} // namespace overturn
