#include "overturn/text/nearest_name.hpp"

#include <gtest/gtest.h>

#include <array>

namespace overturn {

namespace {

constexpr std::array<std::string_view, 4> names{"one_sine", "one_cosine", "half_sine", "count"};

TEST(NearestName, IsFoundDespiteOneTypingError)
{
    EXPECT_EQ(nearest_name("one_sne", names), "one_sine");
    EXPECT_EQ(nearest_name("one_sinee", names), "one_sine");
    EXPECT_EQ(nearest_name("one-sine", names), "one_sine");
    EXPECT_EQ(nearest_name("cuont", names), "count");
}

TEST(NearestName, IsNotFoundWithManyTypingErrors)
{
    EXPECT_EQ(nearest_name("cuomt", names), "");
}

TEST(NearestName, IgnoresCase)
{
    EXPECT_EQ(nearest_name("Count", names), "count");
}

TEST(NearestName, IsTheNearestOfSeveral)
{
    EXPECT_EQ(nearest_name("one_cosin", names), "one_cosine");
    EXPECT_EQ(nearest_name("half_sin", names), "half_sine");
}

TEST(NearestName, IsOneThatBeginsWithTheWordOrTheOtherWayRound)
{
    constexpr std::string_view fields[]{"region", "friction_demand", "normal"};
    EXPECT_EQ(nearest_name("friction", fields), "friction_demand");
    EXPECT_EQ(nearest_name("fric", fields), "");
    constexpr std::string_view keys[]{"width", "friction"};
    EXPECT_EQ(nearest_name("friction_coefficient", keys), "friction");
    EXPECT_EQ(nearest_name("mu", keys), "friction");
}

TEST(NearestName, IsTheShortestOneOfWhichTheWordIsAPart)
{
    constexpr std::string_view pulses[]{"antisymmetric_ricker", "symmetric_ricker", "half_sine"};
    EXPECT_EQ(nearest_name("ricker", pulses), "symmetric_ricker");
    EXPECT_EQ(nearest_name("Ricker", pulses), "symmetric_ricker");
    EXPECT_EQ(nearest_name("a_half_sine_pulse", pulses), "half_sine");
    EXPECT_EQ(nearest_name("rick", pulses), "");
}

TEST(NearestName, IsOneWithWhichTheWordBegins)
{
    constexpr std::string_view spacings[]{"linear", "log", "g"};
    EXPECT_EQ(nearest_name("logarithmic", spacings), "log");
    EXPECT_EQ(nearest_name("gal", spacings), "");
}

TEST(NearestName, IsSuggestedInASentence)
{
    EXPECT_EQ(suggestion("one_sne", names), " Did you mean \"one_sine\"?");
    EXPECT_EQ(suggestion("cuont", names, "plane.pga."), " Did you mean \"plane.pga.count\"?");
    EXPECT_EQ(suggestion("earthquake", names), "");
}

TEST(NearestName, IsEmptyForAWordUnlikeAll)
{
    EXPECT_EQ(nearest_name("earthquake", names), "");
    EXPECT_EQ(nearest_name("", names), "");
}

} // namespace

} // namespace overturn
