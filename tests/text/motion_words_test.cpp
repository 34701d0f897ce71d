#include "overturn/text/motion_words.hpp"

#include <gtest/gtest.h>

namespace overturn {
namespace {

TEST(MotionWords, OfTheGroundAreTheText)
{
    EXPECT_EQ(worded(MotionOf::ground, "peak ground acceleration (PGA), PGV"),
              "peak ground acceleration (PGA), PGV");
}

TEST(MotionWords, OfAFloorReplaceEveryWordOfTheGround)
{
    EXPECT_EQ(worded(MotionOf::floor, "peak ground acceleration (PGA), PGV; the ground shakes"),
              "peak floor acceleration (PFA), PFV; the floor shakes");
}

TEST(MotionWords, OfAFloorKeepNamesOfQuantities)
{
    EXPECT_EQ(worded(MotionOf::floor, "pga = 1"), "pga = 1");
}

} // namespace
} // namespace overturn
