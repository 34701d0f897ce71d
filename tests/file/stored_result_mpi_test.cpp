#include "file/sample_job.hpp"
#include "support/scratch_folder.hpp"

#include "overturn/file/result_writer.hpp"
#include "overturn/file/stored_result.hpp"
#include "overturn/text/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace overturn {
namespace {

using testing::ElementsAre;

class AStoredResult : public testing::Test {
protected:
    AStoredResult() { write_spectrum(path, job, written); }

    static constexpr std::int64_t written = 30;
    ScratchFolder folder;
    std::string path = folder / "a.h5";
    Job job = sample_job();
    Tiling tiling = tiling_of(job.problem);
};

TEST_F(AStoredResult, DescribesTheContentsOfTheFile)
{
    const StoredResult stored(path);
    EXPECT_EQ(stored.origin().kind, FileKind::spectrum);
    EXPECT_EQ(stored.origin().title, job.title);
    EXPECT_EQ(stored.origin().resolved_job, job.resolved);
    EXPECT_EQ(stored.origin().bytes, std::filesystem::file_size(path));
    const std::vector<AxisSummary>& axes = stored.tiles().axes;
    ASSERT_EQ(axes.size(), 4u);
    EXPECT_EQ(axes[0].name, "slenderness");
    EXPECT_EQ(axes[0].units, "rad");
    EXPECT_EQ(axes[3].name, "frequency");
    EXPECT_EQ(axes[3].size, 131);
    EXPECT_EQ(axes[3].first, 0.5);
    EXPECT_EQ(axes[3].last, 12);
    EXPECT_EQ(stored.tiles().fields, job.problem.fields);
}

TEST_F(AStoredResult, CountsTheTilesThatAreDone)
{
    const TilesSummary tiles = StoredResult(path).tiles();
    EXPECT_EQ(tiles.tile_shape, (Shape{1, 1, 64, 64}));
    EXPECT_EQ(tiles.tiles, tiling.size());
    EXPECT_EQ(tiles.tiles_done, written);
}

TEST_F(AStoredResult, RefusesAMissingFile)
{
    EXPECT_THROW(StoredResult(folder / "nowhere.h5"), Error);
}

TEST_F(AStoredResult, IsEndedByAnExceptionBetweenTiles)
{
    struct Stopped {};
    int calls = 0;
    const auto stop = [&] {
        if (++calls == 3) {
            throw Stopped();
        }
    };
    EXPECT_THROW(StoredResult(path).damaged_tiles(stop), Stopped);
    EXPECT_EQ(calls, 3);
}

TEST_F(AStoredResult, FindsTheTileWithAFlippedBit)
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
    EXPECT_THAT(StoredResult(path).damaged_tiles(), ElementsAre(5)); // not those without values
}

/// The bytes of a file of four tiles, all of which are written.
std::string bytes_of_a_small_file(const std::string& path)
{
    Job job = sample_job();
    for (const char* axis : {"slenderness", "restitution_of_maximum"}) {
        axis_of(job, axis) = Axis(AxisList{0.25});
    }
    for (const char* axis : {"amplitude", "frequency"}) {
        axis_of(job, axis) = Axis(AxisRange{1, 2, 65, Spacing::linear});
    }
    job.problem.fields = {Field::region, Field::impacts};
    write_spectrum(path, job, tiling_of(job.problem).size());
    return bytes_of(path);
}

// For any wrong byte the result is a summary or an Error: no crash, no endless loop, no other
// exception. A prime stride reaches all kinds of bytes; all 80000 would take minutes.
TEST(AnyFile, SurvivesAnyWrongByte)
{
    const ScratchFolder folder;
    const std::string path = folder / "a.h5";
    const std::string good = bytes_of_a_small_file(path);
    int refused = 0;
    for (std::size_t place = 0; place < good.size(); place += 61) {
        std::string bytes = good;
        bytes[place] = char(~bytes[place]);
        write_bytes(path, bytes);
        try {
            const StoredResult stored(path);
            stored.damaged_coordinates();
            stored.damaged_tiles();
        } catch (const Error&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 0);
}

TEST(AnyFile, IsRefusedIfItIsTruncatedAnywhere)
{
    const ScratchFolder folder;
    const std::string path = folder / "a.h5";
    const std::string good = bytes_of_a_small_file(path);
    for (std::size_t length = 0; length < good.size(); length += 509) {
        write_bytes(path, good.substr(0, length));
        EXPECT_THROW(StoredResult{path}, Error) << length;
    }
}

} // namespace
} // namespace overturn
