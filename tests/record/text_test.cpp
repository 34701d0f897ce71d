// Files of one or two columns.
#include "reading.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <random>

namespace overturn {
namespace {

constexpr RecordOptions one_column{.time_step = 0.02, .unit = AccelerationUnit::g};

TEST(OneColumn, HasTheTimeStepAndTheUnitThatAreGiven)
{
    const RecordFile file = parse_record("0.1\n-0.2\n", "a.txt",
                                         {.time_step = 0.02, .unit = AccelerationUnit::m_per_s2});
    EXPECT_EQ(file.format, "text");
    ASSERT_EQ(file.components.size(), 1);
    EXPECT_EQ(file.components[0].name, "");
    EXPECT_EQ(file.components[0].acceleration, (Values{0.1, -0.2}));
    EXPECT_EQ(file.components[0].unit, AccelerationUnit::m_per_s2);
    EXPECT_EQ(file.components[0].time_step, 0.02);
}

TEST(OneColumn, MayHaveOneSample)
{
    EXPECT_EQ(component_of("0.1", one_column).acceleration, Values{0.1});
}

TEST(TwoColumns, HaveTheTimeStepOfTheirTimes)
{
    const RecordComponent component = component_of("0.00 0.1\n0.01 -0.2\n0.02 0.3\n", in_g);
    EXPECT_EQ(component.acceleration, (Values{0.1, -0.2, 0.3}));
    EXPECT_EQ(component.time_step, 0.01);
}

TEST(Text, KeepsItsCommentsAsHeader)
{
    const std::vector<std::string> header{"# station A", "  % unit g", "# the end"};
    EXPECT_EQ(component_of("# station A\n\n  % unit g\n1\n# the end\n2\n", one_column).header,
              header);
}

TEST(Text, StatesWhoseMotionItIsInAComment)
{
    for (const char* comment :
         {"# motion_of = floor", "%motion_of=floor", "  # motion_of = \"floor\""}) {
        const RecordComponent component =
            component_of(std::string(comment) + "\n1\n2\n", one_column);
        EXPECT_EQ(component.motion_of, MotionOf::floor) << comment;
    }
    EXPECT_EQ(component_of("1\n# motion_of = ground\n2\n", one_column).motion_of, MotionOf::ground);
}

TEST(Text, DoesNotStateWhoseMotionItIsInOtherWords)
{
    for (const char* comment : {"# floor 3", "# motion of = floor", "# the motion_of = floor",
                                "# =", "#", "# motion_of floor"}) {
        const RecordComponent component =
            component_of(std::string(comment) + "\n1\n2\n", one_column);
        EXPECT_FALSE(component.motion_of) << comment;
        EXPECT_FALSE(component.ground_pga) << comment;
    }
}

TEST(Text, StatesTheAccelerationOfTheGroundBelowAFloor)
{
    EXPECT_EQ(component_of("# ground_pga = 0.25\n1\n2\n", one_column).ground_pga, 0.25);
}

TEST(Text, IsRefusedIfAStatementOnItsMotionIsNotAllowed)
{
    EXPECT_EQ(
        refusal_of("# motion_of = roof\n1\n", one_column),
        "a.txt:1: motion_of = roof is not one of ground, floor. Correct the comment, or remove "
        "it.");
    EXPECT_EQ(refusal_of("# ground_pga = -1\n1\n", one_column),
              "a.txt:1: ground_pga = -1 is outside (0, inf). It is the peak acceleration of the "
              "ground over g. Correct the comment, or remove it.");
}

TEST(Text, IsNotAnAt2FileIfTheFourthLineIsAComment)
{
    EXPECT_EQ(component_of("#\n#\n#\n# NPTS= 2, DT= .02\n1\n2\n", one_column).acceleration,
              (Values{1, 2}));
}

TEST(Text, IsNotAnSmcFileIfItBeginsWithADigit)
{
    EXPECT_EQ(component_of("2 1\n3 1\n", in_g).time_step, 1);
}

TEST(Text, MayHaveTheLineEndsOfAnySystem)
{
    for (const char* end : {"\n", "\r\n", "\r\r\n"}) {
        const RecordComponent component =
            component_of(with_line_ends("# one\n0.0 1\n0.1 2\n", end), in_g);
        EXPECT_EQ(component.acceleration, (Values{1, 2}));
        EXPECT_EQ(component.header, std::vector<std::string>{"# one"});
    }
}

TEST(Text, MayEndWithPadding)
{
    for (const std::string& padding : paddings()) {
        EXPECT_EQ(component_of("0.0 1\n0.1 2\n" + padding, in_g).acceleration, (Values{1, 2}));
    }
}

TEST(Text, MayNotContainPadding)
{
    for (const std::string& padding : paddings()) {
        EXPECT_THAT(refusal_of("0.0 1\n" + padding + "0.1 2\n", in_g),
                    testing::HasSubstr("is not text"));
    }
}

TEST(Text, SeparatesColumnsByBlanksOrCommas)
{
    for (const char* separator : {" ", "\t", ",", ", ", " ,", "  \t "}) {
        const std::string text = std::string(" 0.0") + separator + "1 \n0.1" + separator + "-2\n";
        EXPECT_EQ(component_of(text, in_g).acceleration, (Values{1, -2})) << separator;
    }
}

TEST(Text, MayHaveFortranNumbers)
{
    EXPECT_EQ(component_of(".0D0 -.5D-01\n.1D-01 +.25d+1\n", in_g).acceleration,
              (Values{-0.05, 2.5}));
}

/// Two columns of n times that are printed in this format, from first + i step, and of zeros.
std::string printed(const char* format, double first, double step, int n)
{
    std::string text;
    for (int i = 0; i < n; ++i) {
        char word[64];
        std::snprintf(word, sizeof word, format, first + i * step);
        text += std::string(word) + " 0\n";
    }
    return text;
}

TEST(TimeStep, IsTheSimplestDecimalThatThePrintedTimesAllow)
{
    EXPECT_EQ(component_of(printed("%.2f", 0, 0.01, 4000), in_g).time_step, 0.01);
    EXPECT_EQ(component_of(printed("%.3f", 0, 0.005, 3), in_g).time_step, 0.005);
    EXPECT_EQ(component_of(printed("%.6e", 0, 0.02, 8192), in_g).time_step, 0.02);
    EXPECT_EQ(component_of(printed("%g", 0, 0.005, 300), in_g).time_step, 0.005);
    EXPECT_EQ(component_of(printed("%.17g", 0, 0.1, 1000), in_g).time_step, 0.1);
    EXPECT_EQ(component_of(printed("%.0f", 0, 2, 10), in_g).time_step, 2);
}

TEST(TimeStep, DoesNotDependOnTheFirstTime)
{
    EXPECT_EQ(component_of(printed("%.3f", -1.5, 0.005, 1000), in_g).time_step, 0.005);
    EXPECT_EQ(component_of(printed("%.2f", 45296.25, 0.01, 1000), in_g).time_step, 0.01);
}

TEST(TimeStep, MayHaveMoreDigitsThanTheTimes)
{
    // 128 samples per second, printed in thousandths: 0.000, 0.008, 0.016, 0.023, ...
    EXPECT_NEAR(component_of(printed("%.3f", 0, 0.0078125, 1000), in_g).time_step, 0.0078125,
                0.0005 / 999); // half a unit of the last time, shared by the steps
    EXPECT_EQ(component_of(printed("%.7f", 0, 0.0078125, 1000), in_g).time_step, 0.0078125);
}

TEST(TimeStep, OfThirdsIsAsAccurateAsTheirDigits)
{
    EXPECT_NEAR(component_of(printed("%.4f", 0, 1 / 300.0, 3000), in_g).time_step, 1 / 300.0,
                0.00005 / 2999);
}

TEST(TimeStep, AcceptsTimesThatAreHalfAUnitOff)
{
    // 0.125, 0.25, 0.375 and 0.5, rounded to even digits
    EXPECT_EQ(component_of("0.00 0\n0.12 0\n0.25 0\n0.38 0\n0.50 0\n", in_g).time_step, 0.125);
}

TEST(TimeStep, OfTimesWithFewDigitsIsAnyThatRoundsToThem)
{
    EXPECT_EQ(component_of(printed("%.2f", 0, 0.012, 9), in_g).time_step, 0.012);
}

TEST(TimeStep, OfRoundedTimesMayMakeStepsOfOneAndTwoUnits)
{
    for (const auto& [format, step, count] :
         std::vector<std::tuple<const char*, double, int>>{{"%.2f", 0.0125, 1000},
                                                           {"%.2f", 0.0104, 200},
                                                           {"%.2f", 0.0102, 200},
                                                           {"%.2f", 0.016, 50},
                                                           {"%.1f", 0.125, 50},
                                                           {"%.0f", 1.25, 50},
                                                           {"%.0f", 1.9, 50}}) {
        EXPECT_EQ(component_of(printed(format, 0, step, count), in_g).time_step, step) << step;
    }
}

TEST(TimeStep, MayBeRoundedToFewerDigitsAfterSomeTime)
{
    // One step of 0.02 s, after 1 s; those before are 0.011 s.
    EXPECT_EQ(component_of(printed("%.3g", 0, 1 / 90.0, 100), in_g).time_step, 0.011111);
}

TEST(TimeStep, IsNotStretchedOverAMissingSample)
{
    // Times with a step of one unit of their last digit, the first three and the last, agree with a
    // longer one if the gap is in their last two thirds.
    for (const auto& [format, step] :
         std::vector<std::pair<const char*, double>>{{"%.2f", 0.01},
                                                     {"%.1f", 0.1},
                                                     {"%.0f", 1},
                                                     {"%.3f", 0.001},
                                                     {"%.2f", 0.02},
                                                     {"%.3f", 0.005},
                                                     {"%.3f", 0.0078125},
                                                     {"%.5f", 0.0078125},
                                                     {"%.2e", 0.01}}) {
        for (const double first : {0.0, 2.0, -1.0}) {
            for (const int missing : {2, 9, 20, 30, 38}) {
                const std::string text =
                    printed(format, first, step, missing) +
                    printed(format, first + (missing + 1) * step, step, 40 - missing);
                EXPECT_THAT(
                    refusal_of(text, in_g),
                    testing::AllOf(testing::StartsWith(fmt::format("a.txt:{}: ", missing + 1)),
                                   testing::HasSubstr("missing")))
                    << format << " " << step << " " << first;
            }
        }
    }
}

TEST(TimeStep, IsNotStretchedOverAGapBehindTheFirstSample)
{
    EXPECT_EQ(refusal_of("0.00 1\n0.02 1\n0.03 1\n0.04 1\n0.05 1\n", in_g),
              "a.txt:2: the time is 0.02 s after the previous one, but all other steps are at most "
              "0.01 s: a sample is missing. Give the complete record; if none is missing, give "
              "times with more digits.");
    EXPECT_THAT(refusal_of("0.000 1\n0.007 1\n0.010 1\n0.013 1\n0.017 1\n", in_g),
                testing::StartsWith("a.txt:2: the time is 0.007 s after the previous one"));
}

TEST(TimeStep, IsPositiveEvenIfTheTimesHaveFewDigits)
{
    EXPECT_EQ(component_of("0.6 0\n1 0\n", in_g).time_step, 0.4);
}

constexpr RecordOptions nothing_given{};
constexpr RecordOptions only_a_time_step{.time_step = 0.01, .unit = {}};

TEST(TheUnit, IsThatOfACommentUnlessItIsGiven)
{
    EXPECT_EQ(component_of("# units = m/s2\n0 1\n1 2\n", nothing_given).unit,
              AccelerationUnit::m_per_s2);
    EXPECT_EQ(component_of("# by hand\n% units = gal\n1\n2\n", only_a_time_step).unit,
              AccelerationUnit::cm_per_s2);
    EXPECT_EQ(component_of("# units = g\n0 1\n1 2\n", in_g).unit, AccelerationUnit::g);
    for (const char* text : {"# units = feet\n0 1\n1 2\n", "0 1\n# units = g\n1 2\n"}) {
        EXPECT_NE(refusal_of(text, nothing_given).find("does not state the unit"),
                  std::string::npos);
    }
}

TEST(ACommaBetweenDigits, SeparatesColumnsOnlyIfTheFileHasADecimalPoint)
{
    EXPECT_EQ(component_of("0,0\n0.5,1\n", in_g).acceleration, (Values{0, 1}));
    EXPECT_EQ(component_of("# 0.5\n0, 0\n1, 2\n", in_g).acceleration, (Values{0, 2}));
    EXPECT_EQ(
        refusal_of("# 0.5\n0\n1,5\n", one_column),
        "a.txt:3: \"1,5\" may be a number with a decimal comma, because the file has no decimal "
        "point. Write numbers with a point, and separate columns by blanks.");
}

TEST(DecimalCommas, AreRefusedInAnyColumnsAndWithAnySeparator)
{
    std::mt19937_64 random(4);
    for (int i = 0; i < 300; ++i) {
        const std::string separator =
            std::vector<std::string>{";", "\t", " ", "; ", ", ", ","}[random() % 6];
        const bool has_times = random() % 2 == 0;
        std::string text;
        for (std::uint64_t row = 0, first = random() % 3, end = first + 2 + random() % 3; row < end;
             ++row) {
            const std::string fraction = fmt::format("{},{}", row, random() % 100);
            text += (has_times ? fmt::format("{}{}", row, separator) : "") +
                    (random() % 2 == 0 ? "-" : "") + fraction + "\n";
        }
        EXPECT_NE(refusal_of(text, has_times ? in_g : one_column), "") << text;
        EXPECT_NE(refusal_of(text, has_times ? one_column : in_g), "") << text;
    }
}

// clang-format off
TEST(Text, IsRefusedWithFileLineAndReason)
{
    for (const auto& [name, text, options, message] :
         std::vector<std::tuple<const char*, std::string, RecordOptions, const char*>>{
        {"AMissingUnit", "0.1\n", only_a_time_step,
            "a.txt: the file does not state the unit of the accelerations. Give one of g, m/s2, cm/s2, mm/s2, "
            "gal: scene.units in a job, --set scene.units=... on the command line, or units=... in Python."},
        {"AMissingUnitOfTwoColumns", "0 0.1\n", nothing_given,
            "a.txt: the file does not state the unit of the accelerations. Give one of g, m/s2, cm/s2, mm/s2, "
            "gal: scene.units in a job, --set scene.units=... on the command line, or units=... in Python."},
        {"AMissingTimeStep", "# a\n0.1\n", in_g,
            "a.txt:2: the file has one column, so the time step is not known. Give two columns with time in seconds first, "
            "or the time step in seconds: scene.time_step in a job, --set scene.time_step=... on the command line, or "
            "time_step=... in Python."},
        {"ATimeStepForTwoColumns", "0 0.1\n1 0.1\n", one_column,
            "a.txt:1: time_step = 0.02 was given, but the file has two columns, which state the times. Remove "
            "time_step."},
        {"ThreeColumns", "0 1 2\n", in_g,
            "a.txt:1: the line has 3 columns. Give one column of accelerations, or two of times and accelerations; "
            "the decimal mark is a point."},
        {"DecimalCommas", "0,01 0,2\n", in_g,
            "a.txt:1: \"0,01 0,2\" may be a number with a decimal comma, because the file has no decimal point. Write "
            "numbers with a point, and separate columns by blanks."},
        {"ASecondColumnFromSomeLineOn", "1\n2 3\n", one_column,
            "a.txt:2: the line has 2 columns, but the previous lines have 1. Correct it."},
        {"AMissingColumn", "0 1\n1\n", in_g,
            "a.txt:2: the line has 1 column, but the previous lines have 2. Correct it."},
        {"AnEmptyColumn", "0,1.5\n1,\n", in_g,
            "a.txt:2: \"\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
        {"AWord", "1\nend\n", one_column,
            "a.txt:2: \"end\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
        {"NumbersThatTouch", "1\n1-2\n", one_column,
            "a.txt:2: \"1-2\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
        {"TwoSigns", "1\n+-2\n", one_column,
            "a.txt:2: \"+-2\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
        {"ACommentBehindANumber", "1\n2 # peak\n", one_column,
            "a.txt:2: the line has 3 columns. Give one column of accelerations, or two of times and accelerations; "
            "the decimal mark is a point."},
        {"Nan", "nan\n1\n", one_column, "a.txt:1: \"nan\" is not finite. Give a record without gaps."},
        {"Infinity", "1\n1e999\n", one_column,
            "a.txt:2: \"1e999\" is outside the range of double precision. Correct it."},
        {"ATimeThatIsNan", "0 1\nnan 1\n", in_g, "a.txt:2: \"nan\" is not finite. Give a record without gaps."},
        {"OneTime", "0 1\n", in_g,
            "a.txt:1: the file has one sample, but the time step can be determined only from two or more. Give the complete "
            "file."},
        {"UnevenTimes", "0.000 0\n0.010 0\n0.020 0\n0.040 0\n", in_g,
            "a.txt:4: the time is 0.040 s, but must be 0.03 s to within half a unit of its last digit: times must be "
            "evenly spaced, and those before have the step 0.01 s. 1 sample is missing. Give the complete record."},
        {"UnevenSteps", "0.000 0\n0.010 0\n0.020 0\n0.034 0\n", in_g,
            "a.txt:4: the time is 0.034 s, but must be 0.03 s to within half a unit of its last digit: times must be "
            "evenly spaced, and those before have the step 0.01 s. Resample the record, or give one column and time_step."},
        {"TwoMissingTimes", "0.00 0\n0.02 0\n0.04 0\n0.10 0\n", in_g,
            "a.txt:4: the time is 0.10 s, but must be 0.06 s to within half a unit of its last digit: times must be "
            "evenly spaced, and those before have the step 0.02 s. 2 samples are missing. Give the complete record."},
        {"AMissingTime", printed("%.3f", 0, 0.005, 100) + printed("%.3f", 0.505, 0.005, 100), in_g,
            "a.txt:101: the time is 0.505 s, but must be 0.5 s to within half a unit of its last digit: times must be "
            "evenly spaced, and those before have the step 0.005 s. 1 sample is missing. Give the complete record."},
        {"RepeatedTimes", "0.0 0\n0.0 0\n", in_g,
            "a.txt:2: the time 0.0 s is not after the previous time, 0 s. Give ascending times with enough digits, "
            "or one column and time_step."},
        {"DescendingTimes", "0.1 0\n0.0 0\n", in_g,
            "a.txt:2: the time 0.0 s is not after the previous time, 0.1 s. Give ascending times with enough "
            "digits, or one column and time_step."},
        {"AbsurdTimes", "0.1 0\n1e300 0\n", in_g,
            "a.txt:2: the time 1e300 s is outside -1000000000 to 1000000000 s. The first of two columns must be the "
            "time in seconds."},
        {"ATimeStepOfZero", "1\n", (RecordOptions{.time_step = 0, .unit = AccelerationUnit::g}),
            "a.txt: time_step = 0 was given, but must be above 0 and finite. Give the seconds between two samples."},
        {"ANegativeTimeStep", "1\n", (RecordOptions{.time_step = -0.01, .unit = AccelerationUnit::g}),
            "a.txt: time_step = -0.01 was given, but must be above 0 and finite. Give the seconds between two "
            "samples."},
        {"AnInfiniteTimeStep", "1\n", (RecordOptions{.time_step = HUGE_VAL, .unit = AccelerationUnit::g}),
            "a.txt: time_step = inf was given, but must be above 0 and finite. Give the seconds between two samples."}}) {
        EXPECT_EQ(refusal_of(text, options), message) << name;
    }
}
// clang-format on

TEST(Text, RefusesMoreSamplesThanAreAllowed)
{
    std::string text;
    text.reserve(2 * most_samples + 2);
    for (std::size_t i = 0; i <= most_samples; ++i) {
        text += "1\n";
    }
    EXPECT_EQ(
        refusal_of(text, one_column),
        "a.txt:10000001: the file has more than 10000000 samples, the maximum. Give a shorter "
        "record.");
}

TEST(OneColumn, IsRefusedIfItsCommentStatesAnotherTimeStep)
{
    std::mt19937_64 generator(3);
    const auto read = [](const std::string& comment, double time_step) {
        return parse_record("# " + comment + "\n0.1\n0.2\n", "a.txt",
                            {.time_step = time_step, .unit = AccelerationUnit::g})
            .components[0]
            .time_step;
    };
    for (int i = 0; i < 100; ++i) {
        const double hertz = double(1 + generator() % 400);
        const double step = 1 / hertz;
        for (const std::string& comment : {fmt::format("synthetic, DT = {} s, NPTS = 2", step),
                                           fmt::format("dt={:.6g}s", step),
                                           fmt::format("Time step: {:.6g} sec", step),
                                           fmt::format("time step [s]: {}", step),
                                           fmt::format("sampling interval {} ms", 1000 * step),
                                           fmt::format("Sampling rate {} Hz", hertz),
                                           fmt::format("{} sps, sampled", hertz),
                                           fmt::format("NPTS= 2, DT= {:.6f} SEC", step),
                                           fmt::format("delta t = {} s", step),
                                           fmt::format("SAMPLING_INTERVAL_S: {:.6f}", step),
                                           fmt::format("{} sps", hertz),
                                           fmt::format("fs = {} Hz", hertz),
                                           fmt::format("{} samples/s", hertz),
                                           fmt::format("sample rate: {}", hertz),
                                           fmt::format("sampling frequency = {}", hertz),
                                           fmt::format("samples per second: {}", hertz),
                                           fmt::format("interval: {} s", step),
                                           fmt::format("Sampling Freq(Hz)  {}Hz", hertz),
                                           fmt::format("time increment {} s", step),
                                           fmt::format("{}sps", hertz)}) {
            EXPECT_EQ(read(comment, step), step) << comment;
            for (const double other : {step / 2, 2 * step, 1.01 * step}) {
                EXPECT_THROW(read(comment, other), Error) << comment;
            }
        }
        for (const std::string& comment :
             {fmt::format("filtered below {} Hz", hertz), fmt::format("station {}", hertz),
              fmt::format("time {} s", hertz), fmt::format("{} samples", hertz),
              fmt::format("number of samples: {}", hertz), fmt::format("interval {}", hertz),
              fmt::format("step {} of the processing", hertz)}) {
            EXPECT_EQ(read(comment, 0.01), 0.01) << comment;
        }
    }
}

TEST(OneColumn, IsRefusedIfItBeginsWithTheNumberOfItsSamples)
{
    std::mt19937_64 generator(4);
    for (int i = 0; i < 50; ++i) {
        const int count = int(2 + generator() % 100);
        std::string samples;
        for (int k = 0; k < count; ++k) {
            samples += fmt::format("{:.3f}\n", 0.001 * double(1 + generator() % 900));
        }
        for (const std::string& header :
             {fmt::format("{}\n", count), fmt::format("{}\n0.01\n", count),
              fmt::format("# a station\n{}\n", count)}) {
            EXPECT_THAT(
                refusal_of(header + samples, one_column),
                ::testing::HasSubstr(fmt::format(
                    "the first value, {}, is the number of the values that follow", count)));
        }
        for (const std::string& header :
             {fmt::format("{}\n", count + 1), fmt::format("# {}\n", count),
              fmt::format("{}.5\n", count)}) {
            EXPECT_THAT(component_of(header + samples, one_column).acceleration,
                        ::testing::SizeIs(count + (header.starts_with('#') ? 0 : 1)));
        }
    }
}

TEST(Text, OfMoreColumnsIsRefusedBeforeItsUnitIsAskedFor)
{
    EXPECT_EQ(refusal_of("# three components\n0.0 1 2 3\n"),
              "a.txt:2: the line has 4 columns. Give one column of accelerations, or two of times "
              "and accelerations; the decimal mark is a point.");
}

TEST(TwoColumns, StateTheTimeOfTheFirstSample)
{
    EXPECT_EQ(component_of("3.00 1\n3.01 2\n", in_g).start, 3);
    EXPECT_EQ(component_of("1\n2\n", one_column).start, 0);
}

TEST(Text, IsRefusedIfItsCommentsSpeakOfOtherMotions)
{
    for (const char* comment : {"# Velocity time series", "# displacement record", "% VELOCITIES",
                                "# velocity 230", "# ground velocity"}) {
        EXPECT_THAT(refusal_of(fmt::format("{}\n0 1\n1 2\n", comment), in_g),
                    ::testing::HasSubstr("does not contain accelerations"));
    }
    for (const char* comments :
         {"# acceleration, before velocity was corrected", "# Peak velocity: 0.3 m/s\n# ACC",
          "# station", "# Peak velocity: 0.3 m/s", "# Peak displacement (cm): 1.4",
          "# Shear-wave velocity (m/s): 360", "# S-wave velocity 360 m/s",
          "# Fault displacement 1.2 m", "# velocity (m/s): 360", "# initial velocity"}) {
        EXPECT_EQ(component_of(fmt::format("{}\n0 1\n1 2\n", comments), in_g).acceleration,
                  (Values{1, 2}));
    }
}

TEST(Text, RefusesCommentsThatFillTheMemory)
{
    std::string text;
    for (int i = 0; i < 600'000; ++i) {
        text += "#\n";
    }
    EXPECT_EQ(refusal_of(text + "1\n", one_column),
              "a.txt:524289: header and comments are larger than 1024 KiB, the maximum. Remove "
              "comments.");
}

} // namespace
} // namespace overturn
