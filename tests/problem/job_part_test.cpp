#include "overturn/problem/job_part.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace overturn {
namespace {

TEST(JobDivision, GivesEachTileToOnePart)
{
    for (std::int64_t tiles = 1; tiles <= 40; ++tiles) {
        for (std::int64_t parts = 1; parts <= tiles; ++parts) {
            const JobDivision division(tiles, parts);
            std::vector<std::int64_t> found(std::size_t(parts), 0);
            for (std::int64_t tile = 0; tile < tiles; ++tile) {
                const std::int64_t part = division.part_of(tile);
                ASSERT_TRUE(1 <= part && part <= parts);
                ++found[std::size_t(part - 1)];
                ASSERT_TRUE(TilesOfPart(tiles, JobPart{part, parts}).contains(tile));
                ASSERT_FALSE(TilesOfPart(tiles, JobPart{part % parts + 1, parts}).contains(tile) &&
                             parts > 1);
            }
            for (std::int64_t part = 1; part <= parts; ++part) {
                ASSERT_EQ(found[std::size_t(part - 1)], division.tiles_in(part));
            }
            const auto [fewest, most] = std::ranges::minmax(found);
            ASSERT_LE(most - fewest, 1);
        }
    }
}

TEST(JobDivision, GivesAllTilesToAJobThatIsNotDivided)
{
    const TilesOfPart all(7, std::nullopt);
    EXPECT_EQ(all.size(), 7);
    for (std::int64_t tile = 0; tile < 7; ++tile) {
        EXPECT_TRUE(all.contains(tile));
    }
}

/// The cost of the costliest part over the mean. cost(across, up): of a tile at shares of the
/// plane.
template <class Cost>
double imbalance(std::int64_t columns, std::int64_t rows, std::int64_t parts, const Cost& cost)
{
    const JobDivision division(columns * rows, parts);
    std::vector<double> costs(std::size_t(parts), 0);
    for (std::int64_t tile = 0; tile < columns * rows; ++tile) {
        costs[std::size_t(division.part_of(tile) - 1)] +=
            cost((double(tile % columns) + 0.5) / double(columns),
                 (double(tile / columns) + 0.5) / double(rows));
    }
    return std::ranges::max(costs) /
           (std::accumulate(costs.begin(), costs.end(), 0.0) / double(parts));
}

TEST(JobDivision, GivesPartsThatCostAlike)
{
    // As in ShowsTheTimeLeftFromTheFirstTwentiethOn. Of 64 x 64 tiles and 16 parts, every 16th tile
    // costs 2.7 times the mean, and the costliest rows 5.7 times.
    const auto of_frequency = [](double across, double) { return 1 / (0.02 + across); };
    const auto of_both = [](double across, double up) { return (1 + 3 * up) / (0.02 + across); };
    const auto of_rows = [](double, double up) { return 1 / (0.02 + up); };
    for (const auto& [columns, rows] :
         {std::pair(64L, 64L), {128L, 128L}, {100L, 100L}, {200L, 20L}}) {
        for (const std::int64_t parts : {3, 16}) {
            EXPECT_LT(imbalance(columns, rows, parts, of_frequency), 1.1) << columns << " " << rows;
            EXPECT_LT(imbalance(columns, rows, parts, of_both), 1.1) << columns << " " << rows;
            EXPECT_LT(imbalance(columns, rows, parts, of_rows), 1.1) << columns << " " << rows;
        }
    }
}

} // namespace
} // namespace overturn
