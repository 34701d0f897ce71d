#include "overturn/problem/tile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>

namespace overturn {
namespace {

TEST(CountPoints, OfMoreThan64BitsIsTheLargestNumber)
{
    const std::int64_t largest = std::numeric_limits<std::int64_t>::max();
    EXPECT_EQ(count_points({largest / 3, 3}), largest / 3 * 3);
    EXPECT_EQ(count_points({largest / 3 + 1, 3}), largest);
    EXPECT_EQ(count_points({largest, 2, 2}), largest);
}

TEST(Tiling, CoversEveryPointOnceInAnyNumberOfDimensions)
{
    for (const Shape& shape : {Shape{23, 31}, {3, 23, 31}, {2, 3, 23, 31}, {2, 1, 3, 5, 7}}) {
        for (const auto& last_extents : {std::array{1, 7}, {7, 8}, {1, 31}, {23, 1}, {64, 64}}) {
            Shape extents(shape.size(), 2);
            std::ranges::copy(last_extents, extents.end() - 2);
            const Tiling tiling(shape, extents);
            std::set<Shape> seen;
            for (std::int64_t n = 0; n < tiling.size(); ++n) {
                const Tile tile = tiling[n];
                EXPECT_EQ(tile.number, n);
                for (std::int64_t i = 0; i < tile.points(); ++i) {
                    Shape point(shape.size());
                    std::int64_t place = i;
                    for (std::size_t axis = shape.size(); axis-- > 0;) {
                        point[axis] = tile.begin[axis] + place % tile.count[axis];
                        place /= tile.count[axis];
                    }
                    EXPECT_TRUE(seen.insert(point).second);
                }
            }
            Shape last;
            for (const std::int64_t size : shape) {
                last.push_back(size - 1);
            }
            EXPECT_EQ(std::int64_t(seen.size()), count_points(shape));
            EXPECT_EQ(*seen.rbegin(), last);
        }
    }
}

TEST(Tiling, NumbersTilesInTheOrderOfTheDimensions)
{
    const Tiling tiling({3, 2, 20, 20}, {1, 1, 10, 10});
    EXPECT_EQ(tiling[1].begin, (Shape{0, 0, 0, 10}));
    EXPECT_EQ(tiling[2].begin, (Shape{0, 0, 10, 0}));
    EXPECT_EQ(tiling[4].begin, (Shape{0, 1, 0, 0}));
    EXPECT_EQ(tiling[8].begin, (Shape{1, 0, 0, 0}));
}

TEST(Tiling, CountsBeyondThirtyTwoBits)
{
    const Tiling tiling({std::int64_t(1) << 22, std::int64_t(1) << 22}, {1, 1});
    EXPECT_EQ(tiling.size(), std::int64_t(1) << 44);
    const Tile last = tiling[tiling.size() - 1];
    EXPECT_EQ(last.begin, Shape(2, (std::int64_t(1) << 22) - 1));
}

} // namespace
} // namespace overturn
