#include "overturn/text/is_one_of.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace overturn {
namespace {

TEST(IsOneOf, SearchesWordsInBraces)
{
    EXPECT_TRUE(is_one_of(std::string("cm"), {"m", "cm"}));
    EXPECT_FALSE(is_one_of("c", {"m", "cm"}));
}

TEST(IsOneOf, SearchesAnyList)
{
    EXPECT_TRUE(is_one_of(3, std::vector{1, 3}));
    EXPECT_FALSE(is_one_of(3, std::vector<int>()));
}

} // namespace
} // namespace overturn
