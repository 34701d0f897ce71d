// Files of USGS.
#include "reading.hpp"

#include "support/untrapped_floating_point.hpp"

#include <fmt/format.h>

#include <random>

namespace overturn {
namespace {

const std::string no_integers =
    "    -32768    -32768    -32768    -32768    -32768    -32768    -32768    -32768\n";
const std::string no_numbers =
    "  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1700000E+39\n";

std::string repeated(const std::string& text, int times)
{
    std::string result;
    for (int i = 0; i < times; ++i) {
        result += text;
    }
    return result;
}

const std::string data =
    "-2.1104E+1-4.7756E+0 1.8436E+1-1.8591E+1-1.5827E+1-1.5471E+1-1.2717E+1-1.1380E+1\n"
    " 2.7397E-1-9.7655E-1\n";

const std::string sound_smc =
    "2 CORRECTED ACCELEROGRAM   \n" + repeated("*\n", 4) +
    "station = Nowhere  component=     43   \n" + repeated("*\n", 5) + repeated(no_integers, 2) +
    "        10    -32768    -32768    -32768    -32768    -32768    -32768    -32768\n" +
    repeated(no_integers, 3) +
    "  0.1700000E+39  0.2000000E+03  0.3703700E+02 -0.1218830E+03  0.1800000E+02\n" +
    repeated(no_numbers, 9) + "|\n| a comment\n" + data;

TEST(Smc, GivesItsSamplesInCentimetresPerSecondSquared)
{
    const RecordFile file = parse_record(sound_smc, "a.txt");
    EXPECT_EQ(file.format, "SMC");
    ASSERT_EQ(file.components.size(), 1);
    EXPECT_EQ(file.components[0].unit, AccelerationUnit::cm_per_s2);
    EXPECT_EQ(file.components[0].acceleration,
              (Values{-21.104, -4.7756, 18.436, -18.591, -15.827, -15.471, -12.717, -11.380,
                      0.27397, -0.97655}));
}

TEST(Smc, HasTheTimeStepOfItsSamplesPerSecond)
{
    EXPECT_EQ(component_of(sound_smc).time_step, 0.005);
}

TEST(Smc, NamesItsComponent)
{
    EXPECT_EQ(component_of(sound_smc).name, "43");
}

TEST(Smc, StatesItsEarthquakeAndItsStation)
{
    const std::string line = "     1989  10  18    0004 Nowhere, CA  \n*\nstation";
    EXPECT_EQ(component_of(with(sound_smc, "*\n*\nstation", line)).event,
              "1989 10 18 0004 Nowhere, CA, station = Nowhere");
}

TEST(Smc, WithoutNamedComponentHasOneWithoutName)
{
    EXPECT_EQ(component_of(with(sound_smc, "component=     43", "")).name, "");
}

TEST(Smc, KeepsItsHeaderAndItsComments)
{
    const std::vector<std::string> header = component_of(sound_smc).header;
    ASSERT_EQ(header.size(), 29);
    EXPECT_EQ(header.front(), "2 CORRECTED ACCELEROGRAM   ");
    EXPECT_EQ(header.back(), "| a comment");
}

TEST(Smc, MayBeUncorrected)
{
    EXPECT_EQ(component_of(with(sound_smc, "2 CORRECTED", "1 UNCORRECTED")).acceleration.size(),
              10);
}

TEST(Smc, IsNotCorrectedIfItsTitleSaysSo)
{
    EXPECT_FALSE(component_of(sound_smc).is_uncorrected);
    EXPECT_TRUE(component_of(with(sound_smc, "2 CORRECTED", "1 UNCORRECTED")).is_uncorrected);
}

TEST(Smc, MayHaveNoComments)
{
    EXPECT_EQ(component_of(with(sound_smc, "|\n| a comment\n", "")).header.size(), 27);
}

TEST(Smc, MayHaveWiderColumns)
{
    const std::string wide =
        with(with(sound_smc, data, "-2.1104000E+01 4.7756000E+00\n"), "        10", "         2");
    EXPECT_EQ(component_of(wide).acceleration, (Values{-21.104, 4.7756}));
}

TEST(Smc, MayHaveTheLineEndsOfAnySystem)
{
    for (const char* end : {"\n", "\r\n", "\r\r\n"}) {
        EXPECT_EQ(component_of(with_line_ends(sound_smc, end)).header,
                  component_of(sound_smc).header);
    }
}

TEST(Smc, IsRefusedIfItsSamplesArePairsOfTimesAndAccelerations)
{
    std::mt19937 random(7);
    for (int i = 0; i < 20; ++i) {
        std::string pairs;
        const std::size_t count = 4 + random() % 9;
        double time = double(random() % 3) / 100;
        for (std::size_t j = 0; j < count; ++j) {
            pairs += fmt::format("{:10.4E}{:11.4E}\n", time, double(random() % 2000) / 10 - 100);
            time += double(1 + random() % 30) / 1000;
        }
        const std::string text =
            with(with(sound_smc, data, pairs), "        10", fmt::format("{:10}", 2 * count));
        EXPECT_NE(refusal_of(text).find("the samples are pairs of times and accelerations"),
                  std::string::npos)
            << text;
    }
}

TEST(Smc, MayEndWithPadding)
{
    for (const std::string& padding : paddings()) {
        EXPECT_EQ(component_of(sound_smc + padding).acceleration,
                  component_of(sound_smc).acceleration);
    }
}

// clang-format off
TEST(Smc, IsRefusedWithFileLineAndReason)
{
    const UntrappedFloatingPoint overflows;
    expect_refused({
        {"Velocities", with(sound_smc, "2 CORRECTED ACCELEROGRAM", "3 VELOCITY"),
            "a.txt:1: \"3 VELOCITY\" does not announce accelerations. Give the file of the acceleration."},
        {"Displacements", with(sound_smc, "2 CORRECTED ACCELEROGRAM", "4 DISPLACEMENT"),
            "a.txt:1: \"4 DISPLACEMENT\" does not announce accelerations. Give the file of the acceleration."},
        {"ResponseSpectra", with(sound_smc, "2 CORRECTED ACCELEROGRAM", "5 RESPONSE SPECTRA"),
            "a.txt:1: \"5 RESPONSE SPECTRA\" does not announce accelerations. Give the file of the acceleration."},
        {"FewerSamples", with(sound_smc, "-9.7655E-1", ""),
            "a.txt:31: the file ends after 9 samples, but the header announces 10 in line 14. Give the complete "
            "file."},
        {"MoreSamples", with(sound_smc, "-9.7655E-1", "-9.7655E-1-9.7655E-1"),
            "a.txt:31: \"-9.7655E-1\" follows the last of the 10 samples that the header announces in line 14. "
            "Correct the header or remove the rest."},
        {"AnEarlyEnd", sound_smc.substr(0, sound_smc.find("| a comment")),
            "a.txt:28: the file ends after 0 samples, but the header announces 10 in line 14. Give the complete "
            "file."},
        {"AnEarlyEndInTheHeader", sound_smc.substr(0, sound_smc.find("        10")),
            "a.txt:13: the file ends within the header. Give the complete file."},
        {"AnUnknownNumberOfSamples", with(sound_smc, "        10", "    -32768"),
            "a.txt:14: the number of samples, columns 1 to 10, is \"-32768\", which stands for an unknown number. Give a "
            "file that states it."},
        {"TooManySamples", with(sound_smc, "        10", "2000000000"),
            "a.txt:14: the number of samples, columns 1 to 10, is \"2000000000\", but must be an integer from 1 to "
            "10000000. Correct it, or give another record."},
        {"AnUnknownRate", with(sound_smc, "  0.2000000E+03", "  0.1700000E+39"),
            "a.txt:18: the number of samples per second is 0.1700000E+39, which stands for an unknown number: the samples "
            "are not at even times, but pairs of times and accelerations. Interpolate the accelerations at even times, "
            "and give both as text."},
        {"ARateOfZero", with(sound_smc, "  0.2000000E+03", "  0.0000000E+00"),
            "a.txt:18: the number of samples per second is \"0.0000000E+00\", but must be above 0, and its "
            "inverse finite. Correct it."},
        {"ARateWithoutInverse", with(sound_smc, "  0.2000000E+03", " 0.2000000E-320"),
            "a.txt:18: the number of samples per second is \"0.2000000E-320\", but must be above 0, and its "
            "inverse finite. Correct it."},
        {"AMissingRate", with(sound_smc, "  0.2000000E+03", "               "),
            "a.txt:18: \"\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
        {"Overflow", with(sound_smc, "-9.7655E-1", "**********"),
            "a.txt:31: \"2.7397E-1**********\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."}});
}
// clang-format on

TEST(Smc, RefusesAUnitBecauseItStatesItsOwn)
{
    EXPECT_EQ(refusal_of(sound_smc, in_g),
              "a.txt: units = g was given, but this SMC file is in cm/s2. Remove units.");
}

} // namespace
} // namespace overturn
