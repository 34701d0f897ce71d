// scene.shape: the table of a pulse, as a file and as a list.
#include "job_file.hpp"

#include "overturn/problem/pulse_table.hpp"
#include "support/scratch_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace overturn {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* plane =
    "\n[plane]\namplitude = 2\nfrequency = 3\nslenderness = 0.2\nrestitution = 0.9\n";

class ShapeOfAPulse : public testing::Test {
protected:
    Job job(const std::string& scene, const std::vector<std::string>& overrides = {}) const
    {
        return read_job_text("[scene]\n" + scene + plane, folder_ / "job.toml", overrides);
    }

    /// The job with this table.
    Job of(const std::string& table) const
    {
        write_bytes(folder_ / "s.csv", table);
        return job("pulse = 'table'\nshape = 's.csv'");
    }

    std::string refusal_of_table(const std::string& table) const
    {
        return refusal(exit_code::job, [&] { of(table); });
    }

    std::string refusal_of_scene(const std::string& scene) const
    {
        return refusal(exit_code::job, [&] { job(scene); });
    }

    ScratchFolder folder_;
};

void expect_triangle(const Job& job)
{
    ASSERT_EQ(job.problem.scene.records().size(), 1u);
    const Accelerogram& shape = *job.problem.scene.records()[0];
    EXPECT_EQ(shape.horizontal(), (std::vector<double>{0, 1, -0.5}));
    EXPECT_EQ(shape.phases(), pulse_of_table({0, 0.25, 1}, {0, 1, 0}).pulse.shape->phases());
    EXPECT_EQ(job.shape->peak, 2);
    EXPECT_EQ(job.problem.scene.named_pulse()->name, "table");
}

TEST_F(ShapeOfAPulse, IsReadFromTablesOfEveryForm)
{
    for (const char* table :
         {"time,value\n0,0\n0.25,2\n1,-1\n", "0,0\n0.25,2\n1,-1\n",
          "# my pulse\n# t/T;a\nt/T;a [g]\n5;0\n5,25;2\n6;-1\n", "0\t0\r\n0.25\t2\r\n1\t-1\r\n",
          "\xef\xbb\xbf\"-1\",0\n-0.75,2\n# the end\n0,-1"}) {
        expect_triangle(of(table));
    }
    expect_triangle(job("pulse = 'table'\nshape = [[0, 0], [0.25, 2], [1.0, -1.0]]"));
}

TEST_F(ShapeOfAPulse, IsRefusedWithItsLine)
{
    const auto expect = [&](const std::string& table, const std::string& text) {
        EXPECT_THAT(refusal_of_table(table), HasSubstr(text)) << table;
    };
    expect("0\n1\n", "s.csv:1:1: the line has 1 column, but the table has 2 columns: time, value.");
    expect("0 0\n1 1\n", "s.csv:1:1: the line has 1 column");
    expect("0,0,0\n1,1,0\n", "s.csv:1:1: the line has 3 columns");
    expect("t,a\n0,0\n1\n", "s.csv:3: the row has 1 value");
    expect("t,a\n0,0\n1,x\n", "s.csv:3:2: value = \"x\" is not a number.");
    expect("t,a\n0,0\n1,\n", "s.csv:3:2: value = nan is not a finite number.");
    expect("t,a\n0,nan\n1,1\n", "s.csv:2:2: value = nan is not a finite number.");
    expect("# x\nt,a\n0,0\n# y\n1,1\n1,2\n", "s.csv:6:1: time = 1 is not after the time before it");
    expect("0,0\n1,0\n", "s.csv is zero at all times.");
    expect("0,1\n", "s.csv has 1 row.");
    expect("", "s.csv:1: the file is empty.");
    expect("time,value\n", "s.csv:2: the table has no rows. Add lines of numbers.");
}

TEST_F(ShapeOfAPulse, IsRefusedWithItsKey)
{
    const auto expect = [&](const std::string& scene, const std::string& text) {
        EXPECT_THAT(refusal_of_scene(scene), HasSubstr(text)) << scene;
    };
    expect("pulse = 'table'", "scene.shape is missing. Give the path of a table of two columns");
    expect("shape = 's.csv'", "scene.pulse is missing.");
    expect("pulse = 'one_sine'\nshape = 's.csv'",
           "scene.shape has no meaning for the pulse \"one_sine\", only for table. Remove it.");
    expect("pulse = 'table'\nshape = [[0, 1], [1, 1]]\nwindow = 2",
           "scene.window has no meaning for the pulse \"table\", only for symmetric_ricker");
    expect("pulse = 'tabel'", "Did you mean \"table\"?");
    expect("pulse = 'table'\nshap = 's.csv'", "Did you mean \"scene.shape\"?");
    expect("record = 'a.AT2'\nshape = 's.csv'",
           "scene.shape cannot be combined with scene.record.");
    expect("pulse = 'table'\nshape = 'none.csv'", "none.csv: cannot be read: No such file");
    expect("pulse = 'table'\nshape = 3", "scene.shape is the integer 3, but must be a string");
    expect("pulse = 'table'\nshape = []", "scene.shape is empty. Give [time, value]");
    expect("pulse = 'table'\nshape = [[0, 1], [1]]", "scene.shape[1] has length 1.");
    expect("pulse = 'table'\nshape = [0, 1]", "scene.shape[0] is the integer 0, but must be");
    expect("pulse = 'table'\nshape = [[0, 1], [0, 2]]", "scene.shape[1][0] = 0 is not after");
    expect("pulse = 'table'\nshape = [[0, 0], [1, 0]]", "scene.shape is zero at all times.");
}

TEST_F(ShapeOfAPulse, IsNotFilledAndNotIntegratedByRungeKutta)
{
    const std::string scene = "pulse = 'table'\nshape = [[0, 1], [1, 1]]";
    EXPECT_THAT(refusal(exit_code::job, [&] { job(scene, {"numerics.fill=true"}); }),
                HasSubstr("numerics.fill = true is not possible: filling was verified for the "
                          "other pulses only."));
    EXPECT_THAT(refusal(exit_code::job, [&] { job(scene, {"numerics.method=rk45"}); }),
                HasSubstr("numerics.method = \"rk45\" is for pulses only, and not for a table."));
    EXPECT_EQ(job(scene).problem.numerics.method, Method::taylor);
}

TEST_F(ShapeOfAPulse, IsPartOfTheResolvedJob)
{
    const std::string resolved = of("0,0\n0.25,2\n1,-1\n").resolved;
    EXPECT_THAT(resolved, HasSubstr("pulse = \"table\"\nshape = { file = \"s.csv\", rows = 3, "
                                    "periods = 1.0, peak = 2.0, checksum = \""));
    EXPECT_NE(of("0,0\n0.25,2\n1,-1.5\n").resolved, resolved);
    EXPECT_NE(of("0,0\n0.26,2\n1,-1\n").resolved, resolved);
    EXPECT_EQ(of("t;a\n3;0\n3,25;2\n4;-1\n").resolved, resolved);
}

TEST_F(ShapeOfAPulse, IsDroppedWithItsPulse)
{
    const std::string scene = "pulse = 'table'\nshape = [[0, 1], [1, 1]]";
    EXPECT_THAT(job(scene, {"scene.pulse=half_sine"}).resolved,
                AllOf(HasSubstr("pulse = \"half_sine\""), Not(HasSubstr("shape"))));
    EXPECT_THAT(
        job("pulse = 'sine'\ncycles = 2", {"scene.pulse=table", "scene.shape=[[0,1],[1,1]]"})
            .resolved,
        AllOf(HasSubstr("pulse = \"table\""), Not(HasSubstr("cycles"))));
}

} // namespace
} // namespace overturn
