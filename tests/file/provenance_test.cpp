#include "support/file_size_limit.hpp"
#include "support/refusal.hpp"
#include "support/scratch_folder.hpp"

#include "overturn/file/provenance.hpp"
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
    void write(const RunInfo& run) const { write_sidecar(folder / "a.h5", run); }
    std::string text() const { return bytes_of(folder / "a.h5.json"); }

    ScratchFolder folder;
};

RunInfo sample_run()
{
    RunInfo run;
    run.start = std::chrono::system_clock::time_point(std::chrono::seconds(1'600'000'000));
    run.wall_seconds = 12.5;
    run.kernel = "avx2";
    run.requests = 17;
    run.dealing_seconds = 0.5;
    run.ranks = {{"node\"1\"\\\n", 4117, 12.25, 0.125}, {"node2", 0, 0, 0}};
    return run;
}

TEST_F(Sidecar, StatesTimeAndHostOfTheRun)
{
    write(sample_run());
    // `date -u -d @1600000000`
    EXPECT_THAT(text(), HasSubstr("\"start\": \"2020-09-13T12:26:40Z\""));
    EXPECT_THAT(text(), HasSubstr("\"wall_seconds\": 12.5,"));
    EXPECT_THAT(text(), HasSubstr("\"requests\": 17,"));
    EXPECT_THAT(text(), HasSubstr("\"dealing_seconds\": 0.5,"));
    EXPECT_THAT(text(), HasSubstr("\"compute_seconds\": 12.25, \"write_seconds\": 0.125}"));
    EXPECT_THAT(
        text(),
        HasSubstr(
            "{\"host\": \"node2\", \"tiles\": 0, \"compute_seconds\": 0, \"write_seconds\": 0}"));
}

TEST_F(Sidecar, EscapesCharactersReservedInJson)
{
    write(sample_run());
    EXPECT_THAT(text(), HasSubstr(R"("node\"1\"\\\u000A")"));
}

TEST_F(Sidecar, ReplacesAnOlderOne)
{
    RunInfo longer = sample_run();
    longer.kernel = std::string(10000, 'x');
    write(longer);
    ASSERT_THAT(text(), HasSubstr("xx"));
    write(sample_run());
    EXPECT_THAT(text(), Not(HasSubstr("xx")));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.json.part"));
}

TEST_F(Sidecar, DoesNotReplaceAForeignFile)
{
    write_bytes(folder / "a.h5.json", "somebody else's");
    EXPECT_THROW(write(sample_run()), Error);
    EXPECT_EQ(text(), "somebody else's");
}

TEST_F(Sidecar, ThatCannotBeWrittenIsReportedAsTheOnlyLoss)
{
    const FileSizeLimit limit(20);
    EXPECT_THAT(refusal(exit_code::output, [&] { write(sample_run()); }),
                AllOf(HasSubstr("a.h5.json\", the sidecar file of this run: file too large"),
                      HasSubstr("nevertheless")));
    EXPECT_TRUE(std::filesystem::is_empty(folder / ""));
}

TEST_F(Sidecar, RequiresAFolder)
{
    EXPECT_THROW(write_sidecar(folder / "missing/a.h5", sample_run()), Error);
}

TEST(ProgramIdentity, HasAVersionAndACommit)
{
    EXPECT_THAT(std::string(program_version()), MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
    EXPECT_THAT(std::string(program_commit()), MatchesRegex("unknown|[0-9a-f]+(-dirty)?"));
}

} // namespace
} // namespace overturn
