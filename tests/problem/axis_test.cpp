#include "overturn/problem/axis.hpp"

#include <gtest/gtest.h>

namespace overturn {
namespace {

TEST(Axis, OfARangeEndsExactlyAndIsEvenlySpaced)
{
    const Axis axis(AxisRange{0.1, 12.0, 1000, Spacing::linear});
    EXPECT_EQ(axis.size(), 1000);
    EXPECT_EQ(axis[0], 0.1);
    EXPECT_EQ(axis[999], 12.0);
    EXPECT_NEAR(axis[500] - axis[499], 11.9 / 999, 4e-15); // two roundings of numbers of 6
}

TEST(Axis, OfALogRangeHasEqualRatios)
{
    const Axis axis(AxisRange{0.01, 100.0, 5, Spacing::log});
    const std::vector<double> expected{0.01, 0.1, 1, 10, 100};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(axis[std::int64_t(i)] / expected[i], 1,
                    1e-15); // pow is accurate to one or two ulp
    }
}

TEST(Axis, OfOneValueIsThatValue)
{
    EXPECT_EQ(Axis(AxisRange{0.3, 0.3, 1, Spacing::linear})[0], 0.3);
}

TEST(Axis, OfAListGivesItsValues)
{
    const Axis axis(AxisList{0.5, 0.7, 2});
    EXPECT_EQ(axis.size(), 3);
    EXPECT_EQ(axis.values(1, 3), (std::vector<double>{0.7, 2}));
}

TEST(Axis, IsThinnedToEvenlyChosenValues)
{
    const Axis axis(AxisRange{0, 8, 9, Spacing::linear});
    EXPECT_EQ(axis.thinned(3).values(), (std::vector<double>{0, 4, 8}));
    EXPECT_EQ(axis.thinned(1).values(), (std::vector<double>{4}));
    EXPECT_EQ(axis.thinned(9).values(), axis.values());
}

TEST(Axis, CountsBeyondThirtyTwoBits)
{
    const Axis axis(AxisRange{0, 1, std::int64_t(1) << 40, Spacing::linear});
    EXPECT_EQ(axis[std::int64_t(1) << 39],
              double(std::int64_t(1) << 39) / double((std::int64_t(1) << 40) - 1));
}

TEST(Extent, IsWrittenAsOneValueOrTwo)
{
    EXPECT_EQ(extent_of({2}).text(" m"), "2 m");
    EXPECT_EQ(extent_of({2, 3, 0.5}).text(" m"), "0.5 to 3 m");
}

} // namespace
} // namespace overturn
