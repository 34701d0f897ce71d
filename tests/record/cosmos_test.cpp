// Files of COSMOS.
#include "reading.hpp"

#include <fmt/format.h>

namespace overturn {
namespace {

/// A header of numbers: those given, and -999 elsewhere.
std::string values(const char* name, const std::string& format, std::size_t width,
                   std::size_t per_line, const std::vector<std::pair<int, std::string>>& given)
{
    std::string text = fmt::format(" 100 {} values follow on  {} lines, Format= {}\n", name,
                                   (100 + per_line - 1) / per_line, format);
    for (int i = 1; i <= 100; ++i) {
        std::string value = "-999";
        for (const auto& [number, other] : given) {
            value = number == i ? other : value;
        }
        text +=
            fmt::format("{:>{}}{}", value, width, i % int(per_line) == 0 || i == 100 ? "\n" : "");
    }
    return text;
}

struct Options {
    std::string stage = "Corrected";
    std::string kind = "acceleration";
    std::string direction = "  1: 340 deg";
    std::string units = "cm/sec2(04)";
    std::vector<std::pair<int, std::string>> integers{{1, "2"}, {2, "1"}, {3, "4"}, {4, "120"}};
    std::vector<std::pair<int, std::string>> reals{{34, "0.005"}, {62, "20.0"}, {63, "0.2"}};
    std::string format = "(8F10.5)";
    std::string data = "   -.00001    .00013   1.50000   2.00000   3.00000   4.00000   5.00000   "
                       "6.00000\n   7.00000-100.50000\n";
};

std::string channel(const Options& options = {})
{
    return fmt::format(
               "{} {}    (Format v01.20 with  5 text lines) Src: none\n"
               "Nowhere            June 16,2005 13:53 PDT\n"
               "Rcrd start time:06/16/2005, 20:53:04.400 UTC (Q=2) RcrdId: 1\n"
               "Sta Chan {} (Rcrdr Chan  1) Location: roof\n"
               "Values used when parameter or data value is unknown/unspecified:   -999, -999.0\n",
               options.stage, options.kind, options.direction) +
           values("Integer-header", "(10I8)", 8, 10, options.integers) +
           values("Real-header", "(6F13.6)", 13, 6, options.reals) +
           fmt::format("  2 Comment line(s) follow, each starting with a \"|\":\n"
                       "| first\n"
                       "|<SCNL>BMR.HNE.AK.--    <AUTH> 2019/02/01\n"
                       "   10  {} pts, approx    0 secs, units={},Format={}\n",
                       options.kind, options.units, options.format) +
           options.data + "End-of-data for Chan  1 acceleration\n";
}

const Values cosmos_samples{-.00001, .00013, 1.5, 2, 3, 4, 5, 6, 7, -100.5};

TEST(Cosmos, GivesTheSamplesInTheUnitThatItStates)
{
    const RecordFile file = parse_record(channel(), "a.txt");
    EXPECT_EQ(file.format, "COSMOS");
    ASSERT_EQ(file.components.size(), 1);
    EXPECT_EQ(file.components[0].unit, AccelerationUnit::cm_per_s2);
    EXPECT_EQ(file.components[0].acceleration, cosmos_samples);
    EXPECT_EQ(file.components[0].name, "340 deg");
    EXPECT_FALSE(file.components[0].is_uncorrected);
    Options in_g{.units = "g (02)"};
    in_g.integers[2].second = "2";
    EXPECT_EQ(component_of(channel(in_g)).unit, AccelerationUnit::g);
    in_g.integers[2].second = "-999";
    in_g.units = "g";
    EXPECT_EQ(component_of(channel(in_g)).unit, AccelerationUnit::g);
}

TEST(Cosmos, HasTheIntervalOfTheSamplesAndNotThatOfTheRecorder)
{
    EXPECT_EQ(component_of(channel()).time_step, 0.02);
    const Options unknown{.reals = {{34, "0.005"}, {63, "0.05"}}};
    EXPECT_EQ(component_of(channel(unknown)).time_step, 0.005);
}

TEST(Cosmos, HasAComponentForEachChannelOfAcceleration)
{
    Options velocity{.kind = "velocity", .units = "cm/sec(05)"};
    velocity.integers[1].second = "2";
    velocity.integers[2].second = "5";
    const Options up{.direction = "2: Up"};
    const RecordFile file =
        parse_record(channel() + channel(velocity) + channel(up) + channel(velocity), "a.txt");
    ASSERT_EQ(file.components.size(), 2);
    EXPECT_EQ(file.components[1].name, "Up");
}

TEST(Cosmos, NamesTheChannelByItsCodeIfTheDirectionIsUnknown)
{
    EXPECT_EQ(component_of(channel({.direction = "  ?:Other"})).name, "HNE");
    EXPECT_EQ(component_of(channel({.direction = ""})).name, "HNE");
}

TEST(Cosmos, KeepsItsHeader)
{
    const std::vector<std::string> header = component_of(channel()).header;
    ASSERT_EQ(header.size(), 5 + 11 + 18 + 3 + 1);
    EXPECT_EQ(header[1], "Nowhere            June 16,2005 13:53 PDT");
    EXPECT_EQ(header.back(),
              "   10  acceleration pts, approx    0 secs, units=cm/sec2(04),Format=(8F10.5)");
}

TEST(Cosmos, IsNotCorrectedIfTheFileSaysSo)
{
    Options raw{.stage = "Uncorrected"};
    EXPECT_TRUE(component_of("\n" + channel(raw)).is_uncorrected);
    raw.stage = "Some";
    raw.integers[0].second = "1";
    EXPECT_TRUE(component_of(channel(raw)).is_uncorrected);
}

const Options raw_options{
    .stage = "Raw",
    .units = "counts (50)",
    .integers = {{1, "0"}, {2, "1"}, {3, "50"}},
    .reals = {{22, "0.5"}, {34, "0.005"}, {42, "1.25"}, {47, "1.0"}, {62, "5.0"}},
    .format = "(10I8)",
    .data = "     103     104     105      97     100      99     101     100     "
            "109      82\n"};

TEST(Cosmos, GivesCountsWithoutTheirMeanInG)
{
    const RecordComponent component = component_of(channel(raw_options));
    EXPECT_EQ(component.unit, AccelerationUnit::g);
    EXPECT_EQ(component.time_step, 0.005);
    EXPECT_TRUE(component.is_uncorrected);
    const Values expected{3, 4, 5, -3, 0, -1, 1, 0, 9, -18}; // 0.5 uV per count, 1.25 V per g
    ASSERT_EQ(component.acceleration.size(), 10);
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_DOUBLE_EQ(component.acceleration[i], expected[i] * 0.4e-6);
    }
}

/// Counts, with more reals.
std::string counts_with(const std::vector<std::pair<int, std::string>>& reals)
{
    Options options = raw_options;
    options.reals.insert(options.reals.end(), reals.begin(), reals.end());
    return channel(options);
}

TEST(Cosmos, ComparesCountsWithAPeakWithOrWithoutTheirMean)
{
    for (const char* peak : {"109", "-109", "18", "-18.00"}) { // the mean is 100
        EXPECT_EQ(component_of(counts_with({{64, peak}})).remarks.size(), 0) << peak;
    }
    for (const char* peak : {"120", "98.1", "54.5", "218", "36", "1.835"}) {
        EXPECT_NE(refusal_of(counts_with({{64, peak}})), "") << peak;
    }
}

TEST(Cosmos, ComparesTheSensitivityOfTheSensorWithItsFullScale)
{
    for (const auto& [volts, g] : std::vector<std::pair<const char*, const char*>>{
             {"2.5", "2.0"}, {"1.25", "1"}, {"5.0", "4.0"}, {"2.5", "-999"}, {"-999", "2.0"}}) {
        EXPECT_EQ(refusal_of(counts_with({{43, volts}, {44, g}})), "") << volts << " V, " << g;
    }
    EXPECT_EQ(
        refusal_of(counts_with({{43, "2.5"}, {44, "2.2"}})),
        "a.txt:17: the sensitivity of the sensor, real 42 of the header, is 1.25 V/g, but its "
        "full scale, reals 43 and 44, is 2.5 V at 2.2 g. Give the file as it was published, or "
        "correct the wrong one.");
}

TEST(Cosmos, MayHaveAnyFormatOfTheValues)
{
    const std::vector<std::pair<const char*, const char*>> formats{
        {"(5F7.2)", "   1.50   2.00  -3.50   4.00   5.00\n   6.00   7.00   8.00   9.00  10.50\n"},
        {"(1E15.6)", "   1.500000e+00\n   2.000000e+00\n  -3.500000e+00\n   4.000000e+00\n   "
                     "5.000000e+00\n   6.000000e+00\n   7.000000e+00\n   8.000000e+00\n   "
                     "9.000000e+00\n   1.050000e+01\n"},
        {"(4F15.6E)", "   1.500000E+00   2.000000E+00  -3.500000E+00   4.000000E+00\n   "
                      "5.000000E+00   6.000000E+00   7.000000E+00   8.000000E+00\n   9.000000E+00  "
                      " 1.050000E+01\n"}};
    for (const auto& [format, data] : formats) {
        EXPECT_EQ(component_of(channel({.format = format, .data = data})).acceleration,
                  (Values{1.5, 2, -3.5, 4, 5, 6, 7, 8, 9, 10.5}))
            << format;
    }
}

TEST(Cosmos, MayHaveAnyNumberOfTextLinesAndComments)
{
    const std::string text = channel();
    EXPECT_EQ(component_of(with(text, "Nowhere", "\nmore\nNowhere")).acceleration, cosmos_samples);
    const std::string comments =
        text.substr(text.find("  2 Comment"), text.find("   10  acc") - text.find("  2 Comment"));
    EXPECT_EQ(component_of(with(text, comments, "   0 Comment line(s) follow\n")).acceleration,
              cosmos_samples);
    EXPECT_EQ(component_of(with(text, "| first\n", " | first\n| second\n")).acceleration,
              cosmos_samples);
}

TEST(Cosmos, MayHaveTheLineEndsOfAnySystemAndBlankLines)
{
    for (const char* end : {"\r\n", "\n\n", "  \r\n"}) {
        EXPECT_EQ(component_of(with_line_ends(channel(), end)).acceleration, cosmos_samples);
    }
}

TEST(Cosmos, MayEndWithPadding)
{
    for (const std::string& padding : paddings()) {
        const RecordFile file = parse_record(channel() + padding, "a.txt");
        EXPECT_EQ(file.components.back().acceleration,
                  parse_record(channel(), "a.txt").components.back().acceleration);
    }
}

TEST(Cosmos, MayLackTheLineThatEndsAChannel)
{
    const std::string text = with(channel(), "End-of-data for Chan  1 acceleration\n", "");
    EXPECT_EQ(component_of(text).acceleration, cosmos_samples);
    EXPECT_EQ(parse_record(text + text, "a.txt").components.size(), 2);
}

/// With another integer or real number of the header.
std::string with_value(Options options, bool is_real, int number, const std::string& value)
{
    (is_real ? options.reals : options.integers).emplace_back(number, value);
    return channel(options);
}

// clang-format off
TEST(Cosmos, IsRefusedWithFileLineAndReason)
{
    expect_refused({
        {"Velocities", with_value({.stage = "Corrected", .kind = "velocity", .units = "cm/sec(05)"}, false, 2, "2"),
            "a.txt:1: \"Corrected velocity    (Format v01.20 wit...\" does not announce "
            "accelerations. Give the file of the acceleration."},
        {"ContradictoryKinds", with_value({}, false, 2, "2"),
            "a.txt:38: \"10  acceleration pts, approx    0 secs, ...\" contradicts integer 2 of the header, 2: 1 is "
            "acceleration. Correct one of them."},
        {"ContradictoryUnits", with_value({}, false, 3, "2"),
            "a.txt:38: the unit \"cm/sec2\" contradicts integer 3 of the header, 2. Correct one of them."},
        {"NoUnit", with(channel(), "units=cm/sec2(04),", ""),
            "a.txt:38: the unit \"\" of the samples is not understood. Understood are g, m/s2, cm/s2, mm/s2, gal and their "
            "usual spellings, such as cm/sec2. Give the file of the acceleration, or the values as text with their "
            "unit."},
        {"AnotherUnit", channel({.units = "mg(11)"}),
            "a.txt:38: the unit \"mg\" of the samples is not understood. Understood are g, m/s2, cm/s2, mm/s2, gal and their "
            "usual spellings, such as cm/sec2. Give the file of the acceleration, or the values as text with their "
            "unit."},
        {"ContradictoryTimeSteps", with_value({}, true, 62, "5.0"),
            "a.txt:28: real 63, the length of the series, is 0.2 s, but 10 samples at 0.005 s are 0.05 s. Give the file "
            "as it was published, or correct the wrong one."},
        {"AContradictoryDuration", with(channel({.reals = {{34, "1.0"}}}), "approx    0 secs", "approx   50 secs"),
            "a.txt:38: the approximate duration is 50 s, but 10 samples at 1 s are 10 s. Give the file as it was "
            "published, or correct the wrong one."},
        {"AnUnknownTimeStep", channel({.reals = {}}),
            "a.txt:17: the time step, real 62 of the header in ms, is unknown or 0. Give a file that states it."},
        {"CountsOfUnknownSensitivity", with_value(raw_options, true, 42, "-999"),
            "a.txt:17: the samples are counts, but reals 22 (microvolts per count), 42 (volts per g) and 47 (gain, "
            "must be 1) of the header are 0.5, -999 and 1. Give the file of volume 1 or 2, in cm/sec2."},
        {"CountsWithAGain", with_value(raw_options, true, 47, "10.0"),
            "a.txt:17: the samples are counts, but reals 22 (microvolts per count), 42 (volts per g) and 47 (gain, "
            "must be 1) of the header are 0.5, 1.25 and 10. Give the file of volume 1 or 2, in cm/sec2."},
        {"FewerSamples", with(channel(), "7.00000-100.50000", "7.00000"),
            "a.txt:40: the line has 1 column of 10 characters, but must have 2: line 38 announces 10 values of the "
            "series, 8 per line. Give the file as it was published."},
        {"MoreSamples", with(channel(), "7.00000-100.50000\n", "7.00000-100.50000\n   9.00000\n"),
            "a.txt:41: \"9.00000\" follows the last of the samples that were announced. Correct their number, or give "
            "the file as it was published."},
        {"NoFormat", with(channel(), "(8F10.5)", ""),
            "a.txt:38: the line states no format of the values, such as Format=(8F10.5). Give the file as it was "
            "published."},
        {"AnotherFormat", with(channel(), "(8F10.5)", "(10F8.5)"),
            "a.txt:39: column 1 of 8 characters ends within a number: \"-.000\". Give the file as it was published."},
        {"NoCount", with(channel(), "   10  acc", "   ?   acc"),
            "a.txt:38: the number of values is \"?\", but must be an integer from 1 to 10000000. Correct it, or give "
            "another record."},
        {"AnEarlyEndInTheHeader", channel().substr(0, channel().find(" 100 Real")),
            "a.txt:16: no line such as 100 Real-header values follow after line 17. Give the complete file."},
        {"AnEarlyEndInTheComments", channel().substr(0, channel().find("   10  acc")),
            "a.txt:37: the file ends within the header. Give the complete file."},
        {"AnEarlyEnd", channel().substr(0, channel().find("   7.00000")),
            "a.txt:39: the file ends after 8 of the 10 values of the series that line 38 announces. Give the complete "
            "file."}});
}
// clang-format on

} // namespace
} // namespace overturn
