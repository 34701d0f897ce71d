#include "file/refusal.hpp"
#include "support/file_size_limit.hpp"
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

TEST(Sidecar, StatesTimeAndHostOfTheRun)
{
    const ScratchFolder folder;
    write_sidecar(folder / "a.h5", sample_run());
    const std::string text = bytes_of(folder / "a.h5.json");
    // `date -u -d @1600000000`
    EXPECT_THAT(text, HasSubstr("\"start\": \"2020-09-13T12:26:40Z\""));
    EXPECT_THAT(text, HasSubstr("\"wall_seconds\": 12.5,"));
    EXPECT_THAT(text, HasSubstr("\"requests\": 17,"));
    EXPECT_THAT(text, HasSubstr("\"dealing_seconds\": 0.5,"));
    EXPECT_THAT(text, HasSubstr("\"compute_seconds\": 12.25, \"write_seconds\": 0.125}"));
    EXPECT_THAT(
        text,
        HasSubstr(
            "{\"host\": \"node2\", \"tiles\": 0, \"compute_seconds\": 0, \"write_seconds\": 0}"));
}

TEST(Sidecar, EscapesCharactersReservedInJson)
{
    const ScratchFolder folder;
    write_sidecar(folder / "a.h5", sample_run());
    EXPECT_THAT(bytes_of(folder / "a.h5.json"), HasSubstr(R"("node\"1\"\\\u000A")"));
}

TEST(Sidecar, ReplacesAnOlderOne)
{
    const ScratchFolder folder;
    RunInfo longer = sample_run();
    longer.kernel = std::string(10000, 'x');
    write_sidecar(folder / "a.h5", longer);
    ASSERT_THAT(bytes_of(folder / "a.h5.json"), HasSubstr("xx"));
    write_sidecar(folder / "a.h5", sample_run());
    EXPECT_THAT(bytes_of(folder / "a.h5.json"), Not(HasSubstr("xx")));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.json.part"));
}

TEST(Sidecar, DoesNotReplaceAForeignFile)
{
    const ScratchFolder folder;
    write_bytes(folder / "a.h5.json", "somebody else's");
    EXPECT_THROW(write_sidecar(folder / "a.h5", sample_run()), Error);
    EXPECT_EQ(bytes_of(folder / "a.h5.json"), "somebody else's");
}

TEST(Sidecar, ThatCannotBeWrittenIsReportedAsTheOnlyLoss)
{
    const ScratchFolder folder;
    const FileSizeLimit limit(20);
    EXPECT_THAT(refusal([&] { write_sidecar(folder / "a.h5", sample_run()); }),
                AllOf(HasSubstr("a.h5.json\", the sidecar file of this run: file too large"),
                      HasSubstr("nevertheless")));
    EXPECT_TRUE(std::filesystem::is_empty(folder / ""));
}

TEST(Sidecar, RequiresAFolder)
{
    const ScratchFolder folder;
    EXPECT_THROW(write_sidecar(folder / "missing/a.h5", sample_run()), Error);
}

TEST(ProgramIdentity, HasAVersionAndACommit)
{
    EXPECT_THAT(std::string(program_version()), MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
    EXPECT_THAT(std::string(program_commit()), MatchesRegex("unknown|[0-9a-f]+(-dirty)?"));
}

} // namespace
} // namespace overturn
