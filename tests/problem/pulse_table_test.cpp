// Tables of pulses: what they become, and which are refused.
#include "overturn/problem/pulse_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace overturn {
namespace {

using testing::HasSubstr;

TEST(PulseTable, BeginsAtPhaseZeroAndHasThePeakOne)
{
    const ScaledTable table = pulse_of_table({-0.25, 0, 0.5}, {1, -4, 2});
    EXPECT_EQ(table.peak, 4);
    EXPECT_EQ(table.periods, 0.75);
    const Accelerogram& shape = *table.pulse.shape;
    EXPECT_EQ(shape.phases(),
              (std::vector<double>{0, std::numbers::pi / 2, 3 * std::numbers::pi / 2}));
    EXPECT_EQ(shape.horizontal(), (std::vector<double>{0.25, -1, 0.5}));
    EXPECT_EQ(shape.peak(), 1);
}

struct Refusal {
    std::int64_t row;
    std::string column;
    std::string text;
};

Refusal refusal_of(const std::vector<double>& times, const std::vector<double>& values)
{
    try {
        pulse_of_table(times, values);
    } catch (const GivenError& error) {
        return {error.row(), error.quantity(), error.what()};
    }
    return {GivenError::no_row, "", "accepted"};
}

TEST(PulseTable, IsRefusedIfItIsNone)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto expect = [](const Refusal& found, std::int64_t row, const std::string& column,
                           const std::string& text) {
        EXPECT_EQ(found.row, row) << text;
        EXPECT_EQ(found.column, column) << text;
        EXPECT_THAT(found.text, HasSubstr(text));
    };
    expect(refusal_of({0}, {1}), -1, "", " has 1 row. Give 2 to 65536 rows.");
    const std::vector<double> many(most_shape_rows + 1, 1.0);
    expect(refusal_of(many, many), -1, "", " has 65537 rows.");
    expect(refusal_of({0, 1, 1}, {0, 1, 0}), 2, "time", " = 1 is not after the time before it, 1");
    expect(refusal_of({0, 1, 0.5}, {0, 1, 0}), 2, "time", " = 0.5 is not after");
    expect(refusal_of({0, 1, 1 + 1e-10}, {0, 1, 0}), 2, "time", "close times");
    expect(refusal_of({0, nan}, {0, 1}), 1, "time", " = nan is not a finite number");
    expect(refusal_of({0, 1}, {0, infinity}), 1, "value", " = inf is not a finite number");
    expect(refusal_of({0, 1}, {0, 0}), -1, "", " is zero at all times");
    expect(refusal_of({-1, 1000}, {0, 1}), 1, "time", " = 1000 is 1001 periods after the first");
    expect(refusal_of({0, 1, 1 + 1e-9 * (1 + 1e-6), 1000}, {0, 1, -1, 0}), -1, "", "accepted");
}

TEST(PulseTable, OfTheSmallestAndLargestValuesHasThePeakOne)
{
    for (const double value :
         {std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max()}) {
        const ScaledTable table = pulse_of_table({0, 1}, {0, -value});
        EXPECT_EQ(table.pulse.shape->horizontal()[1], -1);
    }
}

} // namespace
} // namespace overturn
