#include "file/sample_job.hpp"
#include "support/scratch_folder.hpp"

#include "overturn/file/spectrum_file.hpp"
#include "overturn/file/spectrum_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace overturn {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Summary : public testing::Test {
protected:
    Summary()
    {
        create_spectrum_file(path, job, tiling);
        SpectrumFile file(path, MPI_COMM_SELF, job);
        for (std::int64_t number = 0; number < written; ++number) {
            file.write(tiling[number], sample_values(job, tiling[number]));
        }
        file.close();
    }

    static constexpr std::int64_t written = 30;
    ScratchFolder folder;
    std::string path = folder / "a.h5";
    Job job = sample_job();
    Tiling tiling = sample_tiling(job);
};

TEST_F(Summary, DescribesTheContentsOfTheFile)
{
    const SpectrumSummary summary = summarize(path);
    EXPECT_EQ(summary.title, job.title);
    EXPECT_EQ(summary.resolved_job, job.resolved);
    ASSERT_EQ(summary.axes.size(), 4u);
    EXPECT_EQ(summary.axes[0].name, "slenderness");
    EXPECT_EQ(summary.axes[0].units, "rad");
    EXPECT_EQ(summary.axes[3].name, "frequency");
    EXPECT_EQ(summary.axes[3].size, 11);
    EXPECT_EQ(summary.axes[3].first, 0.5);
    EXPECT_EQ(summary.axes[3].last, 12);
    ASSERT_EQ(summary.fields.size(), job.fields.size());
    EXPECT_EQ(summary.fields[4].name, "impacts");
    EXPECT_EQ(summary.fields[4].type, "uint16");
    EXPECT_EQ(summary.bytes, std::filesystem::file_size(path));
}

TEST_F(Summary, CountsTheTilesThatAreDone)
{
    const SpectrumSummary summary = summarize(path);
    EXPECT_EQ(summary.tile_shape, (Shape{1, 1, 4, 4}));
    EXPECT_EQ(summary.tiles, tiling.size());
    EXPECT_EQ(summary.tiles_done, written);
}

TEST_F(Summary, RefusesAMissingFile)
{
    EXPECT_THROW(summarize(folder / "nowhere.h5"), FileError);
}

TEST_F(Summary, ReportsTilesWithoutValuesAsUndamaged)
{
    EXPECT_THAT(damaged_tiles(path), IsEmpty());
}

TEST_F(Summary, IsEndedByAnExceptionBetweenTiles)
{
    struct Stopped {};
    int calls = 0;
    const auto stop = [&] {
        if (++calls == 3) {
            throw Stopped();
        }
    };
    EXPECT_THROW(damaged_tiles(path, stop), Stopped);
    EXPECT_EQ(calls, 3);
}

TEST_F(Summary, FindsTheTileWithAFlippedBit)
{
    // The angle at the last point of tile 5: a number that occurs nowhere else in the file.
    const TileFields fields = sample_values(job, tiling[5]);
    const double value = std::get<std::vector<double>>(fields.values[1]).back();
    std::string bytes = bytes_of(path);
    const std::size_t place =
        bytes.find(std::string_view(reinterpret_cast<const char*>(&value), sizeof value));
    ASSERT_NE(place, std::string::npos);
    bytes[place] = char(bytes[place] ^ 1);
    write_bytes(path, bytes);
    EXPECT_THAT(damaged_tiles(path), ElementsAre(5));
}

// For any wrong byte the result is a summary or a FileError: no crash, no endless loop, no other
// exception. A prime stride reaches all kinds of bytes; all 58000 would take minutes.
TEST_F(Summary, SurvivesAnyWrongByte)
{
    const std::string good = bytes_of(path);
    int refused = 0;
    for (std::size_t place = 0; place < good.size(); place += 61) {
        std::string bytes = good;
        bytes[place] = char(~bytes[place]);
        write_bytes(path, bytes);
        try {
            summarize(path);
            damaged_tiles(path);
        } catch (const FileError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 0);
}

TEST_F(Summary, RefusesAFileTruncatedAnywhere)
{
    const std::string good = bytes_of(path);
    for (std::size_t length = 0; length < good.size(); length += 509) {
        write_bytes(path, good.substr(0, length));
        EXPECT_THROW(summarize(path), FileError) << length;
    }
}

} // namespace
} // namespace overturn
