#include "overturn/problem/fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace overturn {
namespace {

TEST(Fields, HaveNamesOfTheirOwn)
{
    std::set<std::string_view> names;
    for (const FieldTraits& traits : all_fields()) {
        EXPECT_TRUE(names.insert(traits.name).second) << traits.name;
        EXPECT_EQ(find_field(traits.name), &traits);
    }
    EXPECT_EQ(find_field("regions"), nullptr);
}

TEST(Fields, ThatAreKnownByNameHaveARow)
{
    for (const Field field : {Field::region,          Field::angle,           Field::velocity,
                              Field::margin,          Field::error,           Field::peak,
                              Field::fall_time,       Field::friction_demand, Field::normal,
                              Field::impacts,         Field::steps,           Field::status,
                              Field::region_below,    Field::flip_amplitude,  Field::flip_value,
                              Field::region_above,    Field::flip_pga,        Field::unsafe_share,
                              Field::undecided_share, Field::evaluated}) {
        EXPECT_NE(find_field(field.name), nullptr) << field.name;
    }
}

TEST(Fields, OfASpectrumHaveAValue)
{
    const std::vector<Field> of_spectrum = spectrum_fields();
    EXPECT_EQ(of_spectrum.front(), Field::region);
    for (const FieldTraits& traits : all_fields()) {
        const bool is_of_point = traits.of == FieldOf::point || traits.of == FieldOf::filled_point;
        EXPECT_EQ(std::ranges::count(of_spectrum, Field{traits.name}), is_of_point ? 1 : 0)
            << traits.name;
    }
}

TEST(Fields, HaveArraysOfTheirType)
{
    const std::size_t sizes[] = {1, 2, 4, 8}; // [bytes], in the order of FieldType
    for (const FieldTraits& traits : all_fields()) {
        const Field field{traits.name};
        const FieldType type = traits.type;
        EXPECT_EQ(not_computed(field, 3).index(), std::size_t(type)) << name_of(field);
        EXPECT_EQ(bytes_per_point(field), sizes[std::size_t(type)]) << name_of(field);
        std::visit([](const auto& values) { EXPECT_EQ(values.size(), 3u); },
                   not_computed(field, 3));
    }
}

TEST(Fields, HaveUnitsOrCodes)
{
    for (const FieldTraits& traits : all_fields()) {
        EXPECT_TRUE(!traits.units.empty() || !traits.flags.empty()) << traits.name;
        EXPECT_LE(traits.long_name.size(), 40u) << traits.name;
    }
}

} // namespace
} // namespace overturn
