// The tables of a job: columns, strengths, and the motions of rows.
#include "job_with_files.hpp"

#include "support/untrapped_floating_point.hpp"

#include "overturn/problem/given.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace overturn {
namespace {

using testing::HasSubstr;

using Strengths = JobWithFiles;

TEST_F(Strengths, WhoseFactorOnTheRecordOverflowsAreRefused)
{
    const UntrappedFloatingPoint overflows;
    std::mt19937_64 random(5);
    for (int i = 0; i < 20; ++i) {
        const double peak = std::pow(10.0, -308.5 - double(random() % 100) / 10);
        write_record("b.AT2", fmt::format("0 {} 0", peak));
        EXPECT_THAT(refusal(exit_code::job, [&] { plane("record = 'b.AT2'", "pga = 1"); }),
                    HasSubstr("plane.pga = 1: scale = inf is outside [0, inf). The factor on a "
                              "record, or its vertical motion, exceeds the range"))
            << peak;
        EXPECT_THAT(refusal(exit_code::job,
                            [&] {
                                table(
                                    "slenderness,size,restitution,pga\n0.2,1,0.9,0\n0.2,1,0.9,1\n",
                                    "record = 'b.AT2'");
                            }),
                    HasSubstr("t.csv:3:4: pga = 1: scale = inf is outside"))
            << peak;
        EXPECT_EQ(refusal(exit_code::job, [&] { plane("record = 'b.AT2'", "scale = 1"); }), "");
    }
}

using Columns = JobWithFiles;

std::string with_column(const std::string& name, const std::string& value = "1")
{
    return fmt::format("slenderness,size,restitution,\"{}\"\n0.2,1,0.9,{}\n", name, value);
}

TEST_F(Columns, WhoseNamesCannotBeVariablesAreRefused)
{
    std::mt19937_64 random(6);
    const std::vector<std::string> wrong{
        " ", "\t", "\n", "\u00a0", "\u2003", "\u3000", "/", "\x7f", std::string(249, 'x')};
    for (int i = 0; i < 100; ++i) {
        const std::string name = std::string(random() % 3, 'a') +
                                 wrong[std::size_t(i) % wrong.size()] +
                                 std::string(1 + random() % 3, 'b');
        EXPECT_THAT(refusal(exit_code::job, [&] { table(with_column("c" + name)); }),
                    HasSubstr("t.csv:1:4: the column"))
            << name;
    }
    EXPECT_THAT(
        refusal(exit_code::job, [&] { table(with_column("my note")); }),
        HasSubstr("t.csv:1:4: the column \"my note\" cannot be a variable of a result file. "
                  "Allowed are up to 248 bytes without blanks"));
    for (const std::string& name : {std::string(248, 'x'), std::string("\u00fcber-h\u00f6he;[m]"),
                                    std::string("pgv"), std::string("x_length")}) {
        EXPECT_EQ(refusal(exit_code::job, [&] { table(with_column(name)); }), "") << name;
    }
}

TEST_F(Columns, WithTheNameOfAVariableOrDimensionOfTheResultAreRefused)
{
    write_record("b.AT2", "0 1 0");
    for (const char* name : {"run", "block", "motion_name"}) {
        EXPECT_THAT(refusal(exit_code::job, [&] { table(with_column(name)); }),
                    HasSubstr("is the name of a variable"));
    }
    for (const char* name :
         {"pgv", "arias_intensity", "significant_duration", "pgv_rotd50", "motion_name_length"}) {
        EXPECT_THAT(refusal(exit_code::job,
                            [&] {
                                write("t.csv", with_column(name));
                                job("record = 'b.AT2'",
                                    "[blocks]\ntable = \"t.csv\"\n[plane]\nscale = 1\n");
                            }),
                    HasSubstr("t.csv:1:4: " + std::string(name) + " is the name of a variable"));
    }
    EXPECT_THAT(
        refusal(exit_code::job,
                [&] { table("slenderness,size,restitution,id,id_length\n0.2,1,0.9,a,1\n"); }),
        HasSubstr("t.csv:1:5: id_length is the name of the dimension of the texts of id"));
}

TEST_F(Columns, ThatNameRecordsOfASuiteWithoutAssigningThemAreRefused)
{
    write_record("a.AT2", "0 1 0");
    write_record("b.AT2", "0 2 0");
    const std::string rest = "\n[blocks]\ntable = \"t.csv\"\n[plane]\nscale = 1\n";
    const auto refusal_of = [&](const std::string& name, const std::string& values) {
        write("t.csv", fmt::format("slenderness,size,restitution,{}\n{}", name, values));
        return refusal(exit_code::job, [&] { job("record = ['a.AT2', 'b.AT2']", rest); });
    };
    for (const char* name : {"record", "Record", "motions", "motion_id", "event"}) {
        for (const char* ending : {"", ".AT2"}) {
            EXPECT_THAT(
                refusal_of(name, fmt::format("0.2,1,0.9,a{0}\n0.2,1,0.9,b{0}\n", ending)),
                HasSubstr(fmt::format("t.csv:1:4: {} names records of the job, but", name)));
        }
    }
    EXPECT_EQ(refusal_of("motion", "0.2,1,0.9,a\n0.2,1,0.9,b\n"), "");
    EXPECT_EQ(refusal_of("place", "0.2,1,0.9,a\n0.2,1,0.9,hall\n"), "") << "not only records";
}

TEST_F(Columns, WithTheNameOfAQuantityInOtherLettersAreRefused)
{
    for (const Quantity& quantity : all_quantities()) {
        std::string name(quantity.name);
        name[0] = char(std::toupper(static_cast<unsigned char>(name[0])));
        const std::string message = refusal(exit_code::job, [&] { table(with_column(name)); });
        if (quantity.applies_under(Pulse::traits)) {
            EXPECT_THAT(message, HasSubstr("t.csv:1:4: " + name + " is not the quantity " +
                                           std::string(quantity.name)));
        } else {
            EXPECT_EQ(message, "");
        }
    }
}

TEST_F(Columns, MayGiveAnySubsetOfTheQuantities)
{
    const Job shapes = table("height,width\n2,0.5\n3,1\n", "pulse = \"one_sine\"",
                             "pga = { values = [0.1, 0.3] }\nrestitution_of_maximum = 1\n"
                             "pulse_period = { first = 1, last = 2, count = 3 }\n");
    EXPECT_EQ(dimensions_of(shapes), (Names{"block", "pga", "pulse_period"}));
    EXPECT_EQ(shapes.problem.grid.shape(), (Shape{2, 2, 3}));
    const Job strengths = table("pga,id\n0.1,a\n0.4,b\n", "pulse = \"one_sine\"",
                                "size = 1\nslenderness = { values = [0.2, 0.3] }\n"
                                "restitution = 0.9\npulse_period = { values = [1, 2] }\n");
    EXPECT_EQ(dimensions_of(strengths), (Names{"block", "slenderness", "pulse_period"}));
    EXPECT_EQ(strengths.problem.grid.table()->columns.size(), 1u) << "id does not describe points";
    write_record("b.AT2", "0 1 0");
    const Job sizes = table("size\n1\n2\n3\n", "record = ['b.AT2']",
                            "scale = { values = [1, 2] }\nslenderness = 0.2\nrestitution = 0.9\n");
    EXPECT_EQ(dimensions_of(sizes), (Names{"motion", "block", "scale"}));
}

TEST_F(Columns, AreRefusedAtTheirRowAndColumn)
{
    const auto refusal_of = [&](const std::string& text, const std::string& plane) {
        return refusal(exit_code::job, [&] { table(text, "pulse = \"one_sine\"", plane); });
    };
    const std::string motion = "pga = 1\npulse_period = 1\n";
    EXPECT_THAT(refusal_of("width,height,restitution\n1,2,0.9\n1,2,1.5\n", motion),
                HasSubstr("t.csv:3:3: restitution = 1.5 is outside (0, 1]."));
    EXPECT_THAT(refusal_of("width,height,restitution\n1,2,0.9\nwide,2,1\n", motion),
                HasSubstr("t.csv:3:1: width = \"wide\" is not a number"));
    EXPECT_THAT(refusal_of("width,height,restitution\n1,2,0.9\n,2,1\n", motion),
                HasSubstr("t.csv:3:1: width is empty"));
    EXPECT_THAT(refusal_of("width,half_width,height,restitution\n1,1,2,1\n", motion),
                HasSubstr("t.csv:1:2: half_width cannot be combined with width"));
    EXPECT_THAT(refusal_of("width,height,restitution,pga\n1,2,1,1\n", motion),
                HasSubstr("t.csv:1:4: pga cannot be combined with plane.pga"));
    EXPECT_THAT(refusal_of("slenderness,restitution\n0.3,0.9\n", motion),
                HasSubstr("job.toml:7:16: plane.pulse_period needs the dimensions of the block"));
    EXPECT_THAT(refusal_of("restitution,height,width\n1,1e300,1e-300\n", motion),
                HasSubstr("t.csv:2:3: width = 1e-300: slenderness = 0 is outside"));
    EXPECT_THAT(refusal_of("slenderness,size,restitution_of_maximum\n0.2,1,1\n0.2,1,1.2\n", motion),
                HasSubstr("t.csv:3:3: restitution_of_maximum = 1.2: restitution = 1.06"));
    EXPECT_THAT(refusal_of("slenderness,size,restitution\n0.2,1,0.9\n", motion + "width = 1\n"),
                HasSubstr("t.csv:1:1: slenderness cannot be combined with plane.width, which "
                          "describes the block in another way. Remove one of them."));
    EXPECT_THAT(refusal_of("width,height,restitution\n1,2,0.9\n", motion + "size = 1\n"),
                HasSubstr("job.toml:8:8: plane.size cannot be combined with the column width"));
    EXPECT_THAT(refusal_of("width,restitution\n1,0.9\n", motion),
                HasSubstr("job.toml:5:1: plane.height is missing. Give width and height, or their "
                          "halves, in metres. t.csv has the columns width, restitution."));
}

TEST_F(Columns, OfABlockWithoutAPlaneAreRefusedAtTheTable)
{
    write("t.csv", "width,restitution,pga\n1,0.9,0.2\n");
    EXPECT_THAT(refusal(exit_code::job,
                        [&] { job("pulse = \"one_sine\"", "[blocks]\ntable = \"t.csv\"\n"); }),
                HasSubstr("t.csv:1: height is missing. Give width and height"));
}

TEST_F(Columns, OfTheMotionAreIgnoredUnderAPulse)
{
    EXPECT_FALSE(table(with_column("motion", "a.AT2")).problem.scene.is_under(Under::record));
}

using Rows = JobWithFiles;

/// The numbers of the records of the rows of a table, from 1.
AxisList numbers_of_motions(const Job& job)
{
    return job.problem.grid.find("motion")->values.values();
}

TEST_F(Rows, ChooseMotionsByTheirNames)
{
    write_components("a.V2A", {"N", "E"});
    const auto motion_of = [&](const std::string& name) {
        return numbers_of_motions(
            table("slenderness,size,restitution,scale,motion\n0.2,1,0.9,1," + name + "\n",
                  "record = ['a.V2A', 'a.V2A']\ncomponent = ['N', 'E']"));
    };
    EXPECT_EQ(motion_of("a.V2A:E"), AxisList{2});
    EXPECT_EQ(motion_of("a:N"), AxisList{1});
    EXPECT_THAT(
        refusal(exit_code::job, [&] { motion_of("a.V2A"); }),
        HasSubstr("t.csv:2:5: motion = \"a.V2A\" is the name of several records: \"a.V2A:N\" "
                  "and \"a.V2A:E\". Give one of these names."));
}

TEST_F(Rows, ChooseMotionsByNamesThatLookLikeNumbers)
{
    const std::vector<std::string> names{"3", "03", "1e1", "10"};
    std::string records;
    for (std::size_t i = 0; i < names.size(); ++i) {
        write_record(names[i] + ".AT2", fmt::format("0 {} 0", 0.1 * double(i + 1)));
        records += fmt::format("{}\"{}.AT2\"", i > 0 ? ", " : "", names[i]);
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Job found =
            table("width,height,restitution,motion,scale\n1,4,0.8," + names[i] + ",1\n",
                  "record = [" + records + "]");
        EXPECT_EQ(numbers_of_motions(found), AxisList{double(i + 1)}) << names[i];
    }
}

} // namespace
} // namespace overturn
