#include "file/sample_job.hpp"
#include "hdf5_handles.hpp"
#include "support/refusal.hpp"
#include "support/scratch_folder.hpp"

#include "overturn/file/merge.hpp"
#include "overturn/file/result_writer.hpp"
#include "overturn/text/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace overturn {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

class MergedParts : public testing::Test {
protected:
    MergedParts() { job.problem.fields = {Field::margin, Field::region}; }

    std::string path_of(const JobPart& part) const
    {
        return folder / std::to_string(part.number) + "_" + std::to_string(part.count);
    }

    /// Creates a part and writes its tiles, except the last `missing` ones.
    std::string write_part(const JobPart& part, const Job& of_job, std::size_t missing = 0) const
    {
        const std::string path = path_of(part);
        create_result(path, of_job, part);
        ResultWriter file(path, MPI_COMM_SELF, of_job.problem);
        const TilesOfPart own(tiling.size(), part);
        std::vector<std::int64_t> numbers = file.missing_tiles();
        std::erase_if(numbers, [&](std::int64_t tile) { return !own.contains(tile); });
        EXPECT_EQ(std::ssize(numbers), own.size());
        numbers.resize(numbers.size() - missing);
        write_tiles(file, of_job, numbers);
        file.close();
        return path;
    }
    std::vector<std::string> write_parts(std::int64_t count) const
    {
        std::vector<std::string> paths;
        for (std::int64_t number = 1; number <= count; ++number) {
            paths.push_back(write_part({number, count}, job));
        }
        return paths;
    }

    static void merge(const std::vector<std::string>& paths, const std::string& output)
    {
        std::vector<StoredResult> parts(paths.begin(), paths.end());
        expect_all_parts(parts);
        merge_parts(parts, output, [] {});
    }
    static std::string refusal_of(const std::vector<std::string>& paths)
    {
        return refusal(exit_code::output, [&] {
            std::vector<StoredResult> parts(paths.begin(), paths.end());
            expect_all_parts(parts);
        });
    }

    /// The bytes of the file of one run, which is left at "whole".
    std::string whole() const
    {
        write_spectrum(folder / "whole", job, tiling.size());
        return bytes_of(folder / "whole");
    }

    ScratchFolder folder;
    Job job = sample_job();
    Tiling tiling = tiling_of(job.problem);
};

TEST_F(MergedParts, HaveTheBytesOfAFileWrittenByOneRun)
{
    const std::string expected = whole();
    for (const std::int64_t count :
         {std::int64_t(1), std::int64_t(3), std::int64_t(16), tiling.size()}) {
        std::vector<std::string> parts = write_parts(count);
        std::ranges::reverse(parts); // they may be given in any order
        merge(parts, folder / "merged");
        EXPECT_TRUE(bytes_of(folder / "merged") == expected) << count;
    }
}

TEST_F(MergedParts, TakeNoSpaceForTheTilesOfOthers)
{
    const auto of_part = std::filesystem::file_size(write_part({3, 16}, job));
    const auto of_whole = whole().size();
    // 2 of 36 tiles, two skeletons of 25 kB each, and 8 bytes for each tile of the job.
    EXPECT_LT(of_part, of_whole / 6);
    EXPECT_GE(result_bytes(job, JobPart{3, 16}), static_cast<long double>(of_part));
    EXPECT_LE(result_bytes(job, JobPart{3, 16}), 1.03L * static_cast<long double>(of_part) + 65536);
}

TEST_F(MergedParts, AreUnfinishedResultsOfTheirOwnTiles)
{
    const StoredResult part(write_part({3, 16}, job, 1));
    EXPECT_EQ(part.tiles().part, (JobPart{3, 16}));
    EXPECT_EQ(part.tiles().tiles_of_job, tiling.size());
    EXPECT_EQ(part.tiles().tiles, TilesOfPart(tiling.size(), JobPart{3, 16}).size());
    EXPECT_EQ(part.tiles().tiles_done, part.tiles().tiles - 1);
    EXPECT_THAT(part.damaged_coordinates(), IsEmpty());
    EXPECT_THAT(part.damaged_tiles(), IsEmpty());
}

TEST_F(MergedParts, AreContinuedAsTheSamePartOnly)
{
    const std::string path = write_part({3, 16}, job);
    EXPECT_TRUE(existing_result(path, job, JobPart{3, 16}).has_value());
    for (const std::optional<JobPart>& other :
         {std::optional<JobPart>(), {JobPart{4, 16}}, {JobPart{3, 8}}}) {
        EXPECT_THAT(refusal(exit_code::output, [&] { existing_result(path, job, other); }),
                    HasSubstr("is part 3 of 16 of this job, but"));
    }
    whole();
    EXPECT_THAT(refusal(exit_code::output,
                        [&] {
                            existing_result(folder / "whole", job, JobPart{1, 1});
                        }),
                HasSubstr("is the whole of this job, but part 1 of 1 is to be computed"));
}

TEST_F(MergedParts, AreRefusedIfOneIsMissingTwiceOrUnfinished)
{
    std::vector<std::string> parts = write_parts(4);
    std::filesystem::copy(parts[2], folder / "copy");
    parts.push_back(folder / "copy");
    EXPECT_THAT(refusal_of(parts), HasSubstr("are both part 3 of 4"));
    EXPECT_THAT(refusal_of({parts[0], parts[3]}), HasSubstr("of 4 parts, 2 are missing: 2, 3."));
    EXPECT_THAT(refusal_of({parts[1]}), HasSubstr("of 4 parts, 3 are missing: 1, 3, 4."));
    parts.pop_back();
    write_part({2, 4}, job, 2);
    EXPECT_THAT(refusal_of(parts), HasSubstr("of 4 parts, 1 is unfinished: 2."));
    EXPECT_THAT(refusal_of({parts[1], parts[3]}),
                HasSubstr("of 4 parts, 2 are missing: 1, 3, and 1 is unfinished: 2."));
}

TEST_F(MergedParts, AreRefusedIfOneBelongsToSomethingElse)
{
    const std::vector<std::string> parts = write_parts(2);
    EXPECT_THAT(refusal_of({parts[0], write_part({2, 3}, job)}),
                AllOf(HasSubstr("2_3\" is part 2 of 3"), HasSubstr("1_2\" is part 1 of 2")));
    whole();
    EXPECT_THAT(refusal_of({parts[0], folder / "whole"}),
                HasSubstr("whole\" is the file of all tiles of a job"));
    Job other = job;
    other.resolved += "more = 1\n";
    write_part({2, 2}, other);
    EXPECT_THAT(refusal_of(parts), AllOf(HasSubstr("2_2\" belongs to another job than"),
                                         HasSubstr("more = 1"), HasSubstr("--set")));
    other = job;
    axis_of(other, "amplitude") =
        Axis(AxisRange{0.5, 12.5, axis_of(job, "amplitude").size(), Spacing::linear});
    write_part({2, 2}, other);
    EXPECT_THAT(refusal_of(parts), HasSubstr("2_2\" has other values of coordinates than"));
}

TEST_F(MergedParts, AreRefusedIfOneIsOfAnotherCommit)
{
    const std::vector<std::string> parts = write_parts(2);
    {
        const hdf5::Handle file(H5Fopen(parts[1].c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
        hdf5::check(H5Adelete(file, "program_commit"));
        hdf5::write_attribute(file, "program_commit", "abcdef");
    }
    EXPECT_THAT(refusal_of(parts),
                AllOf(HasSubstr("2_2\" was computed by overturn"), HasSubstr("abcdef")));
}

TEST_F(MergedParts, LeaveNothingIfTheMergeIsStoppedAndCanBeMergedAgain)
{
    const std::vector<std::string> paths = write_parts(3);
    std::vector<StoredResult> parts(paths.begin(), paths.end());
    expect_all_parts(parts);
    struct Stopped {};
    int chunks = 0;
    EXPECT_THROW(merge_parts(parts, folder / "merged",
                             [&] {
                                 if (++chunks == 17) {
                                     throw Stopped();
                                 }
                             }),
                 Stopped);
    EXPECT_FALSE(std::filesystem::exists(folder / "merged"));
    EXPECT_FALSE(std::filesystem::exists(folder / "merged.part"));
    merge_parts(parts, folder / "merged", [] {});
    EXPECT_TRUE(bytes_of(folder / "merged") == whole());
    const StoredResult merged(folder / "merged");
    expect_merged(merged, parts.front());
    EXPECT_THAT(refusal(exit_code::output, [&] { expect_merged(parts[1], parts[0]); }),
                HasSubstr("is part 2 of 3, not the file of all parts"));
    write_spectrum(folder / "unfinished", job, 5);
    EXPECT_THAT(refusal(exit_code::output,
                        [&] { expect_merged(StoredResult(folder / "unfinished"), parts[0]); }),
                HasSubstr("exists, but lacks"));
}

TEST_F(MergedParts, AreDamagedIfTheirSkeletonIs)
{
    const std::string path = write_part({1, 2}, job);
    {
        const hdf5::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
        const hdf5::Handle skeleton = hdf5::open_dataset(file, "run/skeleton");
        const hsize_t place = 1234;
        const std::uint8_t byte = 77;
        const hdf5::Handle space(H5Dget_space(skeleton), H5Sclose);
        hdf5::check(H5Sselect_elements(space, H5S_SELECT_SET, 1, &place));
        hdf5::check(
            H5Dwrite(skeleton, H5T_NATIVE_UINT8, hdf5::space_of({1}), space, H5P_DEFAULT, &byte));
    }
    EXPECT_THAT(StoredResult(path).damaged_coordinates(), testing::ElementsAre("run/skeleton"));
}

} // namespace
} // namespace overturn
