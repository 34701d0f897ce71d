#include "overturn/problem/quantity.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace overturn {
namespace {

TEST(Quantity, HasANameOfItsOwnAndALabelOfAtMostFortyCharacters)
{
    std::set<std::string_view> names;
    for (const Quantity& each : all_quantities()) {
        EXPECT_TRUE(names.insert(each.name).second) << each.name;
        EXPECT_EQ(find_quantity(each.name), &each);
        EXPECT_LE(each.long_name.size(), 40u) << each.name;
    }
    EXPECT_EQ(find_quantity("slendernes"), nullptr);
}

TEST(Quantity, HasTheRangeThatTheDocumentationOfJobsStates)
{
    std::set<std::string_view> documented;
    std::vector<const Quantity*> coordinates;
    std::ifstream page(OVERTURN_DOCS "/jobs.md");
    for (std::string line; std::getline(page, line);) {
        for (const Quantity& each : all_quantities()) {
            const std::string key = fmt::format(".{}`", each.name);
            const std::string keys = line.substr(0, line.find(" | "));
            if (line.starts_with("| `") && keys.find(key) != keys.npos) {
                documented.insert(each.name);
                EXPECT_THAT(line, testing::HasSubstr(fmt::format(" | {} | ", each.interval.text)));
                if (each.is_coordinate()) {
                    coordinates.push_back(&each);
                }
            }
        }
    }
    for (const Quantity& each : all_quantities()) {
        const bool is_given = each.role != Role::derived && each.role != Role::motion;
        EXPECT_EQ(documented.contains(each.name), is_given) << each.name;
    }
    EXPECT_TRUE(std::ranges::is_sorted(coordinates)) << "the order of the dimensions of a result";
}

TEST(Quantity, AllowsNoValueThatIsNotANumber)
{
    for (const Quantity& each : all_quantities()) {
        EXPECT_FALSE(each.allows(std::numeric_limits<double>::quiet_NaN())) << each.name;
        EXPECT_FALSE(each.allows(std::numeric_limits<double>::infinity())) << each.name;
    }
}

TEST(Quantity, ExcludesThoseThatGiveTheSameAndOtherDescriptionsOfTheBlock)
{
    EXPECT_TRUE(are_equivalent("pga", "amplitude"));
    EXPECT_TRUE(are_equivalent("pulse_period", "frequency"));
    EXPECT_FALSE(are_equivalent("width", "height"));
    EXPECT_TRUE(exclude_each_other("width", "half_width"));
    EXPECT_TRUE(exclude_each_other("width", "slenderness"));
    EXPECT_TRUE(exclude_each_other("size", "half_height"));
    EXPECT_FALSE(exclude_each_other("width", "half_height"));
    EXPECT_FALSE(exclude_each_other("slenderness", "size"));
    for (const Quantity& one : all_quantities()) {
        EXPECT_TRUE(exclude_each_other(one.name, one.name));
        for (const Quantity& other : all_quantities()) {
            EXPECT_EQ(exclude_each_other(one.name, other.name),
                      exclude_each_other(other.name, one.name));
        }
    }
}

} // namespace
} // namespace overturn
