// Files of PEER, with the headers that are in use.
#include "reading.hpp"

namespace overturn {
namespace {

/// A file with this fourth line and these data.
std::string at2(const std::string& sampling,
                const std::string& data = "  .1000000E-02  -.25E-01\n 0.5\n")
{
    return "PEER NGA STRONG MOTION DATABASE RECORD\n"
           "Somewhere-01, 1/17/1994, A Station, 230\n"
           "ACCELERATION TIME SERIES IN UNITS OF G\n" +
           sampling + "\n" + data;
}

const std::string sound_at2 = at2("NPTS=      3, DT=   .0100 SEC");
const Values at2_samples{0.001, -0.025, 0.5};

TEST(At2, GivesItsSamplesInG)
{
    const RecordFile file = parse_record(sound_at2, "a.txt");
    EXPECT_EQ(file.format, "AT2");
    ASSERT_EQ(file.components.size(), 1);
    EXPECT_EQ(file.components[0].acceleration, at2_samples);
    EXPECT_EQ(file.components[0].unit, AccelerationUnit::g);
    EXPECT_EQ(file.components[0].time_step, 0.01);
}

TEST(At2, KeepsTheFourLinesOfItsHeader)
{
    const std::vector<std::string> header{
        "PEER NGA STRONG MOTION DATABASE RECORD", "Somewhere-01, 1/17/1994, A Station, 230",
        "ACCELERATION TIME SERIES IN UNITS OF G", "NPTS=      3, DT=   .0100 SEC"};
    EXPECT_EQ(component_of(sound_at2).header, header);
}

TEST(At2, NamesTheComponentAtTheEndOfItsSecondLine)
{
    EXPECT_EQ(component_of(sound_at2).name, "230");
    EXPECT_EQ(component_of(sound_at2).event, "Somewhere-01, 1/17/1994, A Station");
}

TEST(At2, WithoutCommaInItsSecondLineHasAComponentWithoutName)
{
    const auto component =
        component_of(with(sound_at2, "Somewhere-01, 1/17/1994, A Station, 230", "a station"));
    EXPECT_EQ(component.name, "");
    EXPECT_EQ(component.event, "");
}

// clang-format off
TEST(At2, StatesTheNumberOfPointsAndTheTimeStepInItsFourthLine)
{
    for (const auto& [name, line, time_step] : std::vector<std::tuple<const char*, const char*, double>>{
        {"New", "NPTS=      3, DT=   .0100 SEC", 0.01},
        {"WithTrailingComma", "NPTS=   3, DT=   .0050 SEC,", 0.005},
        {"LowerCase", "npts= 3, dt= .02 sec", 0.02},
        {"WithoutSec", "NPTS=  3, DT= .01000", 0.01},
        {"WithSecTouching", "NPTS=3,DT=.01SEC", 0.01},
        {"WithoutComma", "NPTS = 3 DT = 0.0078125 SEC", 0.0078125},
        {"WithDuration", "NPTS= 3, DT= .005 SEC, DURATION= .01 SEC", 0.005},
        {"FortranExponent", "NPTS= 3, DT= .5D-02 SEC", 0.005},
        {"WithLeadingBlanks", "   NPTS=  3, DT= .01000 SEC   ", 0.01},
        {"Old", "3 0.0050 NPTS, DT", 0.005},
        {"OldWithBlanks", "     3    .0100    NPTS, DT  ", 0.01},
        {"OldLowerCase", "3, 0.0050 npts, dt", 0.005}}) {
        const RecordComponent component = component_of(at2(line));
        EXPECT_EQ(component.time_step, time_step) << name;
        EXPECT_EQ(component.acceleration, at2_samples) << name;
    }
}
// clang-format on

TEST(At2, MayHaveTheLineEndsOfAnySystem)
{
    for (const char* end : {"\n", "\r\n", "\r\r\n"}) {
        const RecordComponent component = component_of(with_line_ends(sound_at2, end));
        EXPECT_EQ(component.acceleration, at2_samples);
        EXPECT_EQ(component.header, component_of(sound_at2).header);
    }
}

TEST(At2, MayEndWithoutLineEndOrWithTheEndOfDosFiles)
{
    EXPECT_EQ(component_of(sound_at2.substr(0, sound_at2.size() - 1)).acceleration, at2_samples);
    EXPECT_EQ(component_of(sound_at2 + "\x1a").acceleration, at2_samples);
    EXPECT_EQ(component_of(sound_at2 + "\n \t \n").acceleration, at2_samples);
}

TEST(At2, MayEndWithPadding)
{
    for (const std::string& padding : paddings()) {
        const RecordFile file = parse_record(sound_at2 + padding, "a.txt");
        EXPECT_EQ(file.components.back().acceleration,
                  parse_record(sound_at2, "a.txt").components.back().acceleration);
    }
}

TEST(At2, MayBeginWithTheByteOrderMarkOfUtf8)
{
    EXPECT_EQ(component_of("\xef\xbb\xbf" + sound_at2).header, component_of(sound_at2).header);
}

TEST(At2, KeepsHeadersInAnyEncodingButNamesItsComponentInUtf8)
{
    const RecordComponent component =
        component_of(with(sound_at2, "A Station, 230", "M\xe9xico, \xd1"));
    EXPECT_EQ(component.header[1], "Somewhere-01, 1/17/1994, M\xe9xico, \xd1");
    EXPECT_EQ(component.name, "\u00d1");
}

// clang-format off
TEST(At2, HasItsSamplesAsWritten)
{
    for (const auto& [name, text, values] : std::vector<std::tuple<const char*, const char*, Values>>{
        {"TouchingAtTheirSigns", ".1234567E-02-.3456789E-02+.5E+00", {0.001234567, -0.003456789, 0.5}},
        {"TouchingWithoutExponents", "-1.5-.25+2", {-1.5, -0.25, 2}},
        {"FortranExponents", " .5D-01 -.25d+00 1.D0", {0.05, -0.25, 1}},
        {"FortranExponentsTouching", ".5D-01-.25d+00-1.D0", {0.05, -0.25, -1}},
        {"SignsAndIntegers", "+1 -0 3.", {1, -0.0, 3}},
        {"OneALine", "1\n\n2\n3", {1, 2, 3}},
        {"Tabs", "\t1\t2 \t3\t", {1, 2, 3}},
        {"ManyDigits", "0.1000000000000000055511151231257827 0.30000000000000004 123456789012345678901",
            {0.1, 0.1 + 0.2, 123456789012345683968.0}}}) {
        EXPECT_EQ(component_of(at2("NPTS= 3, DT= .01 SEC", text)).acceleration, values) << name;
    }
}

TEST(At2, IsRefusedWithFileLineAndReason)
{
    expect_refused({
        {"FewerSamples", at2("NPTS= 4, DT= .01 SEC"),
            "a.txt:6: the file ends after 3 samples, but NPTS announces 4 in line 4. Give the complete file."},
        {"MoreSamples", at2("NPTS= 2, DT= .01 SEC"),
            "a.txt:6: \"0.5\" follows the last of the 2 samples that NPTS announces in line 4. Correct NPTS or "
            "remove the rest."},
        {"NoSamples", at2("NPTS= 3, DT= .01 SEC", ""),
            "a.txt:4: the file ends after 0 samples, but NPTS announces 3 in line 4. Give the complete file."},
        {"NoPoints", at2("NPTS= 0, DT= .01 SEC"),
            "a.txt:4: NPTS is \"0\", but must be an integer from 1 to 10000000. Correct it, or give another "
            "record."},
        {"NegativePoints", at2("NPTS= -3, DT= .01 SEC"),
            "a.txt:4: NPTS is \"-3\", but must be an integer from 1 to 10000000. Correct it, or give another "
            "record."},
        {"TwoTimeSteps", at2("NPTS= 3, DT= .01 SEC, DT= .02 SEC"),
            "a.txt:4: \"NPTS= 3, DT= .01 SEC, DT= .02 SEC\" is not understood. Write only the number of points and "
            "the time step in seconds, as in NPTS= 4000, DT= .01 SEC."},
        {"TwoTimeStepsInTheOldForm", at2("3 0.01 NPTS, DT 0.02"),
            "a.txt:4: \"3 0.01 NPTS, DT 0.02\" is not understood. Write only the number of points and the time step "
            "in seconds, as in NPTS= 4000, DT= .01 SEC."},
        {"AnotherUnitInTheOldForm", at2("3 5.0 NPTS, DT MSEC"),
            "a.txt:4: \"3 5.0 NPTS, DT MSEC\" is not understood. Write only the number of points and the time step "
            "in seconds, as in NPTS= 4000, DT= .01 SEC."},
        {"AFactorInTheOldForm", at2("3 5.0 NPTS, DT*10"),
            "a.txt:4: \"3 5.0 NPTS, DT*10\" is not understood. Write only the number of points and the time step in "
            "seconds, as in NPTS= 4000, DT= .01 SEC."},
        {"AFactor", at2("NPTS= 3, DT= .01 SEC, SCALE FACTOR 2"),
            "a.txt:4: \"NPTS= 3, DT= .01 SEC, SCALE FACTOR 2\" is not understood. Write only the number of points "
            "and the time step in seconds, as in NPTS= 4000, DT= .01 SEC."},
        {"AnotherUnitInFront", at2("MS: NPTS= 3, DT= 5"),
            "a.txt:4: \"MS: NPTS= 3, DT= 5\" is not understood. Write only the number of points and the time step in "
            "seconds, as in NPTS= 4000, DT= .01 SEC."},
        {"AFractionOfPoints", at2("NPTS= 3.5, DT= .01 SEC"),
            "a.txt:4: NPTS is \"3.5\", but must be an integer from 1 to 10000000. Correct it, or give another "
            "record."},
        {"TooManyPoints", at2("NPTS= 10000001, DT= .01 SEC"),
            "a.txt:4: NPTS is \"10000001\", but must be an integer from 1 to 10000000. Correct it, or give "
            "another record."},
        {"PointsBeyondIntegers", at2("NPTS= 99999999999999999999999, DT= .01 SEC"),
            "a.txt:4: NPTS is \"99999999999999999999999\", but must be an integer from 1 to 10000000. Correct it, "
            "or give another record."},
        {"NoTimeStep", at2("NPTS= 3"),
            "a.txt:4: \"NPTS= 3\" is not understood. Write only the number of points and the time step in seconds, "
            "as in NPTS= 4000, DT= .01 SEC."},
        {"AnEmptyTimeStep", at2("NPTS= 3, DT="),
            "a.txt:4: \"NPTS= 3, DT=\" is not understood. Write only the number of points and the time step in "
            "seconds, as in NPTS= 4000, DT= .01 SEC."},
        {"ATimeStepOfZero", at2("NPTS= 3, DT= 0.00 SEC"),
            "a.txt:4: the time step is 0 s, but must be above 0. Correct it."},
        {"ANegativeTimeStep", at2("NPTS= 3, DT= -.01 SEC"),
            "a.txt:4: the time step is -0.01 s, but must be above 0. Correct it."},
        {"ATimeStepOfNan", at2("NPTS= 3, DT= NaN"),
            "a.txt:4: \"NaN\" is not finite. Give a record without gaps."},
        {"AWordAsTimeStep", at2("NPTS= 3, DT= unknown"),
            "a.txt:4: \"unknown\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
        {"Velocities", with(sound_at2, "ACCELERATION TIME SERIES IN UNITS OF G", "VELOCITY TIME SERIES IN UNITS OF CM/S"),
            "a.txt:3: \"VELOCITY TIME SERIES IN UNITS OF CM/S\" does not announce accelerations. Give the file "
            "of the acceleration."},
        {"NotANumber", with(sound_at2, "0.5", "0.5 rest"),
            "a.txt:6: \"rest\" follows the last of the 3 samples that NPTS announces in line 4. Correct NPTS or "
            "remove the rest."},
        {"AWordAmongTheSamples", with(sound_at2, "-.25E-01", "missing"),
            "a.txt:5: \"missing\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
        {"OverflowOfAFortranField", with(sound_at2, "-.25E-01", "********"),
            "a.txt:5: \"********\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
        {"ADecimalComma", with(sound_at2, "0.5", "0,5"),
            "a.txt:6: \"0,5\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
        {"ADecimalCommaInTheTimeStep", at2("NPTS= 3, DT= 1,5 SEC"),
            "a.txt:4: \"NPTS= 3, DT= 1,5 SEC\" is not understood. Write only the number of points and the time step "
            "in seconds, as in NPTS= 4000, DT= .01 SEC."},
        {"TwoSigns", with(sound_at2, "0.5", "+-0.5"),
            "a.txt:6: \"+\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
        {"Hexadecimals", with(sound_at2, "0.5", "0x1p3"),
            "a.txt:6: \"0x1p3\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
        {"AnExponentWithoutDigits", with(sound_at2, "0.5", "5E"),
            "a.txt:6: \"5E\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
        {"Nan", with(sound_at2, "0.5", "NaN"), "a.txt:6: \"NaN\" is not finite. Give a record without gaps."},
        {"Infinity", with(sound_at2, "0.5", "-Infinity"),
            "a.txt:6: \"-Infinity\" is not finite. Give a record without gaps."},
        {"Overflow", with(sound_at2, "0.5", "1E+999"),
            "a.txt:6: \"1E+999\" is outside the range of double precision. Correct it."},
        {"ALongWord", with(sound_at2, "0.5", std::string(100, 'x')),
            "a.txt:6: \"xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...\" is not a number. Write numbers as in 0.5, "
            "-.5E-01 or -.5D-01."},
        {"AWordInAnotherEncoding", with(sound_at2, "0.5", "\"\xe9\\"),
            "a.txt:6: \"\\\"\\xe9\\\\\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."}});
}
// clang-format on

TEST(At2, RefusesAUnitBecauseItStatesItsOwn)
{
    EXPECT_EQ(refusal_of(sound_at2, {.time_step = {}, .unit = AccelerationUnit::cm_per_s2}),
              "a.txt: units = cm/s2 was given, but this AT2 file is in g. Remove units.");
}

TEST(At2, RefusesATimeStepBecauseItStatesItsOwn)
{
    EXPECT_EQ(refusal_of(sound_at2, {.time_step = 0.02, .unit = {}}),
              "a.txt: time_step = 0.02 was given, but the AT2 file states its own, 0.01 s. Remove "
              "time_step.");
}

TEST(At2, RefusesAHeaderThatFillsTheMemory)
{
    EXPECT_EQ(
        refusal_of(with(sound_at2, "PEER", std::string(2 << 20, 'x'))),
        "a.txt:1: header and comments are larger than 1024 KiB, the maximum. Remove comments.");
}

TEST(At2, OfOneLineWithManyNumbersIsReadInLinearTime)
{
    // Half a second if the time is linear; hours if a word were searched from the line's beginning.
    std::string data;
    for (int i = 0; i < 1'000'000; ++i) {
        data += "-.1E-2";
    }
    EXPECT_EQ(component_of(at2("NPTS= 1000000, DT= .01", data)).acceleration.size(), 1'000'000);
}

} // namespace
} // namespace overturn
