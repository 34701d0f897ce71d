// The motions of a job: their files, names and remarks.
#include "job_with_files.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace overturn {
namespace {

using testing::HasSubstr;

using Motions = JobWithFiles;

TEST_F(Motions, AreNamedByTheirFilesAndThoseOfOneFileAlsoByTheirComponents)
{
    write_components("a.V2A", {"N28W", "S62W", "S62W"});
    write_record("b.AT2", "0 1 0");
    const Job one = plane("record = ['a.V2A', 'b.AT2']");
    EXPECT_EQ(names_of_motions(one), (std::vector<std::string>{"a.V2A", "b.AT2"}));
    EXPECT_THAT(one.resolved, testing::Not(HasSubstr("name =")));
    const std::vector<std::string> names{"a.V2A:N28W", "a.V2A:2", "b.AT2", "a.V2A:3"};
    const Job suite =
        plane("record = ['a.V2A', 'a.V2A', 'b.AT2', 'a.V2A']\ncomponent = [1, 2, 1, 3]");
    EXPECT_EQ(names_of_motions(suite), names);
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
    EXPECT_EQ(names_of_motions(plane("record = ['a.V2A', 'a.V2A']\nvertical = ['E', 'Up']")),
              (std::vector<std::string>{"a.V2A:N:E", "a.V2A:N:Up"}));
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

TEST_F(Motions, AreADimensionIfTheyAreAListOrAPattern)
{
    write_record("a.AT2", "0 1 0");
    EXPECT_EQ(dimensions_of(plane("record = 'a.AT2'")), Names());
    EXPECT_EQ(dimensions_of(plane("record = ['a.AT2']")), Names{"motion"});
    EXPECT_EQ(dimensions_of(plane("record = '*.AT2'")), Names{"motion"});
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
        EXPECT_EQ(names_of_motions(plane("record = '" + name + "/*.AT2'")), both);
        EXPECT_EQ(names_of_motions(plane("record = '" + name + "/[ab].AT2'")), both);
        EXPECT_EQ(names_of_motions(plane("record = '" + name + "/a.AT2'")), Names{both[0]});
        EXPECT_EQ(names_of_motions(plane("record = '" + name + "/a.A*'")), Names{both[0]});
        const std::string absolute = folder_ / name;
        EXPECT_EQ(names_of_motions(plane("record = '" + absolute + "/*.AT2'")),
                  (Names{absolute + "/a.AT2", absolute + "/b.AT2"}));
        EXPECT_EQ(names_of_motions(
                      plane("record = '" + name + "/a.AT2'\nvertical = '" + name + "/b.AT2'")),
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
        EXPECT_EQ(names_of_motions(job), Names{"a.AT2"}) << name;
    }
}

TEST_F(Patterns, MatchOtherFoldersIfTheOneOfTheirNameHasNoSuchFile)
{
    for (const char* name : {"d [1]", "d 1"}) {
        std::filesystem::create_directories(folder_ / name);
    }
    write_record("d 1/a.AT2", "0 1 0");
    EXPECT_EQ(names_of_motions(plane("record = 'd [1]/*.AT2'")), Names{"d 1/a.AT2"});
    write_record("d [1]/b.AT2", "0 1 0");
    EXPECT_EQ(names_of_motions(plane("record = 'd [1]/*.AT2'")), Names{"d [1]/b.AT2"});
}

TEST_F(Patterns, WithoutFilesAreRefusedWithTheWayToWriteACharacterItself)
{
    std::filesystem::create_directories(folder_ / "e/d [1]");
    write_record("e/d [1]/a.AT2", "0 1 0");
    EXPECT_THAT(refusal(exit_code::job, [&] { plane("record = '*/d [1]/*.AT2'"); }),
                HasSubstr("scene.record = \"*/d [1]/*.AT2\" matches no file. It is relative to the "
                          "job file, and a pattern: write [*], [?] and [[] for *, ? and [ "
                          "themselves."));
    EXPECT_EQ(names_of_motions(plane("record = '*/d [[]1]/*.AT2'")), Names{"e/d [1]/a.AT2"});
}

} // namespace
} // namespace overturn
