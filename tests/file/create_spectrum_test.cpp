#include "file/sample_job.hpp"
#include "support/file_size_limit.hpp"
#include "support/scratch_folder.hpp"

#include "overturn/file/spectrum_file.hpp"
#include "overturn/file/spectrum_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <optional>

namespace overturn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Returns the message of the FileError thrown by the call; empty if none is thrown.
template <class Call>
std::string refusal(const Call& call)
{
    try {
        call();
        return {};
    } catch (const FileError& error) {
        return error.what();
    }
}

/// Returns a numeric global attribute, or nullopt if it does not exist.
std::optional<double> global_number(const std::string& path, const char* name)
{
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    std::optional<double> value;
    if (H5Aexists(file, name) > 0) {
        const hid_t attribute = H5Aopen(file, name, H5P_DEFAULT);
        H5Aread(attribute, H5T_NATIVE_DOUBLE, &value.emplace());
        H5Aclose(attribute);
    }
    H5Fclose(file);
    return value;
}

TEST(CreateSpectrumFile, GivesEqualBytesForEqualJobs)
{
    const ScratchFolder folder;
    const Job job = sample_job();
    create_spectrum_file(folder / "one.h5", job, sample_tiling(job));
    create_spectrum_file(folder / "two.h5", job, sample_tiling(job));
    EXPECT_EQ(bytes_of(folder / "one.h5"), bytes_of(folder / "two.h5"));
}

TEST(CreateSpectrumFile, StoresOnlyTheFieldsOfTheJobInItsOrder)
{
    const ScratchFolder folder;
    Job job = sample_job();
    job.fields = {Field::margin, Field::region};
    create_spectrum_file(folder / "a.h5", job, sample_tiling(job));
    std::vector<std::string> names;
    for (const FieldSummary& field : summarize(folder / "a.h5").fields) {
        names.push_back(field.name);
    }
    EXPECT_THAT(names, ElementsAre("margin", "region"));
}

TEST(CreateSpectrumFile, StoresJobsTooLongForAnAttribute)
{
    const ScratchFolder folder;
    Job job = sample_job();
    for (int i = 0; i < 10000; ++i) {
        job.resolved += "value = " + std::to_string(i) + '\n';
    }
    ASSERT_GT(job.resolved.size(), 65536u);
    create_spectrum_file(folder / "a.h5", job, sample_tiling(job));
    EXPECT_EQ(summarize(folder / "a.h5").resolved_job, job.resolved);
}

TEST(CreateSpectrumFile, StoresTheSizeOfTheBlockIfTheJobDefinesIt)
{
    const ScratchFolder folder;
    Job job = sample_job();
    create_spectrum_file(folder / "without.h5", job, sample_tiling(job));
    job.plane.block = BlockSize{.half_width = 1, .half_height = 5.67};
    create_spectrum_file(folder / "with.h5", job, sample_tiling(job));
    EXPECT_EQ(global_number(folder / "without.h5", "half_height"), std::nullopt);
    EXPECT_EQ(global_number(folder / "with.h5", "half_width"), 1.0);
    EXPECT_EQ(global_number(folder / "with.h5", "half_height"), 5.67);
}

TEST(CreateSpectrumFile, StoresTheNumbersOfItsPulseOnly)
{
    const ScratchFolder folder;
    Job job = sample_job();
    create_spectrum_file(folder / "ricker.h5", job, sample_tiling(job));
    job.scene.pulse = PulseKind::one_sine;
    create_spectrum_file(folder / "sine.h5", job, sample_tiling(job));
    EXPECT_EQ(global_number(folder / "ricker.h5", "window"), 1.25);
    EXPECT_EQ(global_number(folder / "sine.h5", "window"), std::nullopt);
    job.scene.pulse = PulseKind::mavroeidis_papageorgiou;
    job.scene.shape = {.gamma = 2.5, .nu = 0.5};
    create_spectrum_file(folder / "pulse.h5", job, sample_tiling(job));
    EXPECT_EQ(global_number(folder / "pulse.h5", "gamma"), 2.5);
    EXPECT_EQ(global_number(folder / "pulse.h5", "nu"), 0.5);
    EXPECT_EQ(global_number(folder / "pulse.h5", "cycles"), std::nullopt);
}

TEST(CreateSpectrumFile, LeavesNoOtherFileInTheFolder)
{
    const ScratchFolder folder;
    const Job job = sample_job();
    create_spectrum_file(folder / "a.h5", job, sample_tiling(job));
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "")) {
        names.push_back(entry.path().filename().string());
    }
    EXPECT_THAT(names, ElementsAre("a.h5"));
}

TEST(CreateSpectrumFile, ReplacesAPartLeftByAKilledRun)
{
    const ScratchFolder folder;
    const Job job = sample_job();
    // A hard link to the part keeps its data when the part is removed.
    struct Killed {};
    const auto link_and_stop = [&] {
        std::filesystem::create_hard_link(folder / "a.h5.part", folder / "left");
        throw Killed();
    };
    EXPECT_THROW(create_spectrum_file(folder / "a.h5", job, sample_tiling(job), link_and_stop),
                 Killed);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.part"));
    std::filesystem::rename(folder / "left", folder / "a.h5.part");
    create_spectrum_file(folder / "a.h5", job, sample_tiling(job));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.part"));
    EXPECT_EQ(examine(folder / "a.h5", job, sample_tiling(job)), Existing::unfinished);
}

TEST(CreateSpectrumFile, DoesNotRemoveAForeignPart)
{
    const ScratchFolder folder;
    write_bytes(folder / "a.h5.part", "somebody else's");
    const Job job = sample_job();
    EXPECT_THAT(refusal([&] { create_spectrum_file(folder / "a.h5", job, sample_tiling(job)); }),
                HasSubstr("a.h5.part\" exists but is not an overturn part file"));
    EXPECT_EQ(bytes_of(folder / "a.h5.part"), "somebody else's");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5"));
}

TEST(CreateSpectrumFile, DoesNotReplaceADanglingLink)
{
    const ScratchFolder folder;
    std::filesystem::create_symlink("nowhere", folder / "a.h5");
    const Job job = sample_job();
    EXPECT_THAT(refusal([&] { create_spectrum_file(folder / "a.h5", job, sample_tiling(job)); }),
                HasSubstr("a link to a file that does not exist"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "a.h5"));
}

TEST(CreateSpectrumFile, CanBeStoppedBetweenAnyTwoTilesWithoutLeavingAFile)
{
    const ScratchFolder folder;
    const Job job = sample_job();
    const Tiling tiling = sample_tiling(job);
    std::int64_t calls = 0;
    create_spectrum_file(folder / "a.h5", job, tiling, [&] { ++calls; });
    EXPECT_EQ(calls, tiling.size() * std::int64_t(job.fields.size()));
    struct Stopped {};
    const auto stop = [&] {
        if (--calls == 7) {
            throw Stopped();
        }
    };
    EXPECT_THROW(create_spectrum_file(folder / "b.h5", job, tiling, stop), Stopped);
    EXPECT_FALSE(std::filesystem::exists(folder / "b.h5"));
    EXPECT_FALSE(std::filesystem::exists(folder / "b.h5.part"));
}

// A complete result must not keep the permissions of overturn's temporary files.
TEST(CreateSpectrumFile, GivesTheFileUsualPermissions)
{
    const ScratchFolder folder;
    const Job job = sample_job();
    create_spectrum_file(folder / "a.h5", job, sample_tiling(job));
    write_bytes(folder / "usual", "");
    EXPECT_EQ(std::filesystem::status(folder / "a.h5").permissions(),
              std::filesystem::status(folder / "usual").permissions());
}

TEST(CreateSpectrumFile, ReportsAMissingFolder)
{
    const ScratchFolder folder;
    const Job job = sample_job();
    const auto create = [&] {
        create_spectrum_file(folder / "results/a.h5", job, sample_tiling(job));
    };
    EXPECT_THAT(refusal(create), HasSubstr("there is no folder \"" + folder / "results" + "\""));
}

TEST(CreateSpectrumFile, ReportsTheNumberOfMissingBytes)
{
    const ScratchFolder folder;
    Job job = sample_job();
    job.plane.frequency = Axis(AxisRange{1, 2, 10'000'000, Spacing::linear});
    job.plane.amplitude = Axis(AxisRange{1, 2, 10'000'000, Spacing::linear});
    const Tiling tiling(job.plane);
    const std::string message =
        refusal([&] { create_spectrum_file(folder / "a.h5", job, tiling); });
    EXPECT_THAT(message, HasSubstr(std::to_string(std::uint64_t(spectrum_file_bytes(job, tiling))) +
                                   " bytes"));
    EXPECT_THAT(message, HasSubstr("are available"));
    EXPECT_TRUE(std::filesystem::is_empty(folder / ""));
}

// A limit on the size of files simulates a full disk: it needs no privileges, and HDF5 encounters
// it during its work in the same way.
TEST(CreateSpectrumFile, LeavesNoFileIfTheDiskFailsDuringCreation)
{
    const ScratchFolder folder;
    const Job job = sample_job();
    const FileSizeLimit limit(20000);
    EXPECT_THAT(refusal([&] { create_spectrum_file(folder / "a.h5", job, sample_tiling(job)); }),
                HasSubstr("file too large"));
    EXPECT_TRUE(std::filesystem::is_empty(folder / ""));
}

TEST(SpectrumFileBytes, AreTheSizeOfTheFileOrLittleMore)
{
    const ScratchFolder folder;
    for (const std::int64_t size : {1, 40, 500}) {
        Job job = sample_job();
        job.plane.frequency = Axis(AxisRange{0.5, 0.5 * double(size), size, Spacing::linear});
        job.given = std::string(1000 * std::size_t(size), '#');
        job.plane.block = BlockSize{.half_width = 1, .half_height = 5.67};
        const Tiling tiling(shape_of(job.plane), {16, 16});
        const std::string path = folder / std::to_string(size);
        create_spectrum_file(path, job, tiling);
        const auto actual = static_cast<long double>(std::filesystem::file_size(path));
        EXPECT_GE(spectrum_file_bytes(job, tiling), actual) << size;
        // The bound stated in the header. Omitting the text would be off by half at 500.
        EXPECT_LE(spectrum_file_bytes(job, tiling), actual + actual / 32 + 32768) << size;
    }
}

// A plane can have the largest addressable size, and its tiles need additional space.
TEST(SpectrumFileBytes, DoNotOverflow)
{
    Job job = sample_job();
    const AxisRange many{0.1, 1, std::int64_t(1) << 31, Spacing::linear};
    job.plane.frequency = Axis(AxisList{1});
    job.plane.amplitude = Axis(AxisList{1});
    job.plane.restitution = Axis(many);
    job.plane.slenderness = Axis(many);
    job.plane.restitution_of = RestitutionOf::absolute;
    job.fields = {Field::region};
    const ScratchFolder folder;
    EXPECT_GT(spectrum_file_bytes(job, Tiling(job.plane)), 0x1p68L);
    try {
        create_spectrum_file(folder / "a.h5", job, Tiling(job.plane));
        FAIL() << "the file was created";
    } catch (const FileError& error) {
        EXPECT_THAT(error.what(), HasSubstr("it takes 38"));
    }
}

} // namespace
} // namespace overturn
