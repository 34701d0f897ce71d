#include "overturn/text/parse_number.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace overturn {
namespace {

TEST(ANumber, IsThatOfWhichTheTextWasPrinted)
{
    std::mt19937_64 generator(1);
    for (int i = 0; i < 20'000; ++i) {
        const std::uint64_t bits = generator();
        if ((~bits & 0x7ff0'0000'0000'0000) == 0) {
            continue; // not finite, perhaps a signaling NaN
        }
        const auto number = std::bit_cast<double>(bits);
        // 17 digits determine a double; so do all digits in fixed notation.
        for (const std::string& text : {fmt::format("{:.16e}", number), fmt::format("{}", number),
                                        fmt::format("{:.1100f}", number)}) {
            const ParsedNumber found = parse_number(text);
            EXPECT_EQ(found.value, number) << text;
            EXPECT_EQ(found.length, text.size());
            EXPECT_EQ(found.error, std::errc());
            if (i % 100 != 0) {
                break; // the long ones are slow to print
            }
        }
    }
}

TEST(ANumber, IsRoundedToEvenHalfwayBetweenTwoDoubles)
{
    EXPECT_EQ(parse_number("9007199254740993").value, 9007199254740992);
    EXPECT_EQ(parse_number("9007199254740993.0000000000000000001").value, 9007199254740994);
    EXPECT_EQ(parse_number("9007199254740995").value, 9007199254740996);
    EXPECT_EQ(parse_number("4.9406564584124654e-324").value,
              std::numeric_limits<double>::denorm_min());
}

TEST(ANumber, MayHaveASignAPointAndAnExponent)
{
    const std::pair<const char*, double> numbers[] = {{"5", 5},
                                                      {"+5", 5},
                                                      {"-5", -5},
                                                      {".5", 0.5},
                                                      {"5.", 5},
                                                      {"-.5E-01", -0.05},
                                                      {"+.5e+1", 5},
                                                      {"0", 0},
                                                      {"-0", -0.0},
                                                      {"1E2", 100},
                                                      {"007", 7},
                                                      {"0e999", 0},
                                                      {"inf", INFINITY},
                                                      {"-INF", -INFINITY},
                                                      {"Infinity", INFINITY}};
    for (const auto& [text, value] : numbers) {
        const ParsedNumber found = parse_number(text);
        EXPECT_TRUE(is_whole(found, text)) << text;
        EXPECT_EQ(found.value, value) << text;
        EXPECT_EQ(std::signbit(found.value), std::signbit(value)) << text;
    }
    EXPECT_TRUE(std::isnan(parse_number("nan").value));
    EXPECT_EQ(parse_number("nan").length, 3u);
}

TEST(ANumber, EndsBeforeWhatDoesNotBelongToIt)
{
    const std::pair<const char*, std::size_t> lengths[] = {
        {"10ms", 2}, {"1e", 1},   {"1e+", 1},  {"1e+x", 1}, {"1.5.2", 3}, {"2,5", 1},  {"1 2", 1},
        {"0x10", 1}, {"-1-2", 2}, {"1e5e", 3}, {"+5+", 2},  {"1d5", 1},   {"3.e2.", 4}};
    for (const auto& [text, length] : lengths) {
        EXPECT_EQ(parse_number(text).length, length) << text;
        EXPECT_FALSE(is_whole(parse_number(text), text)) << text;
    }
}

TEST(ANumber, IsNoOtherText)
{
    for (const char* const text :
         {"", " 1", "-", "+", "+-1", "--1", "++1", ".", "-.", "e5", ".e5", "x", "-e1", "\t1"}) {
        EXPECT_EQ(parse_number(text).length, 0u) << text;
        EXPECT_FALSE(is_whole(parse_number(text), text)) << text;
    }
}

TEST(ANumber, BeyondTheRangeOfDoublesIsOutOfRange)
{
    for (const char* const text :
         {"1e309", "-1e309", "1.7976931348623159e308", "1e-400", "-2e-324", "0.1e-99999"}) {
        EXPECT_EQ(parse_number(text).error, std::errc::result_out_of_range) << text;
        EXPECT_TRUE(is_whole(parse_number(text), text)) << text;
    }
}

TEST(ANumber, HasADecimalPoint)
{
    EXPECT_EQ(advice_on_decimal_comma("0,42"),
              " Numbers have a decimal point: write 0.42 instead of 0,42.");
    EXPECT_EQ(advice_on_decimal_comma("-,5e-3"),
              " Numbers have a decimal point: write -.5e-3 instead of -,5e-3.");
    EXPECT_EQ(advice_on_decimal_comma("10,000"),
              " Numbers have a decimal point: write 10.000 or 10000 instead of 10,000.");
    for (const char* const text : {"", ",", "0.42", "1,2,3", "1,2.5", "a,5", "1,b", "0, 5"}) {
        EXPECT_EQ(advice_on_decimal_comma(text), "") << text;
    }
}

} // namespace
} // namespace overturn
