#include "file/sample_job.hpp"
#include "own_dataset.hpp"
#include "support/refusal.hpp"
#include "support/scratch_folder.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/file/result_writer.hpp"
#include "overturn/text/error.hpp"

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
using testing::Not;
using testing::SizeIs;

/// Returns the message with which the file at `path` is refused; empty if it is accepted.
std::string refusal_to_replace(const std::string& path, const Job& job)
{
    return refusal(exit_code::output, [&] { existing_result(path, job); });
}

hdf5::Handle open_to_change(const std::string& path)
{
    return {H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose};
}

class ExistingResult : public testing::Test {
protected:
    void create() { create_result(path, job); }

    /// Overwrites a global attribute, as written by another program of the same format.
    template <class Value>
    void set_attribute(const char* name, const Value& value)
    {
        const hdf5::Handle file = open_to_change(path);
        hdf5::check(H5Adelete(file, name));
        hdf5::write_attribute(file, name, value);
    }

    /// Overwrites one value of a coordinate.
    void overwrite(const char* name, std::size_t place, double value)
    {
        const hdf5::Handle file = open_to_change(path);
        const hdf5::Handle dataset = hdf5::open_dataset(file, name);
        std::vector<double> values = read_all<double>(dataset, std::filesystem::file_size(path));
        values.at(place) = value;
        hdf5::check(
            H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
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
    EXPECT_THAT(refusal_to_replace(path, job),
                AllOf(HasSubstr("belongs to another job"), HasSubstr("line 2"),
                      HasSubstr("window = 1.25\n"), HasSubstr("window = 1.5\n"), HasSubstr("-o")));
}

TEST_F(ExistingResult, ReportsThatAnotherJobIsLonger)
{
    create();
    job.resolved += "one more line\n";
    EXPECT_THAT(
        refusal_to_replace(path, job),
        AllOf(HasSubstr("line 4"), HasSubstr("(nothing more)"), HasSubstr("one more line")));
}

/// The resolved job of a suite of records and a table.
std::string job_of(const std::vector<std::string>& records, const std::string& rows = "3",
                   const std::string& columns = "\"width\", \"height\"",
                   const std::string& checksum = "01")
{
    return fmt::format("title = \"\"\n\n[scene]\nrecord = [\n{}]\ntheory = \"nonlinear\"\n\n"
                       "[blocks]\ntable = \"blocks.csv\"\nrows = {}\ncolumns = [{}]\n"
                       "checksum = \"{}\"\n\n[plane]\nscale = 1\n",
                       fmt::join(records, ""), rows, columns, checksum);
}

std::string record_line(const std::string& name, int samples = 100)
{
    return fmt::format("    {{ file = \"{}\", component = \"\", samples = {} }},\n", name, samples);
}

TEST_F(ExistingResult, NamesTheTableThatHasChanged)
{
    job.resolved = job_of({record_line("a")});
    create();
    for (const std::string& other :
         {job_of({record_line("a")}, "4"), job_of({record_line("a")}, "3", "\"width\""),
          job_of({record_line("a")}, "3", "\"width\", \"height\"", "02")}) {
        job.resolved = other;
        EXPECT_THAT(refusal_to_replace(path, job),
                    AllOf(HasSubstr("the table \"blocks.csv\" has changed"),
                          HasSubstr("Restore it"), Not(HasSubstr("--set"))));
    }
}

TEST_F(ExistingResult, NamesTheRecordThatIsAnother)
{
    const std::vector<std::string> records{record_line("a"), record_line("b"), record_line("c"),
                                           record_line("d")};
    job.resolved = job_of(records);
    create();
    const auto expect = [&](const std::vector<std::string>& given, const std::string& words) {
        job.resolved = job_of(given);
        EXPECT_THAT(refusal_to_replace(path, job),
                    AllOf(HasSubstr(words), HasSubstr("Restore"), Not(HasSubstr("--set"))));
    };
    const auto others = [](const std::string& was, const std::string& is) {
        return fmt::format("the first that differs was {}, and is {} in", was, is);
    };
    const std::string names[] = {"\"a\"", "\"b\"", "\"c\"", "\"d\"", "none"};
    for (std::size_t i = 0; i < records.size(); ++i) {
        std::vector<std::string> changed = records;
        changed[i] = record_line(std::string(1, char('a' + i)), 101);
        expect(changed, fmt::format("the record {} has changed", names[i]));
        changed[i] = record_line("e");
        expect(changed, others(names[i], "\"e\""));
        std::vector<std::string> fewer = records;
        fewer.erase(fewer.begin() + std::ptrdiff_t(i));
        expect(fewer, others(names[i], names[i + 1]));
        std::vector<std::string> more = records;
        more.insert(more.begin() + std::ptrdiff_t(i), record_line("e"));
        expect(more, others(names[i], "\"e\""));
    }
    std::vector<std::string> more = records;
    more.push_back(record_line("e"));
    expect(more, others("none", "\"e\""));
}

TEST_F(ExistingResult, ShowsOnlyTheDifferingPartOfALongLine)
{
    const std::string many(30000, '7');
    job.resolved = "values = [" + many + ", 0.25, " + many + "]";
    create();
    job.resolved = "values = [" + many + ", 0.50, " + many + "]";
    EXPECT_THAT(refusal_to_replace(path, job),
                AllOf(HasSubstr(", 0.25,"), HasSubstr(", 0.50,"), SizeIs(Lt(600u))));
}

TEST_F(ExistingResult, RefusesAFileOfAnotherVersion)
{
    create();
    set_attribute("program_version", "99.1.2");
    EXPECT_THAT(refusal_to_replace(path, job),
                AllOf(HasSubstr("overturn 99.1.2"), HasSubstr(std::string(program_version()))));
}

TEST_F(ExistingResult, RefusesAFileOfAnotherCommit)
{
    create();
    set_attribute("program_commit", "0123456789abcdef");
    EXPECT_THAT(refusal_to_replace(path, job), HasSubstr("(commit 0123456789abcdef)"));
}

TEST_F(ExistingResult, RefusesAnotherKindOfHdf5File)
{
    create();
    set_attribute("kind", "rocking history");
    EXPECT_THAT(refusal_to_replace(path, job),
                HasSubstr("is a rocking history, but the job computes an "
                          "overturning spectrum"));
    set_attribute("kind", "a mesh");
    EXPECT_THAT(refusal_to_replace(path, job),
                HasSubstr("not a result of overturn: its kind is \"a mesh\""));
}

TEST_F(ExistingResult, RefusesAFileThatIsNotHdf5)
{
    write_bytes(path, "the only copy of a thesis");
    EXPECT_THAT(refusal_to_replace(path, job), HasSubstr("is not an HDF5 file"));
    EXPECT_EQ(bytes_of(path), "the only copy of a thesis");
}

TEST_F(ExistingResult, RefusesAFolder)
{
    EXPECT_THAT(refusal_to_replace(folder / "", job), HasSubstr("it is not a regular file"));
}

TEST_F(ExistingResult, RefusesATruncatedFile)
{
    create();
    std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
    EXPECT_THAT(refusal_to_replace(path, job),
                AllOf(HasSubstr("damaged"), HasSubstr("truncated file")));
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
        const hdf5::Handle file = open_to_change(path);
        const hdf5::Handle space(H5Dget_space(hdf5::open_dataset(file, "region")), H5Sclose);
        hdf5::check(H5Lmove(file, "region", file, "moved", H5P_DEFAULT, H5P_DEFAULT));
        hdf5::check(add(file, space));
    }

    /// Creates a dataset in place of `region` with the storage set by `set`.
    template <class Set>
    void store_region(const Set& set)
    {
        replace_region([&](hid_t file, hid_t space) {
            const hdf5::Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
            set(creation, space);
            return H5Dclose(H5Dcreate2(file, "region", H5T_STD_U8LE, space, H5P_DEFAULT, creation,
                                       H5P_DEFAULT));
        });
    }

    std::string elsewhere = folder / "elsewhere.h5";
};

TEST_F(ExternalReferences, RefusesValuesInAnotherFile)
{
    store_region([&](hid_t creation, hid_t) {
        H5Pset_external(creation, elsewhere.c_str(), 0, H5F_UNLIMITED);
    });
    EXPECT_THAT(refusal_to_replace(path, job),
                HasSubstr("the values of a dataset are stored in another file"));
}

TEST_F(ExternalReferences, RefusesAViewOfAnotherFile)
{
    store_region([&](hid_t creation, hid_t space) {
        H5Pset_virtual(creation, space, elsewhere.c_str(), "region", space);
    });
    EXPECT_THAT(refusal_to_replace(path, job),
                HasSubstr("the values of a dataset are stored in another file"));
}

TEST_F(ExternalReferences, RefusesALinkToAnotherFile)
{
    replace_region([&](hid_t file, hid_t) {
        return H5Lcreate_external(elsewhere.c_str(), "region", file, "region", H5P_DEFAULT,
                                  H5P_DEFAULT);
    });
    EXPECT_THAT(refusal_to_replace(path, job), HasSubstr("a dataset is a link to another object"));
}

TEST_F(ExternalReferences, RefusesALinkByName)
{
    replace_region([&](hid_t file, hid_t) {
        return H5Lcreate_soft("moved", file, "region", H5P_DEFAULT, H5P_DEFAULT);
    });
    EXPECT_THAT(refusal_to_replace(path, job), HasSubstr("a dataset is a link to another object"));
}

TEST_F(ExistingResult, IsRefusedIfItHasOtherTiles)
{
    create();
    axis_of(job, "amplitude") = Axis(AxisRange{0.25, 16, 150, Spacing::linear});
    EXPECT_THAT(refusal_to_replace(path, job),
                HasSubstr("its fields or tiles do not match its job"));
}

TEST_F(ExistingResult, IsRefusedIfACoordinateHasChanged)
{
    create();
    overwrite("amplitude", 1, 4.5);
    EXPECT_THAT(StoredResult(path).damaged_coordinates(), ElementsAre("amplitude"));
    EXPECT_THAT(refusal_to_replace(path, job),
                HasSubstr("the values of its coordinates have changed: amplitude. Remove it"));
}

TEST_F(ExistingResult, HasChecksumsOfEveryCoordinate)
{
    create();
    EXPECT_THAT(StoredResult(path).damaged_coordinates(), IsEmpty());
    for (const char* name : {"slenderness", "restitution_of_maximum", "amplitude", "frequency",
                             "restitution", "pga"}) {
        std::filesystem::remove(path);
        create();
        overwrite(name, 0, 0.123);
        EXPECT_THAT(StoredResult(path).damaged_coordinates(), ElementsAre(name));
    }
}

TEST_F(ExistingResult, OfAnotherFormatIsRefused)
{
    create();
    set_attribute("format_version", std::int64_t(2));
    EXPECT_THAT(refusal_to_replace(path, job),
                HasSubstr("has format version 2, but this program reads "
                          "versions 4 and 5. Use an older program, or compute"));
    set_attribute("format_version", std::int64_t(6));
    EXPECT_THAT(refusal_to_replace(path, job), HasSubstr("Use a newer program."));
}

} // namespace
} // namespace overturn
