#include "file/sample_job.hpp"
#include "support/file_size_limit.hpp"
#include "support/refusal.hpp"
#include "support/scratch_folder_mpi.hpp"

#include "overturn/file/result_writer.hpp"
#include "overturn/file/stored_result.hpp"
#include "overturn/text/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace overturn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class SpectrumFileOnRanks : public testing::Test {
protected:
    void SetUp() override
    {
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    }

    /// Rank 0 alone creates a file; the others wait for it.
    void create(const std::string& path) const
    {
        if (rank == 0) {
            create_result(path, job);
        }
        MPI_Barrier(MPI_COMM_WORLD);
    }

    /// Returns the bytes of the finished file if one rank writes all tiles in ascending order.
    std::string bytes_from_one_rank(const std::string& path) const
    {
        if (rank == 0) {
            write_spectrum(path, job, tiling.size());
        }
        MPI_Barrier(MPI_COMM_WORLD);
        return bytes_of(path);
    }

    SharedScratchFolder folder;
    Job job = sample_job();
    Tiling tiling = tiling_of(job.problem);
    int rank = 0;
    int ranks = 1;
};

TEST_F(SpectrumFileOnRanks, HasTheSameBytesForAnyDistributionAndOrderOfTiles)
{
    const std::string expected = bytes_from_one_rank(folder / "one.h5");
    create(folder / "many.h5");
    ResultWriter file(folder / "many.h5", MPI_COMM_WORLD, job.problem);
    // Unequal shares, from the last tile to the first: rank 0 writes half of them.
    std::vector<std::int64_t> mine;
    for (std::int64_t number = tiling.size() - 1; number >= 0; --number) {
        const auto owner = int(number % 2 == 0 ? 0 : number % ranks);
        if (owner == rank) {
            mine.push_back(number);
        }
    }
    write_tiles(file, job, mine);
    file.close();
    EXPECT_TRUE(bytes_of(folder / "many.h5") == expected);
}

TEST_F(SpectrumFileOnRanks, ListsTheTilesThatWereNotWritten)
{
    create(folder / "a.h5");
    {
        ResultWriter file(folder / "a.h5", MPI_COMM_WORLD, job.problem);
        if (rank == ranks - 1) {
            std::vector<std::int64_t> numbers = first_tiles(tiling.size());
            numbers.erase(numbers.begin() + 3);
            numbers.pop_back();
            write_tiles(file, job, numbers);
        }
        file.close();
    }
    EXPECT_EQ(existing_result(folder / "a.h5", job).value().tiles().tiles_done, tiling.size() - 2);
    ResultWriter file(folder / "a.h5", MPI_COMM_WORLD, job.problem);
    if (rank == 0) {
        EXPECT_THAT(file.missing_tiles(), ElementsAre(3, tiling.size() - 1));
    }
    file.close();
}

TEST_F(SpectrumFileOnRanks, HasTheSameBytesWhenFinishedLater)
{
    const std::string expected = bytes_from_one_rank(folder / "one.h5");
    create(folder / "resumed.h5");
    for (const std::int64_t remainder : {1, 0}) {
        ResultWriter file(folder / "resumed.h5", MPI_COMM_WORLD, job.problem);
        if (rank == 0) {
            std::vector<std::int64_t> numbers = file.missing_tiles();
            std::erase_if(numbers, [&](auto number) { return number % 2 != remainder; });
            write_tiles(file, job, numbers);
        }
        file.close();
    }
    EXPECT_TRUE(bytes_of(folder / "resumed.h5") == expected);
}

TEST_F(SpectrumFileOnRanks, HasTheBytesOfANewFileAfterAllTilesAreCleared)
{
    create(folder / "new.h5");
    bytes_from_one_rank(folder / "a.h5");
    ResultWriter file(folder / "a.h5", MPI_COMM_WORLD, job.problem);
    if (rank == ranks - 1) {
        for (const std::int64_t number : first_tiles(tiling.size())) {
            file.reset(tiling[number]);
        }
    }
    file.close();
    EXPECT_TRUE(bytes_of(folder / "a.h5") == bytes_of(folder / "new.h5"));
}

TEST_F(SpectrumFileOnRanks, CannotBeOpenedIfItDoesNotExist)
{
    EXPECT_THAT(refusal(exit_code::output,
                        [&] { ResultWriter(folder / "nowhere.h5", MPI_COMM_WORLD, job.problem); }),
                HasSubstr("cannot open"));
}

TEST_F(SpectrumFileOnRanks, IsComparedBetweenRanksWithoutBeingChanged)
{
    create(folder / "a.h5");
    const std::string before = bytes_of(folder / "a.h5");
    MPI_Barrier(MPI_COMM_WORLD);
    EXPECT_EQ(rank_with_another_file(folder / "a.h5", MPI_COMM_WORLD), std::nullopt);
    MPI_Barrier(MPI_COMM_WORLD);
    EXPECT_TRUE(bytes_of(folder / "a.h5") == before);
}

TEST_F(SpectrumFileOnRanks, DiffersBetweenRanksIfOneHasACopyOrNoFile)
{
    for (const char* name : {"copy.h5", "nowhere.h5"}) {
        MPI_Barrier(MPI_COMM_WORLD); // the ranks may still read the file that is recreated here
        create(folder / "a.h5");
        create(folder / "copy.h5");
        const bool differs = rank > 0 && rank == ranks - 1;
        const auto found =
            rank_with_another_file(folder / (differs ? name : "a.h5"), MPI_COMM_WORLD);
        EXPECT_EQ(found, ranks > 1 ? std::optional(ranks - 1) : std::nullopt);
    }
}

// A limit on the size of files simulates a full disk. The file is left open, as by a failing rank;
// MPI_COMM_SELF excludes the other ranks.
TEST_F(SpectrumFileOnRanks, ReportsTheTileAndTheReasonIfAWriteFails)
{
    const std::string path = folder / ("limited" + std::to_string(rank));
    create_result(path, job);
    ResultWriter file(path, MPI_COMM_SELF, job.problem);
    std::string message;
    {
        const FileSizeLimit limit(1000);
        message = refusal(exit_code::output,
                          [&] { file.write(tiling[17], sample_values(job, tiling[17])); });
    }
    EXPECT_EQ(message, "cannot write tile 17 of \"region\": file too large. Run the same command "
                       "again to resume.");
    file.close();
    EXPECT_EQ(StoredResult(path).tiles().tiles_done, 0)
        << "a tile that was not written must not count as done";
}

} // namespace
} // namespace overturn
