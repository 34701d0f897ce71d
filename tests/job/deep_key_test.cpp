#include "toml_reading.hpp"

#include "job_file.hpp"

#include "overturn/job/job.hpp"
#include "overturn/text/error.hpp"

#include <gmock/gmock.h>

namespace overturn {

namespace {

/// a.a.a: a key with the given number of parts.
std::string key_of(std::size_t parts)
{
    std::string key = "a";
    for (std::size_t i = 1; i < parts; ++i) {
        key += ".a";
    }
    return key;
}

bool has_deep_key(const std::string& text)
{
    return find_deep_key(text) != text.npos;
}

TEST(ADeepKey, HasMoreThanTheAllowedParts)
{
    EXPECT_FALSE(has_deep_key(key_of(most_key_parts) + " = 1"));
    EXPECT_TRUE(has_deep_key(key_of(most_key_parts + 1) + " = 1"));
    EXPECT_EQ(find_deep_key("b = 1\n" + key_of(100) + " = 1"), 6 + 2 * most_key_parts - 1);
}

TEST(ADeepKey, IsFoundInHeadersAndTablesAndBetweenOthers)
{
    const std::string deep = key_of(most_key_parts + 1);
    EXPECT_TRUE(has_deep_key("[" + deep + "]"));
    EXPECT_TRUE(has_deep_key("[[" + deep + "]]"));
    EXPECT_TRUE(has_deep_key("x = { y = 1.5, " + deep + " = 1 }"));
    EXPECT_TRUE(has_deep_key("a . \"b\\\".\" .'c' . " + deep + " = 1"));
    EXPECT_TRUE(has_deep_key("# \"\n" + deep + " = 1"));
}

TEST(ADeepKey, IsFoundAfterAString)
{
    const std::string deep = key_of(most_key_parts + 1);
    for (const char* const string : {R"("")", R"("\"")", R"('\')", R"("""""")", R"("""a""""")",
                                     R"("""a\""" """)", R"('''a'''')"}) {
        EXPECT_TRUE(has_deep_key("x = { y = " + (string + (", " + deep)) + " = 1 }")) << string;
    }
}

TEST(ADeepKey, IsNotAListATextOrAComment)
{
    const std::string dots(100, '.');
    std::string list = "values = [0.5";
    for (int i = 0; i < 100; ++i) {
        list += ", 0.5";
    }
    EXPECT_FALSE(has_deep_key(list + "]"));
    EXPECT_FALSE(has_deep_key("title = \"Wait \\\" " + dots + "\""));
    EXPECT_FALSE(has_deep_key("title = '" + dots + "'\ntitle = \"\"\"\n" + dots + "\"\"\"\"\n"));
    EXPECT_FALSE(has_deep_key("# " + dots));
}

// Each part creates a nested table, which could exhaust the stack.
TEST(ReadingAJob, RefusesKeysOfAMillionParts)
{
    const std::string deep = key_of(1000000);
    for (const std::string& job : {deep + " = 1", "[" + deep + "]", "x = { " + deep + " = 1 }"}) {
        EXPECT_THAT(refusal_of("\n" + job),
                    testing::AllOf(testing::StartsWith("job.toml:2:"),
                                   testing::HasSubstr(": a key has more than 16 parts")));
    }
}

TEST(AnOverride, RefusesKeysOfAMillionParts)
{
    const std::string deep = key_of(1000000);
    EXPECT_NE(refusal_of(sound_job, {deep + "=1"}), "");
    EXPECT_NE(refusal_of(sound_job, {"plane.frequency={" + deep + "=1}"}), "");
    EXPECT_EQ(job_of(sound_job, {"title=" + key_of(20)}).title, key_of(20)) << "a bare word";
}

} // namespace

} // namespace overturn
