#include "commands/report/print.hpp"
#include "overturn/text/quoting.hpp"

#include <gtest/gtest.h>

namespace overturn {
namespace {

TEST(HumanUnits, CountsHaveThreeDigitsAndAPrefix)
{
    EXPECT_EQ(human_count(0), "0");
    EXPECT_EQ(human_count(999), "999");
    EXPECT_EQ(human_count(1000), "1.00 k");
    EXPECT_EQ(human_count(1.2e6), "1.20 M");
    EXPECT_EQ(human_count(12.34e9), "12.3 G");
}

TEST(HumanUnits, CountsNeverShowFourDigitsBeforeAPrefix)
{
    EXPECT_EQ(human_count(999'499), "999 k");
    EXPECT_EQ(human_count(999'500), "1.00 M");
    EXPECT_EQ(human_count(9'996), "10.0 k");
    EXPECT_EQ(human_count(99'960), "100 k");
}

TEST(HumanUnits, ACountOfOneUsesTheSingular)
{
    EXPECT_EQ(noun_of(1, "tiles"), "tile");
    EXPECT_EQ(noun_of(0, "tiles"), "tiles");
    EXPECT_EQ(noun_of(21, "tiles"), "tiles");
}

TEST(HumanUnits, DurationsUseOneOrTwoUnits)
{
    EXPECT_EQ(human_duration(0.314), "314 ms");
    EXPECT_EQ(human_duration(1.25), "1.25 s");
    EXPECT_EQ(human_duration(12.4), "12 s");
    EXPECT_EQ(human_duration(125), "2 min 05 s");
    EXPECT_EQ(human_duration(3 * 3600 + 7 * 60), "3 h 07 min");
    EXPECT_EQ(human_duration(52 * 3600), "2 d 04 h");
}

TEST(HumanUnits, DurationsCarryOverWhenTheyRoundUp)
{
    EXPECT_EQ(human_duration(0.9996), "1.00 s");
    EXPECT_EQ(human_duration(9.996), "10 s");
    EXPECT_EQ(human_duration(59.6), "1 min 00 s");
    EXPECT_EQ(human_duration(3599.7), "1 h 00 min");
}

TEST(HumanUnits, BytesUsePowersOfAThousand)
{
    EXPECT_EQ(human_bytes(640), "640 bytes");
    EXPECT_EQ(human_bytes(12e3), "12.0 kB");
    EXPECT_EQ(human_bytes(3.6e9), "3.60 GB");
}

} // namespace
} // namespace overturn
