// The files of the components of motions, found by patterns and lists.
#include "job_with_files.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace overturn {
namespace {

using testing::HasSubstr;

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

} // namespace
} // namespace overturn
