#include "overturn/problem/tile_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace overturn {
namespace {

TEST(TileOrder, HasAPlaceForEveryTile)
{
    for (std::int64_t tiles = 1; tiles <= 600; ++tiles) {
        const TileOrder order(tiles);
        std::vector<int> count(std::size_t(tiles), 0);
        for (std::int64_t place = 0; place < tiles; ++place) {
            ++count[std::size_t(order.tile(place))];
            EXPECT_EQ(order.place(order.tile(place)), place) << tiles;
        }
        EXPECT_EQ(std::ranges::count(count, 1), tiles) << tiles;
    }
}

TEST(TileOrder, KnowsThePlacesOfAsManyTilesAsThereMayBe)
{
    for (const std::int64_t tiles :
         {std::int64_t(1) << 31, (std::int64_t(1) << 31) - 1, std::int64_t(1) << 40}) {
        const TileOrder order(tiles);
        for (const std::int64_t place : {std::int64_t(0), tiles / 3, tiles - 1}) {
            EXPECT_EQ(order.place(order.tile(place)), place) << tiles;
        }
    }
}

TEST(TileOrder, HasThePlacesOfMissingTilesInAscendingOrder)
{
    const TileOrder order(97);
    const std::vector<std::int64_t> tiles{0, 3, 4, 5, 40, 96};
    const std::vector<std::int64_t> places = order.places_of(tiles);
    EXPECT_TRUE(std::ranges::is_sorted(places));
    std::vector<std::int64_t> found;
    for (const std::int64_t place : places) {
        found.push_back(order.tile(place));
    }
    std::ranges::sort(found);
    EXPECT_EQ(found, tiles);
    EXPECT_TRUE(order.places_of({}).empty());
}

/// How many times too long the time left appears after a share of the tiles, if the rest were
/// computed at the rate so far. cost(across, up): shares of the plane.
template <class Cost, class TileAt>
double overestimate(std::int64_t columns, std::int64_t rows, double share, const Cost& cost,
                    const TileAt& tile_at)
{
    const std::int64_t tiles = columns * rows;
    const auto done = std::int64_t(std::ceil(share * double(tiles)));
    double so_far = 0;
    double left = 0;
    for (std::int64_t place = 0; place < tiles; ++place) {
        const std::int64_t tile = tile_at(place);
        const double each = cost((double(tile % columns) + 0.5) / double(columns),
                                 (double(tile / columns) + 0.5) / double(rows));
        (place < done ? so_far : left) += each;
    }
    return so_far / double(done) * double(tiles - done) / left;
}

TEST(TileOrder, ShowsTheTimeLeftFromTheFirstTwentiethOn)
{
    // Slow pulses, at small frequencies, cost most; strong motions and little loss cost more.
    const auto of_frequency = [](double across, double) { return 1 / (0.02 + across); };
    const auto of_period = [](double across, double) { return 0.05 + across; };
    const auto of_both = [](double across, double up) { return (1 + 3 * up) / (0.02 + across); };
    const auto of_rows = [](double, double up) { return 1 / (0.02 + up); };
    const auto check = [](std::int64_t columns, std::int64_t rows, const auto& cost) {
        const TileOrder order(columns * rows);
        for (const double share : {0.05, 0.1, 0.3, 0.6}) {
            const double ratio = overestimate(
                columns, rows, share, cost, [&](std::int64_t place) { return order.tile(place); });
            EXPECT_LT(ratio, 1.5) << columns << " " << rows << " " << share;
            EXPECT_GT(ratio, 1 / 1.5) << columns << " " << rows << " " << share;
        }
    };
    for (const auto& [columns, rows] :
         {std::pair(181L, 3L), {400L, 1L}, {1L, 400L}, {64L, 64L}, {200L, 20L}, {2000L, 1L}}) {
        check(columns, rows, of_frequency);
        check(columns, rows, of_period);
        check(columns, rows, of_both);
        check(columns, rows, of_rows);
    }
    // In the order of the numbers, it is six times too long.
    EXPECT_GT(overestimate(400, 1, 0.05, of_frequency, [](std::int64_t place) { return place; }),
              5);
}

} // namespace
} // namespace overturn
