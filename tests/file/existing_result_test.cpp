#include "file/sample_job.hpp"
#include "support/scratch_folder.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/file/spectrum_file.hpp"
#include "overturn/text/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace overturn {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Lt;
using testing::SizeIs;

/// Returns the message with which the file at `path` is refused; empty if it is accepted.
std::string refusal(const std::string& path, const Job& job)
{
    try {
        existing_result(path, job);
        return {};
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), exit_code::output);
        return error.what();
    }
}

class ExistingResult : public testing::Test {
protected:
    void create() { create_spectrum_file(path, job); }

    /// Overwrites a global text attribute, as written by another program of the same format.
    void set_attribute(const char* name, const std::string& text)
    {
        const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        H5Adelete(file, name);
        const hid_t type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, text.size());
        const hid_t space = H5Screate(H5S_SCALAR);
        const hid_t attribute = H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
        ASSERT_GE(H5Awrite(attribute, type, text.data()), 0);
        H5Aclose(attribute);
        H5Sclose(space);
        H5Tclose(type);
        ASSERT_GE(H5Fclose(file), 0);
    }

    /// Overwrites the version of the layout.
    void set_format(std::int64_t version)
    {
        const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        const hid_t attribute = H5Aopen(file, "format_version", H5P_DEFAULT);
        ASSERT_GE(H5Awrite(attribute, H5T_NATIVE_INT64, &version), 0);
        H5Aclose(attribute);
        ASSERT_GE(H5Fclose(file), 0);
    }

    /// Overwrites one value of a coordinate.
    void overwrite(const char* name, std::size_t place, double value)
    {
        const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
        const hid_t space = H5Dget_space(dataset);
        std::vector<double> values(std::size_t(H5Sget_simple_extent_npoints(space)));
        H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
        values.at(place) = value;
        ASSERT_GE(
            H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
        H5Sclose(space);
        H5Dclose(dataset);
        ASSERT_GE(H5Fclose(file), 0);
    }

    ScratchFolder folder;
    std::string path = folder / "a.h5";
    Job job = sample_job();
};

TEST_F(ExistingResult, IsNothingWhereNoFileExists)
{
    EXPECT_FALSE(existing_result(path, job).has_value());
}

TEST_F(ExistingResult, HasNoTilesIfItIsNew)
{
    create();
    EXPECT_EQ(existing_result(path, job).value().tiles().tiles_done, 0);
}

TEST_F(ExistingResult, DoesNotChangeTheFile)
{
    create();
    const std::string before = bytes_of(path);
    existing_result(path, job);
    EXPECT_EQ(bytes_of(path), before);
}

// Many network file systems have no locks or stale ones.
TEST_F(ExistingResult, DoesNotWaitForLocks)
{
    create();
    const int descriptor = open(path.c_str(), O_RDWR);
    ASSERT_EQ(flock(descriptor, LOCK_EX | LOCK_NB), 0);
    EXPECT_TRUE(existing_result(path, job).has_value());
    close(descriptor);
}

TEST_F(ExistingResult, ShowsTheLineInWhichAnotherJobDiffers)
{
    create();
    job.resolved = "pulse = \"symmetric_ricker\"\nwindow = 1.5\ntolerance = 1e-09\n";
    EXPECT_THAT(refusal(path, job),
                AllOf(HasSubstr("belongs to another job"), HasSubstr("line 2"),
                      HasSubstr("window = 1.25\n"), HasSubstr("window = 1.5\n"), HasSubstr("-o")));
}

TEST_F(ExistingResult, ReportsThatAnotherJobIsLonger)
{
    create();
    job.resolved += "one more line\n";
    EXPECT_THAT(refusal(path, job), AllOf(HasSubstr("line 4"), HasSubstr("(nothing more)"),
                                          HasSubstr("one more line")));
}

TEST_F(ExistingResult, ShowsOnlyTheDifferingPartOfALongLine)
{
    const std::string many(30000, '7');
    job.resolved = "values = [" + many + ", 0.25, " + many + "]";
    create();
    job.resolved = "values = [" + many + ", 0.50, " + many + "]";
    EXPECT_THAT(refusal(path, job),
                AllOf(HasSubstr(", 0.25,"), HasSubstr(", 0.50,"), SizeIs(Lt(600u))));
}

TEST_F(ExistingResult, RefusesAFileOfAnotherVersion)
{
    create();
    set_attribute("program_version", "99.1.2");
    EXPECT_THAT(refusal(path, job),
                AllOf(HasSubstr("overturn 99.1.2"), HasSubstr(std::string(program_version()))));
}

TEST_F(ExistingResult, RefusesAFileOfAnotherCommit)
{
    create();
    set_attribute("program_commit", "0123456789abcdef");
    EXPECT_THAT(refusal(path, job), HasSubstr("(commit 0123456789abcdef)"));
}

TEST_F(ExistingResult, RefusesAnotherKindOfHdf5File)
{
    create();
    set_attribute("kind", "rocking history");
    EXPECT_THAT(refusal(path, job), HasSubstr("is a rocking history, but the job computes an "
                                              "overturning spectrum"));
    set_attribute("kind", "a mesh");
    EXPECT_THAT(refusal(path, job), HasSubstr("not a result of overturn: its kind is \"a mesh\""));
}

TEST_F(ExistingResult, RefusesAFileThatIsNotHdf5)
{
    write_bytes(path, "the only copy of a thesis");
    EXPECT_THAT(refusal(path, job), HasSubstr("is not an HDF5 file"));
    EXPECT_EQ(bytes_of(path), "the only copy of a thesis");
}

TEST_F(ExistingResult, RefusesAnEmptyFile)
{
    write_bytes(path, "");
    EXPECT_THAT(refusal(path, job), HasSubstr("is not an HDF5 file"));
}

TEST_F(ExistingResult, RefusesAFolder)
{
    EXPECT_THAT(refusal(folder / "", job), HasSubstr("it is not a regular file"));
}

TEST_F(ExistingResult, RefusesATruncatedFile)
{
    create();
    std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
    EXPECT_THAT(refusal(path, job), AllOf(HasSubstr("damaged"), HasSubstr("truncated file")));
}

/// Values, links and views in other files, to which a run must not write.
class ExternalReferences : public ExistingResult {
protected:
    /// Replaces the field `region` and keeps a file of that name as a target.
    template <class Add>
    void replace_region(const Add& add)
    {
        create();
        std::filesystem::copy(path, elsewhere);
        const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        const hid_t region = H5Dopen2(file, "region", H5P_DEFAULT);
        const hid_t space = H5Dget_space(region);
        H5Dclose(region);
        ASSERT_GE(H5Lmove(file, "region", file, "moved", H5P_DEFAULT, H5P_DEFAULT), 0);
        ASSERT_GE(add(file, space), 0);
        H5Sclose(space);
        ASSERT_GE(H5Fclose(file), 0);
    }

    /// Creates a dataset in place of `region` with the storage set by `set`.
    template <class Set>
    void store_region(const Set& set)
    {
        replace_region([&](hid_t file, hid_t space) {
            const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
            set(creation, space);
            const hid_t region =
                H5Dcreate2(file, "region", H5T_STD_U8LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
            H5Pclose(creation);
            return region < 0 ? herr_t(-1) : H5Dclose(region);
        });
    }

    std::string elsewhere = folder / "elsewhere.h5";
};

TEST_F(ExternalReferences, RefusesValuesInAnotherFile)
{
    store_region([&](hid_t creation, hid_t) {
        H5Pset_external(creation, elsewhere.c_str(), 0, H5F_UNLIMITED);
    });
    EXPECT_THAT(refusal(path, job),
                HasSubstr("the values of a dataset are stored in another file"));
}

TEST_F(ExternalReferences, RefusesAViewOfAnotherFile)
{
    store_region([&](hid_t creation, hid_t space) {
        H5Pset_virtual(creation, space, elsewhere.c_str(), "region", space);
    });
    EXPECT_THAT(refusal(path, job),
                HasSubstr("the values of a dataset are stored in another file"));
}

TEST_F(ExternalReferences, RefusesALinkToAnotherFile)
{
    replace_region([&](hid_t file, hid_t) {
        return H5Lcreate_external(elsewhere.c_str(), "region", file, "region", H5P_DEFAULT,
                                  H5P_DEFAULT);
    });
    EXPECT_THAT(refusal(path, job), HasSubstr("a dataset is a link to another object"));
}

TEST_F(ExternalReferences, RefusesALinkByName)
{
    replace_region([&](hid_t file, hid_t) {
        return H5Lcreate_soft("moved", file, "region", H5P_DEFAULT, H5P_DEFAULT);
    });
    EXPECT_THAT(refusal(path, job), HasSubstr("a dataset is a link to another object"));
}

TEST_F(ExistingResult, IsRefusedIfItHasOtherTiles)
{
    create();
    axis_of(job, "amplitude") = Axis(AxisRange{0.25, 16, 150, Spacing::linear});
    EXPECT_THAT(refusal(path, job), HasSubstr("its fields or tiles do not match its job"));
}

TEST_F(ExistingResult, IsRefusedIfACoordinateHasChanged)
{
    create();
    overwrite("amplitude", 1, 4.5);
    EXPECT_THAT(StoredResult(path).damaged_coordinates(), ElementsAre("amplitude"));
    EXPECT_THAT(refusal(path, job),
                HasSubstr("the values of its coordinates have changed: amplitude. Remove it"));
}

TEST_F(ExistingResult, HasChecksumsOfEveryCoordinate)
{
    create();
    EXPECT_TRUE(StoredResult(path).has_coordinate_checksums());
    EXPECT_THAT(StoredResult(path).damaged_coordinates(), IsEmpty());
    for (const char* name : {"slenderness", "restitution_of_maximum", "amplitude", "frequency",
                             "restitution", "pga"}) {
        std::filesystem::remove(path);
        create();
        overwrite(name, 0, 0.123);
        EXPECT_THAT(StoredResult(path).damaged_coordinates(), ElementsAre(name));
    }
}

TEST_F(ExistingResult, OfAnEarlierFormatCanBeReadButNotResumed)
{
    create();
    set_format(3);
    const StoredResult stored(path);
    EXPECT_EQ(stored.origin().format, 3);
    EXPECT_EQ(stored.tiles().tiles, tiling_of(job.problem).size());
    EXPECT_FALSE(stored.has_coordinate_checksums());
    EXPECT_THAT(stored.damaged_coordinates(), IsEmpty());
    EXPECT_THAT(stored.damaged_tiles(), IsEmpty());
    EXPECT_THAT(refusal(path, job), HasSubstr("has the format of an earlier version (3), which can "
                                              "be read but not resumed"));
}

TEST_F(ExistingResult, OfAnotherFormatIsRefused)
{
    create();
    set_format(2);
    EXPECT_THAT(refusal(path, job), HasSubstr("has format version 2, but this program reads the "
                                              "versions 3 and 4. Use an older program."));
    set_format(5);
    EXPECT_THAT(refusal(path, job), HasSubstr("Use a newer program."));
}

} // namespace
} // namespace overturn
