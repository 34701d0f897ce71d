#include "overturn/farm/tile_dealer.hpp"

#include <gtest/gtest.h>

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

std::vector<TileRange> deal_out(TileDealer dealer)
{
    std::vector<TileRange> ranges;
    while (true) {
        const TileRange range = dealer.deal();
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

TEST(TileDealer, DealsEachTileOnceInOrder)
{
    for (const std::size_t count : {0, 1, 2, 7, 100, 1001}) {
        for (const int ranks : {1, 2, 3, 64}) {
            const auto tiles = first_numbers(count);
            EXPECT_EQ(numbers_in(deal_out({tiles, ranks})), tiles) << count << " for " << ranks;
        }
    }
}

TEST(TileDealer, CutsRangesWhereNumbersAreMissing)
{
    // What an interrupted run leaves: holes where its ranks had been.
    std::vector<std::int64_t> tiles;
    for (std::int64_t number = 0; number < 500; ++number) {
        if (number % 7 != 3) {
            tiles.push_back(number);
        }
    }
    EXPECT_EQ(numbers_in(deal_out({tiles, 2})), tiles);
}

TEST(TileDealer, DealsShorterRangesTowardsTheEnd)
{
    const auto ranges = deal_out({first_numbers(1000), 2});
    const auto length = [](const TileRange& range) { return range.end - range.begin; };
    for (std::size_t i = 1; i < ranges.size(); ++i) {
        EXPECT_LE(length(ranges[i]), length(ranges[i - 1]));
    }
    EXPECT_GT(length(ranges.front()), 8);
    // Two ranks with one range each in hand and one ahead: the last four decide the balance.
    for (std::size_t i = ranges.size() - 4; i < ranges.size(); ++i) {
        EXPECT_EQ(length(ranges[i]), 1);
    }
}

TEST(TileDealer, DealsNothingAfterAStop)
{
    TileDealer dealer(first_numbers(10), 1);
    EXPECT_FALSE(dealer.deal_one().empty());
    dealer.stop();
    EXPECT_TRUE(dealer.deal().empty());
    EXPECT_TRUE(dealer.deal_one().empty());
}

} // namespace
} // namespace overturn
