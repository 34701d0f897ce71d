#include "file/sample_job.hpp"
#include "support/scratch_folder.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/file/spectrum_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace overturn {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Lt;
using testing::SizeIs;

/// Returns the message with which the file at `path` is refused; empty if it is accepted.
std::string refusal(const std::string& path, const Job& job)
{
    try {
        examine(path, job, sample_tiling(job));
        return {};
    } catch (const FileError& error) {
        return error.what();
    }
}

class Examine : public testing::Test {
protected:
    void create() { create_spectrum_file(path, job, sample_tiling(job)); }

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

    ScratchFolder folder;
    std::string path = folder / "a.h5";
    Job job = sample_job();
};

TEST_F(Examine, FindsNoFileWhereNoneExists)
{
    EXPECT_EQ(examine(path, job, sample_tiling(job)), Existing::nothing);
}

TEST_F(Examine, ReportsANewFileAsUnfinished)
{
    create();
    EXPECT_EQ(examine(path, job, sample_tiling(job)), Existing::unfinished);
}

TEST_F(Examine, DoesNotChangeTheFile)
{
    create();
    const std::string before = bytes_of(path);
    examine(path, job, sample_tiling(job));
    EXPECT_EQ(bytes_of(path), before);
}

// Many network file systems have no locks or stale ones.
TEST_F(Examine, DoesNotWaitForLocks)
{
    create();
    const int descriptor = open(path.c_str(), O_RDWR);
    ASSERT_EQ(flock(descriptor, LOCK_EX | LOCK_NB), 0);
    EXPECT_EQ(examine(path, job, sample_tiling(job)), Existing::unfinished);
    close(descriptor);
}

TEST_F(Examine, ShowsTheLineInWhichAnotherJobDiffers)
{
    create();
    job.resolved = "pulse = \"symmetric_ricker\"\nwindow = 1.5\ntolerance = 1e-09\n";
    EXPECT_THAT(refusal(path, job),
                AllOf(HasSubstr("belongs to another job"), HasSubstr("line 2"),
                      HasSubstr("window = 1.25\n"), HasSubstr("window = 1.5\n"), HasSubstr("-o")));
}

TEST_F(Examine, ReportsThatAnotherJobIsLonger)
{
    create();
    job.resolved += "one more line\n";
    EXPECT_THAT(refusal(path, job), AllOf(HasSubstr("line 4"), HasSubstr("(nothing more)"),
                                          HasSubstr("one more line")));
}

TEST_F(Examine, ShowsOnlyTheDifferingPartOfALongLine)
{
    const std::string many(30000, '7');
    job.resolved = "values = [" + many + ", 0.25, " + many + "]";
    create();
    job.resolved = "values = [" + many + ", 0.50, " + many + "]";
    EXPECT_THAT(refusal(path, job),
                AllOf(HasSubstr(", 0.25,"), HasSubstr(", 0.50,"), SizeIs(Lt(600u))));
}

TEST_F(Examine, RefusesAFileOfAnotherVersion)
{
    create();
    set_attribute("program_version", "99.1.2");
    EXPECT_THAT(refusal(path, job),
                AllOf(HasSubstr("overturn 99.1.2"), HasSubstr(std::string(program_version()))));
}

TEST_F(Examine, RefusesAFileOfAnotherCommit)
{
    create();
    set_attribute("program_commit", "0123456789abcdef");
    EXPECT_THAT(refusal(path, job), HasSubstr("(commit 0123456789abcdef)"));
}

TEST_F(Examine, RefusesAnotherKindOfHdf5File)
{
    create();
    set_attribute("kind", "rocking history");
    EXPECT_THAT(refusal(path, job), HasSubstr("not a spectrum of overturn"));
}

TEST_F(Examine, RefusesAFileThatIsNotHdf5)
{
    write_bytes(path, "the only copy of a thesis");
    EXPECT_THAT(refusal(path, job), HasSubstr("is not an HDF5 file"));
    EXPECT_EQ(bytes_of(path), "the only copy of a thesis");
}

TEST_F(Examine, RefusesAnEmptyFile)
{
    write_bytes(path, "");
    EXPECT_THAT(refusal(path, job), HasSubstr("is not an HDF5 file"));
}

TEST_F(Examine, RefusesAFolder)
{
    EXPECT_THAT(refusal(folder / "", job), HasSubstr("it is not a regular file"));
}

TEST_F(Examine, RefusesATruncatedFile)
{
    create();
    std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
    EXPECT_THAT(refusal(path, job), AllOf(HasSubstr("damaged"), HasSubstr("truncated file")));
}

/// Values, links and views in other files, to which a run must not write.
class ExamineExternalReferences : public Examine {
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

TEST_F(ExamineExternalReferences, RefusesValuesInAnotherFile)
{
    store_region([&](hid_t creation, hid_t) {
        H5Pset_external(creation, elsewhere.c_str(), 0, H5F_UNLIMITED);
    });
    EXPECT_THAT(refusal(path, job),
                HasSubstr("the values of a dataset are stored in another file"));
}

TEST_F(ExamineExternalReferences, RefusesAViewOfAnotherFile)
{
    store_region([&](hid_t creation, hid_t space) {
        H5Pset_virtual(creation, space, elsewhere.c_str(), "region", space);
    });
    EXPECT_THAT(refusal(path, job),
                HasSubstr("the values of a dataset are stored in another file"));
}

TEST_F(ExamineExternalReferences, RefusesALinkToAnotherFile)
{
    replace_region([&](hid_t file, hid_t) {
        return H5Lcreate_external(elsewhere.c_str(), "region", file, "region", H5P_DEFAULT,
                                  H5P_DEFAULT);
    });
    EXPECT_THAT(refusal(path, job), HasSubstr("a dataset is a link to another object"));
}

TEST_F(ExamineExternalReferences, RefusesALinkByName)
{
    replace_region([&](hid_t file, hid_t) {
        return H5Lcreate_soft("moved", file, "region", H5P_DEFAULT, H5P_DEFAULT);
    });
    EXPECT_THAT(refusal(path, job), HasSubstr("a dataset is a link to another object"));
}

TEST_F(Examine, RefusesAFileWithOtherTiles)
{
    create_spectrum_file(path, job, Tiling(shape_of(job.plane), {3, 3}));
    EXPECT_THAT(refusal(path, job), HasSubstr("tiles"));
}

} // namespace
} // namespace overturn
