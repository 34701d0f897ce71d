#include "support/file_size_limit.hpp"
#include "support/refusal.hpp"
#include "support/scratch_folder.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/file/text_outputs.hpp"
#include "overturn/text/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace overturn {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::MatchesRegex;

class Sidecar : public testing::Test {
protected:
    void write(const std::string& rest) const
    {
        write_sidecar(folder / "a.h5", std::string(sidecar_beginning) + rest);
    }
    std::string text() const { return bytes_of(folder / "a.h5.json"); }

    ScratchFolder folder;
};

TEST_F(Sidecar, ReplacesAnOlderOne)
{
    write(std::string(10000, 'x'));
    ASSERT_THAT(text(), HasSubstr("xx"));
    write("new");
    EXPECT_EQ(text(), std::string(sidecar_beginning) + "new");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.json.part"));
}

TEST_F(Sidecar, DoesNotReplaceAForeignFile)
{
    write_bytes(folder / "a.h5.json", "somebody else's");
    EXPECT_THROW(write(""), Error);
    EXPECT_EQ(text(), "somebody else's");
}

TEST_F(Sidecar, ThatCannotBeWrittenIsReportedAsTheOnlyLoss)
{
    const FileSizeLimit limit(20);
    EXPECT_THAT(refusal(exit_code::output, [&] { write(""); }),
                AllOf(HasSubstr("a.h5.json\", the sidecar file of this run: file too large"),
                      HasSubstr("nevertheless")));
    EXPECT_TRUE(std::filesystem::is_empty(folder / ""));
}

TEST_F(Sidecar, RequiresAFolder)
{
    EXPECT_THROW(write_sidecar(folder / "missing/a.h5", sidecar_beginning), Error);
}

TEST(ProgramIdentity, HasAVersionAndACommit)
{
    EXPECT_THAT(std::string(program_version()), MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
    EXPECT_THAT(std::string(program_commit()), MatchesRegex("unknown|[0-9a-f]+(-dirty)?"));
}

} // namespace
} // namespace overturn
