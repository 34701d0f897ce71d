#include "overturn/text/names.hpp"

#include <gtest/gtest.h>

namespace overturn {

namespace {
enum class Colour { red, green };
enum class Nameless { any };
} // namespace

template <>
inline constexpr std::array<std::string_view, 2> names_of<Colour>{"red", "light green"};

namespace {

TEST(Names, AreThoseOfTheTable)
{
    EXPECT_EQ(name_of(Colour::green), "light green");
    EXPECT_FALSE(Named<Nameless>);
}

TEST(Names, LeadBackToTheirEnumerators)
{
    EXPECT_EQ(enumerator_named<Colour>("light green"), Colour::green);
    EXPECT_EQ(enumerator_named<Colour>("green"), std::nullopt);
}

} // namespace
} // namespace overturn
