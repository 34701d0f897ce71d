#include "overturn/problem/fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace overturn {
namespace {

TEST(Fields, HaveNamesOfTheirOwnInTheOrderOfTheEnumerators)
{
    const std::vector<std::string_view> names = field_names();
    ASSERT_EQ(names.size(), count_of_fields);
    for (std::size_t i = 0; i < names.size(); ++i) {
        EXPECT_EQ(name_of(Field(i)), names[i]);
    }
    EXPECT_EQ(std::set<std::string_view>(names.begin(), names.end()).size(), names.size());
    EXPECT_EQ(name_of(Field::region), "region");
    EXPECT_EQ(name_of(Field::status), "status");
    EXPECT_EQ(name_of(Field::flip_pga), "flip_pga");
    EXPECT_EQ(name_of(Field::evaluated), "evaluated");
}

TEST(Fields, OfASpectrumAreThoseBeforeTheFieldsOfABoundary)
{
    const std::vector<std::string_view> names = spectrum_field_names();
    EXPECT_EQ(names.front(), "region");
    EXPECT_EQ(names.back(), "status");
    for (const Field field : {Field::flip_amplitude, Field::unsafe_share, Field::evaluated}) {
        EXPECT_EQ(std::count(names.begin(), names.end(), name_of(field)), 0);
    }
}

TEST(Fields, HaveArraysOfTheirType)
{
    const std::size_t sizes[] = {1, 2, 4, 8}; // [bytes], in the order of FieldType
    for (std::size_t i = 0; i < count_of_fields; ++i) {
        const Field field = Field(i);
        const FieldType type = traits_of(field).type;
        EXPECT_EQ(not_computed(field, 3).index(), std::size_t(type)) << name_of(field);
        EXPECT_EQ(bytes_per_point(field), sizes[std::size_t(type)]) << name_of(field);
        std::visit([](const auto& values) { EXPECT_EQ(values.size(), 3u); },
                   not_computed(field, 3));
    }
}

TEST(Fields, HaveUnitsOrCodes)
{
    for (std::size_t i = 0; i < count_of_fields; ++i) {
        const FieldTraits& traits = traits_of(Field(i));
        EXPECT_TRUE(!traits.units.empty() || !traits.flags.empty()) << traits.name;
        EXPECT_LE(traits.long_name.size(), 40u) << traits.name;
    }
}

} // namespace
} // namespace overturn
