// Tables of comma-separated values.
#include "overturn/record/read_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace overturn {
namespace {

Table table_of(std::string_view text)
{
    return read_table(text, "t.csv");
}

std::string refusal_of(std::string_view text)
{
    try {
        table_of(text);
    } catch (const TableError& error) {
        return error.what();
    }
    return "no error";
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
    EXPECT_TRUE(refusal_of(std::string_view("a\0\n1\0\n", 6)).starts_with("t.csv: is not a table"));
    EXPECT_TRUE(refusal_of("").starts_with("t.csv:1: the file is empty")) << refusal_of("");
    EXPECT_TRUE(refusal_of("\n\r\n").starts_with("t.csv:1: the file is empty"))
        << refusal_of("\n\r\n");
    EXPECT_TRUE(refusal_of("a,b\n").starts_with("t.csv:2: the table has no rows"))
        << refusal_of("a,b\n");
    EXPECT_TRUE(refusal_of("a,,b\n1,2,3\n").starts_with("t.csv:1:2: the column has no name"))
        << refusal_of("a,,b\n1,2,3\n");
    EXPECT_TRUE(refusal_of("a,b,a\n1,2,3\n").starts_with("t.csv:1:3: the name \"a\" is repeated"))
        << refusal_of("a,b,a\n1,2,3\n");
    EXPECT_TRUE(
        refusal_of("a,b\n1,2\n1\n").starts_with("t.csv:3: the row has 1 value, but the first "))
        << refusal_of("a,b\n1,2\n1\n");
    EXPECT_TRUE(
        refusal_of("a,b\n1,2,3\n").starts_with("t.csv:2: the row has 3 values, but the first "))
        << refusal_of("a,b\n1,2,3\n");
    EXPECT_TRUE(
        refusal_of("a,b\n1,2\n\n1,2\n").starts_with("t.csv:3: the row has 1 value, but the first "))
        << refusal_of("a,b\n1,2\n\n1,2\n");
    EXPECT_TRUE(refusal_of("a,b\n1,\"2\n").starts_with("t.csv:2:2: the quotes are not closed. Ad"))
        << refusal_of("a,b\n1,\"2\n");
    EXPECT_TRUE(
        refusal_of("a,b\n\"1\"2,3\n").starts_with("t.csv:2:1: text follows the closing quot"))
        << refusal_of("a,b\n\"1\"2,3\n");
}

} // namespace
} // namespace overturn
