// Names of motions and of columns, and strengths, of jobs with records and tables.
#include "job_file.hpp"

#include "support/scratch_folder.hpp"
#include "support/untrapped_floating_point.hpp"

#include "overturn/problem/given.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

namespace overturn {
namespace {

using testing::HasSubstr;

class JobWithFiles : public testing::Test {
protected:
    void write(const std::string& name, const std::string& text) const
    {
        write_bytes(folder_ / name, text);
    }

    void write_record(const std::string& name, const std::string& samples) const
    {
        write(name, "PEER\nA, 1\nIN UNITS OF G\nNPTS= 3, DT= .1\n" + samples + "\n");
    }

    /// A V2A file with these components, of two samples each.
    void write_components(const std::string& name, const std::vector<std::string>& names) const
    {
        std::string text;
        for (std::size_t i = 0; i < names.size(); ++i) {
            for (int line = 1; line <= 26; ++line) {
                text +=
                    line == 1    ? "Corrected accelerogram"
                    : line == 10 ? "Number of points 2"
                    : line == 13 ? "Component " + names[i]
                    : line == 14 ? fmt::format("Acceleration: peak {} mm/s/s", i + 1)
                    : line == 20 ? fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}", 0, 0, 0, 2, 0, 0)
                    : line == 23 ? fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}", 0, 0, 0, 0, 0, 0.1)
                                 : "";
                text += '\n';
            }
            text += fmt::format("{:>8}{:>8}\n", 0, i + 1);
        }
        write(name, text);
    }

    Job job(const std::string& scene, const std::string& rest) const
    {
        return read_job_text("[scene]\n" + scene + "\n" + rest, folder_ / "job.toml");
    }

    Job plane(const std::string& scene, const std::string& strength = "scale = 1") const
    {
        return job(scene,
                   "[plane]\n" + strength + "\nsize = 1\nslenderness = 0.2\nrestitution = 0.9\n");
    }

    /// A job with a table and a plane.
    Job table(const std::string& text, const std::string& scene, const std::string& plane) const
    {
        write("t.csv", text);
        return job(scene, "[blocks]\ntable = \"t.csv\"\n[plane]\n" + plane);
    }

    /// A job with a table of one block; pulse: under this pulse, else records of the scene.
    Job table(const std::string& text, const std::string& scene = "pulse = \"one_sine\"") const
    {
        write("t.csv", text);
        return job(scene, scene.starts_with("pulse")
                              ? "[blocks]\ntable = \"t.csv\"\n[plane]\npga = 1\n"
                                "pulse_period = 1\n"
                              : "[blocks]\ntable = \"t.csv\"\n");
    }

    ScratchFolder folder_;
};

using Names = std::vector<std::string>;

std::vector<std::string> names_of(const Job& job)
{
    std::vector<std::string> names;
    for (const RecordedMotion& motion : job.motions) {
        names.push_back(motion.name);
    }
    return names;
}

/// The numbers of the records of the rows of a table, from 1.
AxisList numbers_of_motions(const Job& job)
{
    return job.problem.grid.find("motion")->values.values();
}

using Motions = JobWithFiles;

TEST_F(Motions, AreNamedByTheirFilesAndThoseOfOneFileAlsoByTheirComponents)
{
    write_components("a.V2A", {"N28W", "S62W", "S62W"});
    write_record("b.AT2", "0 1 0");
    const Job one = plane("record = ['a.V2A', 'b.AT2']");
    EXPECT_EQ(names_of(one), (std::vector<std::string>{"a.V2A", "b.AT2"}));
    EXPECT_THAT(one.resolved, testing::Not(HasSubstr("name =")));
    const std::vector<std::string> names{"a.V2A:N28W", "a.V2A:2", "b.AT2", "a.V2A:3"};
    const Job suite =
        plane("record = ['a.V2A', 'a.V2A', 'b.AT2', 'a.V2A']\ncomponent = [1, 2, 1, 3]");
    EXPECT_EQ(names_of(suite), names);
}

TEST_F(Motions, AreRefusedIfTheyAreNamedLikeAnotherComponentOfTheFile)
{
    write_components("a.V2A", {"360", "Up", "360"});
    for (const char* key : {"component", "vertical", "second_component"}) {
        const std::string scene = fmt::format("record = 'a.V2A'\n{} = '360'", key);
        EXPECT_THAT(refusal(exit_code::job, [&] { plane(scene); }),
                    HasSubstr(fmt::format("scene.{} = 360 is the name of 2 components of "
                                          "\"a.V2A\". It has the components 1 (\"360\"), 2 "
                                          "(\"Up\"), 3 (\"360\"). Give the number of one.",
                                          key)));
    }
    EXPECT_EQ(plane("record = 'a.V2A'\ncomponent = 3\nvertical = 'Up'").motions.size(), 1);
}

TEST_F(Motions, HaveTheRemarksOnAllTheirComponents)
{
    const auto write_with_peak = [&](const std::string& file, double peak) {
        write(file, fmt::format("PEER\nA, 1\nIN UNITS OF G, PEAK = {} G\nNPTS= 3, DT= .1\n0 1 {}\n",
                                peak, file == "a.AT2" ? 0 : 0.5));
    };
    write_with_peak("a.AT2", 1.020);
    write_with_peak("b.AT2", 0.970);
    EXPECT_THAT(plane("record = 'a.AT2'\nvertical = 'b.AT2'").motions.at(0).remarks,
                testing::ElementsAre(
                    HasSubstr("a.AT2:3: the peak is 1.02 g, but that of the samples is 1 g"),
                    HasSubstr("b.AT2:3: the peak is 0.97 g, but that of the samples is 1 g")));
}

TEST_F(Motions, OfOneComponentAreNamedByTheirVerticalMotions)
{
    write_components("a.V2A", {"N", "E", "Up"});
    EXPECT_EQ(names_of(plane("record = ['a.V2A', 'a.V2A']\nvertical = ['E', 'Up']")),
              (std::vector<std::string>{"a.V2A:N:E", "a.V2A:N:Up"}));
}

using Patterns = JobWithFiles;

/// Names of folders that are also patterns, of which most do not match themselves.
const Names folders_like_patterns{"d [1]",
                                  "[ab]",
                                  "[!a]",
                                  "[a-z] 1",
                                  "x[",
                                  "]x[",
                                  "[]",
                                  "[[]",
                                  "[[:alpha:]]",
                                  "*",
                                  "a*b",
                                  "?",
                                  "a?",
                                  "**",
                                  "Kobe [NS] (1995)",
                                  "[1] [2]",
                                  "a\\b [1]",
                                  "\\*",
                                  "\\[1]",
                                  "{a,b} [1]",
                                  "[1]/[2]",
                                  "a [1]/b/c [2]"};

TEST_F(Patterns, MayContainFoldersWhoseNamesArePatterns)
{
    for (const std::string& name : folders_like_patterns) {
        std::filesystem::create_directories(folder_ / name);
        write_record(name + "/b.AT2", "0 1 0");
        write_record(name + "/a.AT2", "0 2 0");
        const Names both{name + "/a.AT2", name + "/b.AT2"};
        EXPECT_EQ(names_of(plane("record = '" + name + "/*.AT2'")), both);
        EXPECT_EQ(names_of(plane("record = '" + name + "/[ab].AT2'")), both);
        EXPECT_EQ(names_of(plane("record = '" + name + "/a.AT2'")), Names{both[0]});
        EXPECT_EQ(names_of(plane("record = '" + name + "/a.A*'")), Names{both[0]});
        const std::string absolute = folder_ / name;
        EXPECT_EQ(names_of(plane("record = '" + absolute + "/*.AT2'")),
                  (Names{absolute + "/a.AT2", absolute + "/b.AT2"}));
        EXPECT_EQ(names_of(plane("record = '" + name + "/a.AT2'\nvertical = '" + name + "/b.AT2'")),
                  Names{both[0]});
    }
}

TEST_F(Patterns, MayBeInTheFolderOfAJobWhoseNameIsAPattern)
{
    for (const std::string& name : folders_like_patterns) {
        std::filesystem::create_directories(folder_ / name);
        write_record(name + "/a.AT2", "0 1 0");
        const Job job = read_job_text("[scene]\nrecord = '*.AT2'\n[plane]\nscale = 1\nsize = 1\n"
                                      "slenderness = 0.2\nrestitution = 0.9\n",
                                      folder_ / name + "/job.toml");
        EXPECT_EQ(names_of(job), Names{"a.AT2"}) << name;
    }
}

TEST_F(Patterns, MatchOtherFoldersIfTheOneOfTheirNameHasNoSuchFile)
{
    for (const char* name : {"d [1]", "d 1"}) {
        std::filesystem::create_directories(folder_ / name);
    }
    write_record("d 1/a.AT2", "0 1 0");
    EXPECT_EQ(names_of(plane("record = 'd [1]/*.AT2'")), Names{"d 1/a.AT2"});
    write_record("d [1]/b.AT2", "0 1 0");
    EXPECT_EQ(names_of(plane("record = 'd [1]/*.AT2'")), Names{"d [1]/b.AT2"});
}

TEST_F(Patterns, WithoutFilesAreRefusedWithTheWayToWriteACharacterItself)
{
    std::filesystem::create_directories(folder_ / "e/d [1]");
    write_record("e/d [1]/a.AT2", "0 1 0");
    EXPECT_THAT(refusal(exit_code::job, [&] { plane("record = '*/d [1]/*.AT2'"); }),
                HasSubstr("scene.record = \"*/d [1]/*.AT2\" matches no file. It is relative to the "
                          "job file, and a pattern: write [*], [?] and [[] for *, ? and [ "
                          "themselves."));
    EXPECT_EQ(names_of(plane("record = '*/d [[]1]/*.AT2'")), Names{"e/d [1]/a.AT2"});
}

TEST_F(Motions, HaveASecondComponentOfTheSameFileOrOfAnother)
{
    write_components("a.V2A", {"N", "E", "Up"});
    write_record("a.AT2", "0 0.1 0");
    write_record("b.AT2", "0 0.2 0");
    const std::string direction = "scale = 1\ndirection = { values = [0, 30] }";
    const auto second = [&](const std::string& scene) {
        const Job job = plane(scene, direction);
        return job.problem.scene.records()[0]->second();
    };
    const std::vector<double> east =
        plane("record = 'a.V2A'\ncomponent = 2").problem.scene.records()[0]->horizontal();
    EXPECT_EQ(second("record = 'a.V2A'\nsecond_component = 2\nvertical = 'Up'"), east);
    EXPECT_EQ(second("record = 'a.V2A'\nsecond_component = 'E'"), east);
    EXPECT_EQ(second("record = ['a.V2A', 'a.V2A']\ncomponent = [1, 3]\nsecond_component = 2"),
              east);
    EXPECT_EQ(second("record = 'a.AT2'\nsecond_component = 'b.AT2'"),
              (std::vector<double>{0, 0.2, 0}));
    EXPECT_THAT(plane("record = 'a.V2A'\nsecond_component = 'E'", direction).resolved,
                HasSubstr("second_component = \"E\""));
    const auto message = [&](const std::string& scene) {
        return refusal(exit_code::job, [&] { plane(scene, direction); });
    };
    EXPECT_THAT(message("record = 'a.V2A'\nsecond_component = 1"),
                HasSubstr("has the accelerations of the horizontal component. Give another"));
    EXPECT_THAT(message("record = 'a.V2A'\nsecond_component = 2\nvertical = 2"),
                HasSubstr("is also the vertical component"));
    EXPECT_THAT(message("record = 'a.V2A'\nsecond_component = 4"), HasSubstr("not a component"));
    EXPECT_THAT(message("record = 'a.V2A'\nsecond_component = 'b.AT2'"), HasSubstr("samples"));
    EXPECT_THAT(refusal(exit_code::job, [&] { plane("record = 'a.V2A'\nsecond_component = 2"); }),
                HasSubstr("direction is missing"));
}

using Pairs = JobWithFiles;

const std::string in_two_directions = "scale = 1\ndirection = { values = [0, 30] }";

/// For each motion, its file and those of its second and vertical component.
std::vector<Names> files_of_motions(const Job& job)
{
    std::vector<Names> files;
    for (const RecordedMotion& motion : job.motions) {
        files.push_back({motion.file, motion.second, motion.vertical});
    }
    return files;
}

TEST_F(Pairs, OfPatternsHaveEqualPartsInPlaceOfTheWildcards)
{
    for (const char* name : {"d 1", "d [1]", "a/x", "a/y"}) {
        std::filesystem::create_directories(folder_ / name);
    }
    struct Case {
        std::string first, second, vertical; // patterns
        std::vector<Names> files;
    };
    const std::vector<Case> cases{
        {"RSN*_H1.AT2",
         "RSN*_H2.AT2",
         "",
         {{"RSN10_H1.AT2", "RSN10_H2.AT2", ""}, {"RSN9_H1.AT2", "RSN9_H2.AT2", ""}}},
        {"K*.EW", "K*.NS", "K*.UD", {{"K1.EW", "K1.NS", "K1.UD"}, {"K2.EW", "K2.NS", "K2.UD"}}},
        {"d [1]/*.H1", "d 1/*.H2", "", {{"d [1]/a.H1", "d 1/a.H2", ""}}},
        {"./a/*/h1*",
         "./a/*/h2*",
         "",
         {{"./a/x/h1", "./a/x/h2", ""}, {"./a/y/h1", "./a/y/h2", ""}}},
        {"E?..HNE.D*.txt",
         "E?..HNN.D*.txt",
         "",
         {{"EA..HNE.D1.HNE.txt", "EA..HNN.D1.HNE.txt", ""}}},
        {"S[0-9]\\*-[[:alpha:]]1",
         "S[!a]\\*-[]A-Z]2",
         "",
         {{"S1*-A1", "S1*-A2", ""}, {"S2*-A1", "S2*-A2", ""}}}};
    double peak = 0;
    for (const Case& each : cases) {
        for (const Names& files : each.files) {
            for (const std::string& file : files) {
                if (!file.empty()) {
                    write_record(file, fmt::format("0 {} 0", peak += 0.1));
                }
            }
        }
        for (const std::string& folder : {std::string(), folder_ / ""}) { // relative, absolute
            const Job job =
                plane(fmt::format("record = '{0}{1}'\nsecond_component = '{0}{2}'\n{3}", folder,
                                  each.first, each.second,
                                  each.vertical.empty()
                                      ? ""
                                      : fmt::format("vertical = '{}{}'", folder, each.vertical)),
                      in_two_directions);
            if (folder.empty()) {
                EXPECT_EQ(files_of_motions(job), each.files) << each.first;
            }
            for (std::size_t i = 0; i < each.files.size(); ++i) {
                const auto peak_of = [&](const std::string& file) {
                    return plane("record = '" + file + "'").motions.at(0).measures.pga;
                };
                EXPECT_EQ(job.motions[i].measures.pga, peak_of(each.files[i][0]));
                EXPECT_EQ(job.motions[i].record->in_direction(90).peak(),
                          peak_of(each.files[i][1]));
            }
        }
    }
}

TEST_F(Pairs, OfListsAreInTheirOrder)
{
    for (const char* name : {"a1", "a2", "b1", "b2", "up"}) {
        write_record(std::string(name) + ".AT2", fmt::format("0 0.{} 1", 10 * name[0] + name[1]));
    }
    const Job job = plane("record = 'a?.AT2'\nsecond_component = ['b2.AT2', 'b1.AT2']\n"
                          "vertical = 'up.AT2'",
                          in_two_directions);
    EXPECT_EQ(files_of_motions(job),
              (std::vector<Names>{{"a1.AT2", "b2.AT2", "up.AT2"}, {"a2.AT2", "b1.AT2", "up.AT2"}}));
}

TEST_F(Pairs, AreRefusedWithTheNameOfAFileThatHasNone)
{
    for (const char* name : {"1_H1", "2_H1", "2_H2", "3_H2"}) {
        write_record(std::string(name) + ".AT2", fmt::format("0 0.{0} 0.{1}", name[0], name[3]));
    }
    const auto message = [&](const std::string& record, const std::string& second) {
        return refusal(exit_code::job, [&] {
            plane("record = " + record + "\nsecond_component = " + second, in_two_directions);
        });
    };
    EXPECT_THAT(
        message("'*_H1.AT2'", "'*_H2.AT2'"),
        HasSubstr("job.toml:3:20: scene.second_component = \"*_H2.AT2\" matches no file that "
                  "pairs with the record \"1_H1.AT2\": none has \"1\" in place of the "
                  "wildcards. Add the file, or exclude the record."));
    EXPECT_THAT(message("'[23]_H1.AT2'", "'[23]_H2.AT2'"),
                HasSubstr("matches \"3_H2.AT2\", which pairs with no record: scene.record has none "
                          "with \"3\" in place of the wildcards."));
    EXPECT_THAT(message("'*_H1.AT2'", "'*_H?.AT2'"),
                HasSubstr("has 2 wildcards, but scene.record, which names \"1_H1.AT2\", has 1."));
    EXPECT_THAT(message("['1_H1.AT2', '2_H1.AT2']", "'*_H2.AT2'"), HasSubstr("has 0."));
    EXPECT_THAT(message("'*_H1.AT2'", "'*_H3.AT2'"), HasSubstr("matches no file. It is relative"));
    EXPECT_THAT(
        message("'*_H1.AT2'", "'*_H1.AT2'"),
        HasSubstr("scene.second_component = 1_H1.AT2 has the accelerations of the horizontal"));
    EXPECT_EQ(message("'2_H*.AT2'", "['2_H2.AT2', '2_H1.AT2']"), "");
}

/// An AT2 file of this number of samples, of which every third one from the first on is large.
std::string at2(std::size_t samples, std::size_t first, const std::string& station = "A, 1")
{
    std::string text = fmt::format("PEER\n{}\nIN UNITS OF G\nNPTS= {}, DT= .1\n", station, samples);
    for (std::size_t i = 0; i < samples; ++i) {
        text += i % 3 == first ? "1\n" : "0.25\n";
    }
    return text;
}

TEST_F(Pairs, WhoseComponentsDifferByAFewSamplesEndWithZeros)
{
    write("a.AT2", at2(297, 0));
    write("b.AT2", at2(300, 1));
    write("c.AT2", at2(299, 2));
    const Job job = plane("record = 'a.AT2'\nsecond_component = 'b.AT2'\nvertical = 'c.AT2'",
                          in_two_directions);
    const RecordedMotion& motion = job.motions.at(0);
    EXPECT_THAT(
        motion.remarks,
        testing::ElementsAre(
            "a.AT2 has 297 samples, fewer than another component: 3 zeros are added at the end",
            "c.AT2 has 299 samples, fewer than another component: 1 zero is added at the end"));
    const auto padded = [&](const std::string& file, std::size_t zeros) {
        std::vector<double> values =
            plane("record = '" + file + "'").motions.at(0).record->horizontal();
        values.insert(values.end(), zeros, 0.0);
        return values;
    };
    EXPECT_EQ(motion.record->horizontal(), padded("a.AT2", 3));
    EXPECT_EQ(motion.record->second(), padded("b.AT2", 0));
    EXPECT_EQ(motion.record->upwards(), padded("c.AT2", 1));
    // 1 % of the longer component: 3 samples of 300, not of 299.
    write("b.AT2", at2(299, 1));
    write("c.AT2", at2(295, 2));
    EXPECT_THAT(refusal(exit_code::job, [&] { plane("record = 'b.AT2'\nvertical = 'c.AT2'"); }),
                HasSubstr("scene.vertical = c.AT2 has 295 samples at 0.1 s, but the horizontal "
                          "component has 299 at 0.1 s. The steps must be equal, and the numbers to "
                          "within 1 %, for which zeros are added at the end."));
}

TEST_F(Pairs, OfDifferentEventsHaveARemark)
{
    write("a.AT2", at2(5, 0, "Kobe, 1/16/1995, Takatori, 0"));
    write("b.AT2", at2(5, 1, "Kobe, 1/16/1995, Takatori, 90"));
    write("c.AT2", at2(5, 2, "Kobe, 1/16/1995, Nishi-Akashi, UP."));
    write("d.AT2", at2(5, 2, "no commas"));
    const auto remarks = [&](const std::string& second, const std::string& vertical) {
        return plane(fmt::format("record = 'a.AT2'\nsecond_component = '{}'\nvertical = '{}'",
                                 second, vertical),
                     in_two_directions)
            .motions.at(0)
            .remarks;
    };
    EXPECT_EQ(remarks("b.AT2", "d.AT2"), Names());
    EXPECT_THAT(
        remarks("b.AT2", "c.AT2"),
        testing::ElementsAre("a.AT2 is of \"Kobe, 1/16/1995, Takatori\", but c.AT2 of \"Kobe, "
                             "1/16/1995, Nishi-Akashi\": they may be different motions"));
}

TEST_F(Pairs, WithAVerticalComponentAsTheSecondOneHaveARemark)
{
    write("a.AT2", at2(5, 0, "Kobe, 1/16/1995, Takatori, 0"));
    for (const std::string name : {"UP", "Ud", "HNZ", "Z", "90", "HNE", "Zoo"}) {
        write("b.AT2", at2(5, 1, "Kobe, 1/16/1995, Takatori, " + name));
        const Names remarks =
            plane("record = 'a.AT2'\nsecond_component = 'b.AT2'", in_two_directions)
                .motions.at(0)
                .remarks;
        const bool is_vertical = name.starts_with('U') || name.ends_with('Z');
        EXPECT_EQ(remarks.size(), is_vertical ? 1 : 0) << name;
        EXPECT_EQ(plane("record = 'a.AT2'\nvertical = 'b.AT2'").motions.at(0).remarks, Names());
    }
}

TEST_F(Motions, AreRefusedIfOneIsListedTwiceUnderAnySpelling)
{
    write_components("a.V2A", {"N", "E"});
    for (const char* scene : {"record = ['a.V2A', 'a.V2A']", "record = ['a.V2A', './a.V2A']",
                              "record = ['a.V2A', 'a.*']\ncomponent = [2, 'E']"}) {
        EXPECT_THAT(refusal(exit_code::job, [&] { plane(scene); }),
                    HasSubstr("is listed more than once"))
            << scene;
    }
}

TEST_F(Motions, AreChosenInTablesByTheirNames)
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

TEST_F(Motions, OfFilesWhoseNamesAreNotUtf8AreRefused)
{
    write_record("b\xe9.AT2", "0 1 0");
    EXPECT_THAT(refusal(exit_code::job, [&] { plane("record = '*.AT2'"); }),
                HasSubstr("matches the file b\u00e9.AT2, whose name is not UTF-8. Rename it."));
}

TEST_F(Motions, InLatin1AreStoredInUtf8)
{
    write("b.AT2", "PEER\nM\xe9xico, \xd1\nIN UNITS OF G\nNPTS= 3, DT= .1\n0 1 0\n");
    const Job job = plane("record = 'b.AT2'");
    EXPECT_EQ(job.motions[0].component, "\u00d1");
    EXPECT_EQ(job.motions[0].header[1], "M\u00e9xico, \u00d1");
}

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

TEST_F(Motions, AreADimensionIfTheyAreAListOrAPattern)
{
    write_record("a.AT2", "0 1 0");
    EXPECT_EQ(dimensions_of(plane("record = 'a.AT2'")), Names());
    EXPECT_EQ(dimensions_of(plane("record = ['a.AT2']")), Names{"motion"});
    EXPECT_EQ(dimensions_of(plane("record = '*.AT2'")), Names{"motion"});
}

TEST_F(Motions, AreFoundInATableByNamesThatLookLikeNumbers)
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

TEST_F(Motions, AreNotVerticalAndHorizontalAtOnce)
{
    write_record("a.AT2", "0 0.1 0");
    EXPECT_THAT(refusal(exit_code::job, [&] { plane("record = \"a.AT2\"\nvertical = 1"); }),
                HasSubstr("has the accelerations of the horizontal component"));
    EXPECT_THAT(refusal(exit_code::job, [&] { plane("record = \"a.AT2\"\nvertical = \"a.AT2\""); }),
                HasSubstr("has the accelerations of the horizontal component"));
}

TEST_F(Motions, AreThoseOfTheGroundUnlessTheJobOrAFileSaysOtherwise)
{
    write_record("a.AT2", "0 1 0");
    write("floor.txt", "# motion_of = floor\n0 0\n1 1\n");
    write("ground.txt", "# motion_of = ground\n0 0\n1 1\n");
    const auto motion_of = [&](const std::string& scene) {
        return plane(scene).problem.scene.motion_of;
    };
    EXPECT_EQ(motion_of("record = 'a.AT2'"), MotionOf::ground);
    EXPECT_EQ(motion_of("record = 'ground.txt'\nunits = 'g'"), MotionOf::ground);
    EXPECT_EQ(motion_of("record = 'a.AT2'\nmotion_of = 'floor'"), MotionOf::floor);
    EXPECT_EQ(motion_of("record = 'floor.txt'\nunits = 'g'"), MotionOf::floor);
    EXPECT_EQ(motion_of("record = 'floor.txt'\nunits = 'g'\nmotion_of = 'floor'"), MotionOf::floor);
}

TEST_F(Motions, OfAFloorAreStatedInTheResolvedJob)
{
    write("floor.txt", "# motion_of = floor\n# ground_pga = 0.25\n0 0\n1 1\n");
    const Job floor = plane("record = 'floor.txt'\nunits = 'g'");
    EXPECT_THAT(floor.resolved, HasSubstr("\nmotion_of = \"floor\"\n"));
    EXPECT_THAT(floor.resolved, HasSubstr(", ground_pga = 0.25, "));
    write_record("a.AT2", "0 1 0");
    EXPECT_THAT(plane("record = 'a.AT2'").resolved, testing::Not(HasSubstr("motion_of")));
}

TEST_F(Motions, AreRefusedIfAFileContradictsTheJob)
{
    write("floor.txt", "# motion_of = floor\n0 0\n1 1\n");
    EXPECT_THAT(refusal(exit_code::job,
                        [&] { plane("record = 'floor.txt'\nunits = 'g'\nmotion_of = 'ground'"); }),
                HasSubstr("job.toml:4:13: scene.motion_of = \"ground\", but the file \"floor.txt\" "
                          "states motion_of = floor. Remove the key, or correct the file."));
}

TEST_F(Motions, OfAFloorAndOfTheGroundAreRefusedInOneJob)
{
    write("floor.txt", "# motion_of = floor\n0 0\n1 1\n");
    write("other.txt", "0 0\n1 2\n");
    EXPECT_THAT(
        refusal(exit_code::job, [&] { plane("record = ['floor.txt', 'other.txt']\nunits = 'g'"); }),
        HasSubstr("job.toml:2:10: scene.record: \"floor.txt\" is the motion of a floor, but "
                  "\"other.txt\" does not state that it is one."));
    EXPECT_EQ(plane("record = ['floor.txt', 'other.txt']\nunits = 'g'\nmotion_of = 'floor'")
                  .problem.scene.motion_of,
              MotionOf::floor);
}

TEST_F(Motions, OfAFileWhoseNameIsAPatternAreFound)
{
    write_record("a[1].AT2", "0 0.1 0");
    EXPECT_EQ(plane("record = \"a[1].AT2\"").motions.size(), 1);
}

} // namespace
} // namespace overturn
