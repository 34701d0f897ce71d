#include "overturn/problem/fields.hpp"

#include "support/special_values.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
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

TEST(Fields, AreStoredInSinglePrecisionIfTheyAreNumbers)
{
    const Field single{"margin", Precision::single_precision};
    EXPECT_EQ(single, Field::margin);
    EXPECT_EQ(bytes_per_point(single), 4u);
    EXPECT_TRUE(std::holds_alternative<std::vector<float>>(not_computed(single, 3)));
    EXPECT_TRUE(std::isnan(std::get<float>(fill_value(single))));
    const std::vector<double> values{0.1, -infinity};
    EXPECT_EQ(std::get<std::vector<float>>(as_stored(single, values)),
              (std::vector<float>{0.1F, float(-infinity)}));
    EXPECT_EQ(as_stored(Field::margin, values), FieldValues(values));
    const std::vector<std::uint8_t> codes{1, 255};
    EXPECT_EQ(as_stored({"region", Precision::single_precision}, codes), FieldValues(codes));
}

TEST(SinglePrecision, IsTheNearestFloat)
{
    std::mt19937_64 generator(1);
    for (int i = 0; i < 100'000; ++i) {
        const double value =
            std::ldexp(std::uniform_real_distribution(-1.0, 1.0)(generator), i % 60);
        EXPECT_LE(std::abs(in_single_precision(value) - value), 0x1p-24 * std::abs(value));
        const float exact = float(value);
        EXPECT_EQ(in_single_precision(exact), exact);
    }
}

TEST(SinglePrecision, KeepsTheSideOfZeroAndOne)
{
    const double tiny = std::numeric_limits<double>::denorm_min();
    EXPECT_GT(in_single_precision(tiny), 0.0F);
    EXPECT_LT(in_single_precision(-tiny), 0.0F);
    EXPECT_EQ(in_single_precision(0.0), 0.0F);
    EXPECT_EQ(in_single_precision(1.0), 1.0F);
    EXPECT_LT(in_single_precision(1 - epsilon / 2), 1.0F);
    EXPECT_GT(in_single_precision(1 + epsilon), 1.0F);
    EXPECT_EQ(in_single_precision(1 + 0x1p-23), float(1 + 0x1p-23));
}

TEST(SinglePrecision, KeepsWhatIsFiniteInfiniteOrUnknown)
{
    constexpr double largest = std::numeric_limits<float>::max();
    EXPECT_EQ(in_single_precision(std::numeric_limits<double>::max()), largest);
    EXPECT_EQ(in_single_precision(-1e39), -largest);
    EXPECT_EQ(in_single_precision(std::nextafter(largest, infinity)), largest);
    EXPECT_EQ(in_single_precision(infinity), infinity);
    EXPECT_EQ(in_single_precision(-infinity), -infinity);
    EXPECT_TRUE(std::isnan(in_single_precision(std::nan(""))));
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
