// Tables of comma-separated values.
#include "overturn/text/table.hpp"
#include "support/refusal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace overturn {
namespace {

Table table_of(std::string_view text)
{
    return read_table(text, "t.csv");
}

std::string refusal_of(std::string_view text)
{
    return refusal(exit_code::job, [&] { table_of(text); });
}

TEST(Table, HasTheNumbersOfItsColumns)
{
    const Table table = table_of("width,height\n0.5,1.5\n1e-1,+2\n");
    ASSERT_EQ(table.columns.size(), 2u);
    EXPECT_EQ(table.columns[0].name, "width");
    EXPECT_EQ(table.columns[0].numbers, (std::vector<double>{0.5, 0.1}));
    EXPECT_EQ(table.find("height")->numbers, (std::vector<double>{1.5, 2}));
    EXPECT_EQ(table.find("depth"), nullptr);
    EXPECT_EQ(table.lines, (std::vector<std::int64_t>{2, 3}));
}

TEST(Table, IsTheSameWithWindowsLineEndsByteOrderMarkBlanksAndNoLastLineEnd)
{
    const std::vector<double> expected{0.5, 0.25};
    for (const std::string_view text :
         {"a,b\n0.5,1\n0.25,2", "a,b\r\n0.5,1\r\n0.25,2\r\n",
          "\xef\xbb\xbf"
          "a,b\n0.5,1\n0.25,2\n\n\n",
          "a , b\n 0.5 ,1\n\t0.25, 2\n", "\"a\",\"b\"\n\"0.5\",1\n0.25,\"2\"\n"}) {
        const Table table = table_of(text);
        EXPECT_EQ(table.find("a")->numbers, expected) << text;
        EXPECT_EQ(table.find("b")->numbers, (std::vector<double>{1, 2})) << text;
    }
}

TEST(Table, KeepsTextAsItIs)
{
    const Table table = table_of("name,n\nDavid,1\n\"Venus, \"\"de\nMilo\"\"\",2\n007,3\n");
    EXPECT_EQ(table.columns[0].texts,
              (std::vector<std::string>{"David", "Venus, \"de\nMilo\"", "007"}));
    EXPECT_TRUE(table.columns[0].numbers.empty());
    EXPECT_EQ(table.columns[0].first_text, 0);
    EXPECT_EQ(table.columns[1].numbers, (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(table.lines, (std::vector<std::int64_t>{2, 3, 5}));
}

TEST(Table, ReadsAnEmptyValueAsUnknown)
{
    const Table table = table_of("a,b\n,1\n2,\n");
    EXPECT_TRUE(std::isnan(table.columns[0].numbers[0]));
    EXPECT_EQ(table.columns[0].numbers[1], 2);
    EXPECT_TRUE(std::isnan(table.columns[1].numbers[1]));
}

TEST(Table, IsRefusedWithLineAndColumn)
{
    for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
             {std::string("a\0\n1\0\n", 6), "t.csv: is not a table"},
             {"", "t.csv:1: the file is empty"},
             {"\n\r\n", "t.csv:1: the file is empty"},
             {"a,b\n", "t.csv:2: the table has no rows"},
             {"a,,b\n1,2,3\n", "t.csv:1:2: the column has no name"},
             {"a,b,a\n1,2,3\n", "t.csv:1:3: the name \"a\" is repeated"},
             {"a,b\n1,2\n1\n", "t.csv:3: the row has 1 value, but the first "},
             {"a,b\n1,2,3\n", "t.csv:2: the row has 3 values, but the first "},
             {"a,b\n1,2\n\n1,2\n", "t.csv:3: the row has 1 value, but the first "},
             {"a,b\n1,\"2\n", "t.csv:2:2: the quotes are not closed. Ad"},
             {"a,b\n\"1\"2,3\n", "t.csv:2:1: text follows the closing quot"}}) {
        EXPECT_TRUE(refusal_of(text).starts_with(message)) << refusal_of(text);
    }
}

TEST(Table, ThatIsNotUtf8IsRefusedWithLineAndColumn)
{
    EXPECT_EQ(refusal_of("a,b\n1,2\n3,Mus\xe9"
                         "e\n"),
              "t.csv:3:2: \"Mus\\xe9"
              "e\" is not UTF-8. Save the table in UTF-8.");
    std::mt19937_64 random(6);
    for (int i = 0; i < 200; ++i) {
        const std::uint64_t row = random() % 3;
        const std::uint64_t column = random() % 3;
        const std::string wrong =
            std::vector<std::string>{"\xff",         "\xe9t",    "\xc3",
                                     "\xed\xa0\x80", "\xc0\xaf", "\xf5\x80\x80\x80",
                                     "\x80"}[random() % 7];
        std::string text;
        for (std::uint64_t r = 0; r < 3; ++r) {
            for (std::uint64_t c = 0; c < 3; ++c) {
                const std::string value =
                    r == row && c == column ? "\u00e9" + wrong : "\u20ac" + std::to_string(c);
                text += (random() % 2 == 0 ? "\"" + value + "\"" : value) + (c == 2 ? "\n" : ",");
            }
        }
        EXPECT_TRUE(refusal_of(text).starts_with("t.csv:" + std::to_string(row + 1) + ":" +
                                                 std::to_string(column + 1) + ": "))
            << refusal_of(text);
        EXPECT_NE(refusal_of(text).find("is not UTF-8"), std::string::npos);
    }
}

TEST(Table, HasTheSeparatorOfItsNamesAndAnyDecimalMark)
{
    const std::vector<double> widths{0.5, 0.25};
    for (const char* text : {"width,name\n0.5,a\n0.25,b\n", "width;name\n0.5;a\n0.25;b\n",
                             "width;name\n0,5;a\n0,25;b\n", "width\tname\n0,5\ta\n0,25\tb\n",
                             "width;\"name\"\r\n\"0,5\";\"a\"\r\n0,25;b\r\n"}) {
        const Table table = table_of(text);
        EXPECT_EQ(table.find("width")->numbers, widths) << text;
        EXPECT_EQ(table.find("name")->texts, (std::vector<std::string>{"a", "b"})) << text;
    }
    const Table table = table_of("name;width\nVase, blue;1\n\"a;b\";2,5e-1\n");
    EXPECT_EQ(table.columns[0].texts, (std::vector<std::string>{"Vase, blue", "a;b"}));
    EXPECT_EQ(table.columns[1].numbers, (std::vector<double>{1, 0.25}));
}

TEST(Table, WithAmbiguousSeparatorsOrDecimalMarksIsRefused)
{
    for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
             {"width;height,name\n1;2,a\n", "t.csv:1:2: \"height,name\" is one name."},
             {"width|height\n1|2\n", "t.csv:1:1: \"width|height\" is one name."},
             {"a;b\n0,5;1\n0.25;1\n", "t.csv:3:1: \"0.25\" has a decimal point, but a number "},
             {"a;b\n0.5;0,5\n", "t.csv:2:2: \"0,5\" has a decimal comma, but a number "},
             {"width\n0,5\n", "t.csv:2: the row has 2 values, but the first "},
             {"width,height\n0,5,2,5\n", "t.csv:2: the row has 4 values, but the first "}}) {
        EXPECT_TRUE(refusal_of(text).starts_with(message)) << refusal_of(text);
    }
    EXPECT_NE(refusal_of("width\n0,5\n").find("The decimal mark is a point."), std::string::npos);
    const Table thousands = table_of("a;b\n1.234,5;1\n");
    EXPECT_EQ(thousands.columns[0].first_text, 0); // not a number
}

} // namespace
} // namespace overturn
