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

const std::string sound = at2("NPTS=      3, DT=   .0100 SEC");
const Values samples{0.001, -0.025, 0.5};

TEST(At2, GivesItsSamplesInG)
{
    const RecordFile file = parse_record(sound, "a.txt");
    EXPECT_EQ(file.format, "AT2");
    ASSERT_EQ(file.components.size(), 1);
    EXPECT_EQ(file.components[0].acceleration, samples);
    EXPECT_EQ(file.components[0].unit, AccelerationUnit::g);
    EXPECT_EQ(file.components[0].time_step, 0.01);
}

TEST(At2, KeepsTheFourLinesOfItsHeader)
{
    const std::vector<std::string> header{
        "PEER NGA STRONG MOTION DATABASE RECORD", "Somewhere-01, 1/17/1994, A Station, 230",
        "ACCELERATION TIME SERIES IN UNITS OF G", "NPTS=      3, DT=   .0100 SEC"};
    EXPECT_EQ(component_of(sound).header, header);
}

TEST(At2, NamesTheComponentAtTheEndOfItsSecondLine)
{
    EXPECT_EQ(component_of(sound).name, "230");
}

TEST(At2, WithoutCommaInItsSecondLineHasAComponentWithoutName)
{
    EXPECT_EQ(
        component_of(with(sound, "Somewhere-01, 1/17/1994, A Station, 230", "a station")).name, "");
}

struct Header {
    const char* name;
    const char* line;
    double time_step; // [s]
};

class At2Header : public testing::TestWithParam<Header> {};

TEST_P(At2Header, StatesTheNumberOfPointsAndTheTimeStep)
{
    const RecordComponent component = component_of(at2(GetParam().line));
    EXPECT_EQ(component.time_step, GetParam().time_step);
    EXPECT_EQ(component.acceleration, samples);
}

// clang-format off
INSTANTIATE_TEST_SUITE_P(Variants, At2Header, testing::Values(
    Header{"New", "NPTS=      3, DT=   .0100 SEC", 0.01},
    Header{"WithTrailingComma", "NPTS=   3, DT=   .0050 SEC,", 0.005},
    Header{"LowerCase", "npts= 3, dt= .02 sec", 0.02},
    Header{"WithoutSec", "NPTS=  3, DT= .01000", 0.01},
    Header{"WithSecTouching", "NPTS=3,DT=.01SEC", 0.01},
    Header{"WithoutComma", "NPTS = 3 DT = 0.0078125 SEC", 0.0078125},
    Header{"WithDuration", "NPTS= 3, DT= .005 SEC, DURATION= .01 SEC", 0.005},
    Header{"FortranExponent", "NPTS= 3, DT= .5D-02 SEC", 0.005},
    Header{"WithLeadingBlanks", "   NPTS=  3, DT= .01000 SEC   ", 0.01},
    Header{"Old", "3 0.0050 NPTS, DT", 0.005},
    Header{"OldWithBlanks", "     3    .0100    NPTS, DT  ", 0.01},
    Header{"OldLowerCase", "3, 0.0050 npts, dt", 0.005}),
    [](const testing::TestParamInfo<Header>& header) { return header.param.name; });
// clang-format on

TEST(At2, MayHaveTheLineEndsOfAnySystem)
{
    for (const char* end : {"\n", "\r\n", "\r\r\n"}) {
        const RecordComponent component = component_of(with_line_ends(sound, end));
        EXPECT_EQ(component.acceleration, samples);
        EXPECT_EQ(component.header, component_of(sound).header);
    }
}

TEST(At2, MayEndWithoutLineEndOrWithTheEndOfDosFiles)
{
    EXPECT_EQ(component_of(sound.substr(0, sound.size() - 1)).acceleration, samples);
    EXPECT_EQ(component_of(sound + "\x1a").acceleration, samples);
    EXPECT_EQ(component_of(sound + "\n \t \n").acceleration, samples);
}

TEST(At2, MayBeginWithTheByteOrderMarkOfUtf8)
{
    EXPECT_EQ(component_of("\xef\xbb\xbf" + sound).header, component_of(sound).header);
}

TEST(At2, KeepsHeadersInAnyEncodingButNamesItsComponentInUtf8)
{
    const RecordComponent component =
        component_of(with(sound, "A Station, 230", "M\xe9xico, \xd1"));
    EXPECT_EQ(component.header[1], "Somewhere-01, 1/17/1994, M\xe9xico, \xd1");
    EXPECT_EQ(component.name, "\u00d1");
}

struct Data {
    const char* name;
    const char* text;
    Values values;
};

class At2Data : public testing::TestWithParam<Data> {};

TEST_P(At2Data, AreReadAsWritten)
{
    EXPECT_EQ(component_of(at2("NPTS= 3, DT= .01 SEC", GetParam().text)).acceleration,
              GetParam().values);
}

// clang-format off
INSTANTIATE_TEST_SUITE_P(Variants, At2Data, testing::Values(
    Data{"TouchingAtTheirSigns", ".1234567E-02-.3456789E-02+.5E+00", {0.001234567, -0.003456789, 0.5}},
    Data{"TouchingWithoutExponents", "-1.5-.25+2", {-1.5, -0.25, 2}},
    Data{"FortranExponents", " .5D-01 -.25d+00 1.D0", {0.05, -0.25, 1}},
    Data{"FortranExponentsTouching", ".5D-01-.25d+00-1.D0", {0.05, -0.25, -1}},
    Data{"SignsAndIntegers", "+1 -0 3.", {1, -0.0, 3}},
    Data{"OneALine", "1\n\n2\n3", {1, 2, 3}},
    Data{"Tabs", "\t1\t2 \t3\t", {1, 2, 3}},
    Data{"ManyDigits", "0.1000000000000000055511151231257827 0.30000000000000004 123456789012345678901",
         {0.1, 0.1 + 0.2, 123456789012345683968.0}}),
    [](const testing::TestParamInfo<Data>& data) { return data.param.name; });

struct Refusal {
    const char* name;
    std::string text;
    const char* message;
};

class At2Refusal : public testing::TestWithParam<Refusal> {};

TEST_P(At2Refusal, NamesFileLineAndReason)
{
    EXPECT_EQ(refusal_of(GetParam().text), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(Of, At2Refusal, testing::Values(
    Refusal{"FewerSamples", at2("NPTS= 4, DT= .01 SEC"),
            "a.txt:6: the file ends after 3 samples, but NPTS announces 4 in line 4. Give the complete file."},
    Refusal{"MoreSamples", at2("NPTS= 2, DT= .01 SEC"),
            "a.txt:6: \"0.5\" follows the last of the 2 samples that NPTS announces in line 4. Correct NPTS or "
            "remove the rest."},
    Refusal{"NoSamples", at2("NPTS= 3, DT= .01 SEC", ""),
            "a.txt:4: the file ends after 0 samples, but NPTS announces 3 in line 4. Give the complete file."},
    Refusal{"NoPoints", at2("NPTS= 0, DT= .01 SEC"),
            "a.txt:4: NPTS is \"0\", but must be an integer from 1 to 10000000. Correct it, or give another "
            "record."},
    Refusal{"NegativePoints", at2("NPTS= -3, DT= .01 SEC"),
            "a.txt:4: NPTS is \"-3\", but must be an integer from 1 to 10000000. Correct it, or give another "
            "record."},
    Refusal{"AFractionOfPoints", at2("NPTS= 3.5, DT= .01 SEC"),
            "a.txt:4: NPTS is \"3.5\", but must be an integer from 1 to 10000000. Correct it, or give another "
            "record."},
    Refusal{"TooManyPoints", at2("NPTS= 10000001, DT= .01 SEC"),
            "a.txt:4: NPTS is \"10000001\", but must be an integer from 1 to 10000000. Correct it, or give "
            "another record."},
    Refusal{"PointsBeyondIntegers", at2("NPTS= 99999999999999999999999, DT= .01 SEC"),
            "a.txt:4: NPTS is \"99999999999999999999999\", but must be an integer from 1 to 10000000. Correct it, "
            "or give another record."},
    Refusal{"NoTimeStep", at2("NPTS= 3"),
            "a.txt:4: \"NPTS= 3\" lacks the number of points or the time step. Write it as in NPTS= 4000, DT= .01 "
            "SEC."},
    Refusal{"AnEmptyTimeStep", at2("NPTS= 3, DT="),
            "a.txt:4: \"NPTS= 3, DT=\" lacks the number of points or the time step. Write it as in NPTS= 4000, DT= "
            ".01 SEC."},
    Refusal{"ATimeStepOfZero", at2("NPTS= 3, DT= 0.00 SEC"),
            "a.txt:4: the time step is 0 s, but must be above 0. Correct it."},
    Refusal{"ANegativeTimeStep", at2("NPTS= 3, DT= -.01 SEC"),
            "a.txt:4: the time step is -0.01 s, but must be above 0. Correct it."},
    Refusal{"ATimeStepOfNan", at2("NPTS= 3, DT= NaN"),
            "a.txt:4: \"NaN\" is not finite. Give a record without gaps."},
    Refusal{"AWordAsTimeStep", at2("NPTS= 3, DT= unknown"),
            "a.txt:4: \"unknown\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
    Refusal{"Velocities", with(sound, "ACCELERATION TIME SERIES IN UNITS OF G", "VELOCITY TIME SERIES IN UNITS OF CM/S"),
            "a.txt:3: \"VELOCITY TIME SERIES IN UNITS OF CM/S\" does not contain accelerations. Give the AT2 file of this "
            "record."},
    Refusal{"NotANumber", with(sound, "0.5", "0.5 rest"),
            "a.txt:6: \"rest\" follows the last of the 3 samples that NPTS announces in line 4. Correct NPTS or "
            "remove the rest."},
    Refusal{"AWordAmongTheSamples", with(sound, "-.25E-01", "missing"),
            "a.txt:5: \"missing\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
    Refusal{"OverflowOfAFortranField", with(sound, "-.25E-01", "********"),
            "a.txt:5: \"********\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
    Refusal{"ADecimalComma", with(sound, "0.5", "0,5"),
            "a.txt:6: \"0,5\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
    Refusal{"ADecimalCommaInTheTimeStep", at2("NPTS= 3, DT= 1,5 SEC"),
            "a.txt:4: the time step \"1,5\" has a decimal comma. Write it with a point, as in DT= .01 SEC."},
    Refusal{"TwoSigns", with(sound, "0.5", "+-0.5"),
            "a.txt:6: \"+\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
    Refusal{"Hexadecimals", with(sound, "0.5", "0x1p3"),
            "a.txt:6: \"0x1p3\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
    Refusal{"AnExponentWithoutDigits", with(sound, "0.5", "5E"),
            "a.txt:6: \"5E\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
    Refusal{"Nan", with(sound, "0.5", "NaN"), "a.txt:6: \"NaN\" is not finite. Give a record without gaps."},
    Refusal{"Infinity", with(sound, "0.5", "-Infinity"),
            "a.txt:6: \"-Infinity\" is not finite. Give a record without gaps."},
    Refusal{"Overflow", with(sound, "0.5", "1E+999"),
            "a.txt:6: \"1E+999\" is outside the range of double precision. Correct it."},
    Refusal{"ALongWord", with(sound, "0.5", std::string(100, 'x')),
            "a.txt:6: \"xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...\" is not a number. Write numbers as in 0.5, "
            "-.5E-01 or -.5D-01."},
    Refusal{"AWordInAnotherEncoding", with(sound, "0.5", "\"\xe9\\"),
            "a.txt:6: \"\\\"\\xe9\\\\\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."}),
    [](const testing::TestParamInfo<Refusal>& refusal) { return refusal.param.name; });
// clang-format on

TEST(At2, RefusesAUnitBecauseItStatesItsOwn)
{
    EXPECT_EQ(refusal_of(sound, {.time_step = {}, .unit = AccelerationUnit::cm_per_s2}),
              "a.txt: units = cm/s2 was given, but this AT2 file is in g. Remove units.");
}

TEST(At2, RefusesATimeStepBecauseItStatesItsOwn)
{
    EXPECT_EQ(refusal_of(sound, {.time_step = 0.02, .unit = {}}),
              "a.txt: time_step = 0.02 was given, but the AT2 file states its own, 0.01 s. Remove "
              "time_step.");
}

TEST(At2, RefusesAHeaderThatFillsTheMemory)
{
    EXPECT_EQ(
        refusal_of(with(sound, "PEER", std::string(2 << 20, 'x'))),
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
