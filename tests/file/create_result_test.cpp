#include "file/sample_job.hpp"
#include "own_dataset.hpp"
#include "support/file_size_limit.hpp"
#include "support/refusal.hpp"
#include "support/scratch_folder.hpp"

#include "overturn/file/result_writer.hpp"
#include "overturn/file/stored_result.hpp"
#include "overturn/text/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5_hl.h>

#include <cmath>
#include <optional>

namespace overturn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Returns a numeric global attribute, or nullopt if it does not exist.
std::optional<double> global_number(const std::string& path, const char* name)
{
    const hdf5::Handle file = hdf5::open_to_read(path);
    double value = 0;
    return H5LTfind_attribute(file, name) > 0 &&
                   H5LTget_attribute_double(file, "/", name, &value) >= 0
               ? std::optional(value)
               : std::nullopt;
}

/// The value of a coordinate without dimensions, or nullopt if it does not exist.
std::optional<double> single_value(const std::string& path, const char* name)
{
    const hdf5::Handle file = hdf5::open_to_read(path);
    if (H5Lexists(file, name, H5P_DEFAULT) <= 0) {
        return std::nullopt;
    }
    const hdf5::Handle dataset = hdf5::open_dataset(file, name);
    EXPECT_TRUE(shape_of(dataset).empty()) << name;
    return read_all<double>(dataset, std::filesystem::file_size(path)).front();
}

/// The sample with the slenderness of one block.
Job job_of_one_block()
{
    Job job = sample_job();
    Grid& grid = job.problem.grid;
    grid.dimensions.erase(grid.dimensions.begin());
    grid.numbers = {{&quantity("half_width"), Axis(AxisList{1})},
                    {&quantity("half_height"), Axis(AxisList{5.67})}};
    return job;
}

class CreateSpectrumFile : public testing::Test {
protected:
    void create(const char* name = "a.h5") const { create_result(folder / name, job); }

    ScratchFolder folder;
    Job job = sample_job();
};

using SpectrumFileBytes = CreateSpectrumFile;

TEST_F(CreateSpectrumFile, GivesEqualBytesForEqualJobs)
{
    create("one.h5");
    create("two.h5");
    EXPECT_EQ(bytes_of(folder / "one.h5"), bytes_of(folder / "two.h5"));
}

TEST_F(CreateSpectrumFile, StoresOnlyTheFieldsOfTheJobInItsOrder)
{
    job.problem.fields = {Field::margin, Field::region};
    create();
    EXPECT_THAT(StoredResult(folder / "a.h5").tiles().fields,
                ElementsAre(Field::margin, Field::region));
}

TEST_F(CreateSpectrumFile, StoresJobsTooLongForAnAttribute)
{
    for (int i = 0; i < 10000; ++i) {
        job.resolved += "value = " + std::to_string(i) + '\n';
    }
    ASSERT_GT(job.resolved.size(), 65536u);
    create();
    EXPECT_EQ(StoredResult(folder / "a.h5").origin().resolved_job, job.resolved);
}

TEST_F(CreateSpectrumFile, StoresTheSizeOfTheBlockIfTheJobDefinesIt)
{
    create_result(folder / "without.h5", sample_job());
    create_result(folder / "with.h5", job_of_one_block());
    EXPECT_EQ(single_value(folder / "without.h5", "half_height"), std::nullopt);
    EXPECT_EQ(single_value(folder / "without.h5", "size"), std::nullopt);
    EXPECT_EQ(single_value(folder / "with.h5", "half_width"), 1.0);
    EXPECT_EQ(single_value(folder / "with.h5", "half_height"), 5.67);
    EXPECT_DOUBLE_EQ(single_value(folder / "with.h5", "size").value(), std::hypot(1, 5.67));
    EXPECT_DOUBLE_EQ(single_value(folder / "with.h5", "slenderness").value(), std::atan(1 / 5.67));
}

TEST_F(CreateSpectrumFile, StoresTheNumbersOfItsPulseOnly)
{
    create("ricker.h5");
    job.problem.scene.motion = Pulse{PulseKind::one_sine};
    create("sine.h5");
    EXPECT_EQ(global_number(folder / "ricker.h5", "window"), 1.25);
    EXPECT_EQ(global_number(folder / "sine.h5", "window"), std::nullopt);
    job.problem.scene.motion = Pulse{PulseKind::mavroeidis_papageorgiou, {.gamma = 2.5, .nu = 0.5}};
    create("pulse.h5");
    EXPECT_EQ(global_number(folder / "pulse.h5", "gamma"), 2.5);
    EXPECT_EQ(global_number(folder / "pulse.h5", "nu"), 0.5);
    EXPECT_EQ(global_number(folder / "pulse.h5", "cycles"), std::nullopt);
}

TEST_F(CreateSpectrumFile, LeavesNoOtherFileInTheFolder)
{
    create();
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "")) {
        names.push_back(entry.path().filename().string());
    }
    EXPECT_THAT(names, ElementsAre("a.h5"));
}

TEST_F(CreateSpectrumFile, ReplacesAPartLeftByAKilledRun)
{
    // A hard link to the part keeps its data when the part is removed.
    struct Killed {};
    const auto link_and_stop = [&] {
        std::filesystem::create_hard_link(folder / "a.h5.part", folder / "left");
        throw Killed();
    };
    EXPECT_THROW(create_result(folder / "a.h5", job, {}, link_and_stop), Killed);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.part"));
    std::filesystem::rename(folder / "left", folder / "a.h5.part");
    create();
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.part"));
    EXPECT_EQ(existing_result(folder / "a.h5", job).value().tiles().tiles_done, 0);
}

TEST_F(CreateSpectrumFile, DoesNotRemoveAForeignPart)
{
    write_bytes(folder / "a.h5.part", "somebody else's");
    EXPECT_THAT(refusal(exit_code::output, [&] { create(); }),
                HasSubstr("a.h5.part\" exists but is not an overturn temporary file"));
    EXPECT_EQ(bytes_of(folder / "a.h5.part"), "somebody else's");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5"));
}

TEST_F(CreateSpectrumFile, DoesNotReplaceADanglingLink)
{
    std::filesystem::create_symlink("nowhere", folder / "a.h5");
    EXPECT_THAT(refusal(exit_code::output, [&] { create(); }),
                HasSubstr("a link to a file that does not exist"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "a.h5"));
}

TEST_F(CreateSpectrumFile, CanBeStoppedBetweenAnyTwoTilesWithoutLeavingAFile)
{
    std::int64_t calls = 0;
    create_result(folder / "a.h5", job, {}, [&] { ++calls; });
    EXPECT_EQ(calls, tiling_of(job.problem).size() * std::int64_t(job.problem.fields.size()));
    struct Stopped {};
    const auto stop = [&] {
        if (--calls == 7) {
            throw Stopped();
        }
    };
    EXPECT_THROW(create_result(folder / "b.h5", job, {}, stop), Stopped);
    EXPECT_FALSE(std::filesystem::exists(folder / "b.h5"));
    EXPECT_FALSE(std::filesystem::exists(folder / "b.h5.part"));
}

// A complete result must not keep the permissions of overturn's temporary files.
TEST_F(CreateSpectrumFile, GivesTheFileUsualPermissions)
{
    create();
    write_bytes(folder / "usual", "");
    EXPECT_EQ(std::filesystem::status(folder / "a.h5").permissions(),
              std::filesystem::status(folder / "usual").permissions());
}

TEST_F(CreateSpectrumFile, ReportsAMissingFolder)
{
    EXPECT_THAT(refusal(exit_code::output, [&] { create("results/a.h5"); }),
                HasSubstr("there is no folder \"" + folder / "results" + "\""));
}

TEST_F(CreateSpectrumFile, ReportsTheNumberOfMissingBytes)
{
    axis_of(job, "frequency") = Axis(AxisRange{1, 2, 10'000'000, Spacing::linear});
    axis_of(job, "amplitude") = Axis(AxisRange{1, 2, 10'000'000, Spacing::linear});
    const std::string message = refusal(exit_code::output, [&] { create(); });
    EXPECT_THAT(message, HasSubstr(std::to_string(std::uint64_t(result_bytes(job))) + " bytes"));
    EXPECT_THAT(message, HasSubstr("are available"));
    EXPECT_TRUE(std::filesystem::is_empty(folder / ""));
}

// A limit on the size of files simulates a full disk: it needs no privileges, and HDF5 encounters
// it during its work in the same way.
TEST_F(CreateSpectrumFile, LeavesNoFileIfTheDiskFailsDuringCreation)
{
    const FileSizeLimit limit(20000);
    EXPECT_THAT(refusal(exit_code::output, [&] { create(); }), HasSubstr("file too large"));
    EXPECT_TRUE(std::filesystem::is_empty(folder / ""));
}

void expect_close_bound(const Job& job, const std::string& path)
{
    create_result(path, job);
    const auto actual = static_cast<long double>(std::filesystem::file_size(path));
    EXPECT_GE(result_bytes(job), actual) << path;
    // The bound stated in the header.
    EXPECT_LE(result_bytes(job), actual + actual / 32 + 32768) << path;
}

TEST_F(SpectrumFileBytes, AreTheSizeOfTheFileOrLittleMore)
{
    for (const std::int64_t size : {1, 40, 500, 2000}) {
        job = sample_job();
        axis_of(job, "frequency") = Axis(AxisRange{0.5, 0.5 * double(size), size, Spacing::linear});
        // Omitting the text would be off by a fifth at 500.
        job.given = std::string(10000 * std::size_t(size), '#');
        expect_close_bound(job, folder / std::to_string(size));
    }
    job = job_of_one_block();
    expect_close_bound(job, folder / "one_block");
    job.problem.product = FilledSpectrum();
    job.problem.fields = {Field::region, Field::evaluated};
    expect_close_bound(job, folder / "filled");
    expect_close_bound(boundary_of(job_of_one_block()), folder / "boundary");
}

TEST_F(SpectrumFileBytes, IncludeTheTableAndTheRecords)
{
    std::string table = "name,height,width,restitution\n";
    for (int i = 1; i <= 3000; ++i) {
        table += "block " + std::to_string(i) + "," + std::to_string(1 + 0.01 * i) + ",0.5,0.9\n";
    }
    write_bytes(folder / "blocks.csv", table);
    std::string samples;
    for (int i = 0; i < 2000; ++i) {
        samples += i % 2 == 0 ? "0.1\n" : "-0.2\n";
    }
    write_bytes(folder / "one.txt", samples);
    write_bytes(folder / "other.txt", samples + "0.3\n");
    const std::string blocks = "[blocks]\ntable = 'blocks.csv'\n";
    expect_close_bound(read_job_text("scene.pulse = 'one_sine'\n" + blocks +
                                         "[plane]\npga = { values = [0.1, 0.2] }\n"
                                         "pulse_period = { first = 1, last = 2, count = 3 }\n",
                                     folder / "job.toml"),
                       folder / "table");
    expect_close_bound(read_job_text("[scene]\nrecord = ['one.txt', 'other.txt']\nunits = 'g'\n"
                                     "time_step = 0.01\n" +
                                         blocks +
                                         "[plane]\nscale = { first = 1, last = 2, count = 3 }\n",
                                     folder / "job.toml"),
                       folder / "suite");
}

// The index of many small tiles depends on the number of dimensions.
TEST_F(SpectrumFileBytes, DependOnTheNumberOfDimensions)
{
    write_bytes(folder / "a.txt", "0.1\n-0.2\n0.1\n");
    const std::string scene = "[scene]\nrecord = ['a.txt']\nunits = 'g'\ntime_step = 0.01\n";
    expect_close_bound(read_job_text(scene +
                                         "[plane]\nscale = { first = 1, last = 2, count = 1600 }\n"
                                         "size = { first = 1, last = 2, count = 1600 }\n"
                                         "slenderness = 0.2\nrestitution = 0.9\n",
                                     folder / "job.toml"),
                       folder / "three_dimensions");
    const std::string axis = " = { first = 0.5, last = 0.6, count = ";
    expect_close_bound(read_job_text(scene + "[plane]\nscale" + axis + "20 }\nwidth" + axis +
                                         "20 }\nheight" + axis + "20 }\nrestitution" + axis +
                                         "160 }\n",
                                     folder / "job.toml"),
                       folder / "five_dimensions");
}

// A plane can have the largest addressable size, and its coordinates need additional space.
TEST_F(SpectrumFileBytes, DoNotOverflow)
{
    const AxisRange many{0.1, 0.5, std::int64_t(1) << 31, Spacing::linear};
    axis_of(job, "frequency") = Axis(AxisList{1});
    axis_of(job, "amplitude") = Axis(AxisList{1});
    axis_of(job, "restitution_of_maximum") = Axis(many);
    axis_of(job, "slenderness") = Axis(many);
    job.problem.fields = {Field::region};
    EXPECT_GT(result_bytes(job), 0x1p65L);
    EXPECT_THAT(refusal(exit_code::output, [&] { create(); }), HasSubstr("it takes 4"));
}

} // namespace
} // namespace overturn
