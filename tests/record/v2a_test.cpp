// Files of GeoNet.
#include "reading.hpp"

#include <fmt/format.h>

#include <cmath>

namespace overturn {
namespace {

/// Twelve numbers in columns of 8 characters, ten per line.
std::string block(double first)
{
    std::string text;
    for (int i = 0; i < 12; ++i) {
        std::string column = std::to_string(first + i);
        column.resize(column.find('.') + 2);
        text += std::string(8 - column.size(), ' ') + column + (i % 10 == 9 || i == 11 ? "\n" : "");
    }
    return text;
}

/// A component whose samples are first, first + 1, ..., first + 11 mm/s2.
std::string component(const std::string& name, double first)
{
    const bool is_last_larger = std::abs(first + 11) > std::abs(first);
    const double mean = first + 5.5;
    const double variance = 143.0 / 12; // of twelve consecutive numbers
    std::string text = "Corrected accelerogram 20200101_000000_NONE_20 Nobody\n"
                       "Site NONE      40 00 00S  170 00 00E     Cusp file:  none\n";
    for (int line = 3; line < 10; ++line) {
        text += "line " + std::to_string(line) + "\n";
    }
    text +=
        "Number of points    12    Duration   0.22 sec\n"
        "Instrument corrected data at 0.020 sec intervals\n"
        "Band-pass filter transition bands are .10-.25 Hz and 24.50-25.50 Hz\n"
        "Component " +
        name + "  Some Accelerometer Axis\n" +
        fmt::format("Acceleration:  peak {:8.1f} mm/s/s at   {:.2f} sec     rms {:8.1f} mm/s/s\n",
                    is_last_larger ? first + 11 : first, is_last_larger ? 0.22 : 0,
                    std::sqrt(mean * mean + variance)) +
        "Velocity:      peak     -1.0 mm/s   at   0.00 sec     rms      1.0 mm/s\n"
        "Displacement:  peak     -1.0 mm     at   0.00 sec     rms      1.0 mm\n";
    for (int line = 17; line < 20; ++line) {
        text +=
            "    2020       1       1       0       0       0       0       0    2020       1\n";
    }
    text += "   65536     250     250      12      12      12       0       0       2   19715\n"
            "   200.0    0.70    0.00   0.000  0.0000   0.000   0.000   1.000     0.0    0.00\n"
            "  40.000 170.000   40.00  170.00    5.00    0.00    0.00    0.00      0.      0.\n"
            "  327.68    0.00    0.00    0.22  0.0050  0.0200      0.      0.      0.  9806.6\n";
    for (int line = 24; line < 27; ++line) {
        text +=
            "     0.0     0.0     0.0     0.0     0.0     0.0     0.0     0.0     0.0     0.0\n";
    }
    return text + block(first) + block(0) + block(-1);
}

const std::string sound_v2a = component("N28W", -3) + component("S62W", 10) + component("Up", -50);

TEST(V2a, HasThreeComponentsInMillimetresPerSecondSquared)
{
    const RecordFile file = parse_record(sound_v2a, "a.txt");
    EXPECT_EQ(file.format, "V2A");
    ASSERT_EQ(file.components.size(), 3);
    for (const RecordComponent& part : file.components) {
        EXPECT_EQ(part.unit, AccelerationUnit::mm_per_s2);
        EXPECT_EQ(part.time_step, 0.02);
        EXPECT_EQ(part.header.size(), 26);
    }
}

TEST(V2a, NamesItsComponents)
{
    const RecordFile file = parse_record(sound_v2a, "a.txt");
    ASSERT_EQ(file.components.size(), 3);
    EXPECT_EQ(file.components[0].name, "N28W");
    EXPECT_EQ(file.components[1].name, "S62W");
    EXPECT_EQ(file.components[2].name, "Up");
}

TEST(V2a, KeepsTheAccelerationOnly)
{
    const RecordFile file = parse_record(sound_v2a, "a.txt");
    ASSERT_EQ(file.components.size(), 3);
    EXPECT_EQ(file.components[0].acceleration, (Values{-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(file.components[2].acceleration.front(), -50);
}

TEST(V2a, KeepsTheHeaderOfEachComponent)
{
    const RecordFile file = parse_record(sound_v2a, "a.txt");
    ASSERT_EQ(file.components.size(), 3);
    EXPECT_EQ(file.components[1].header.front(),
              "Corrected accelerogram 20200101_000000_NONE_20 Nobody");
    EXPECT_EQ(file.components[1].header[12], "Component S62W  Some Accelerometer Axis");
}

TEST(V2a, ReadsColumnsThatTouch)
{
    std::string text = with(sound_v2a, "    -3.0    -2.0    -1.0", "-11024.7100000.0-20000.0");
    text = with(text, "peak      8.0", "peak 100000.0");
    const Values values = parse_record(text, "a.txt").components.at(0).acceleration;
    EXPECT_EQ(values[0], -11024.7);
    EXPECT_EQ(values[1], 100000);
    EXPECT_EQ(values[2], -20000);
}

TEST(V2a, MayHaveFewerComponents)
{
    EXPECT_EQ(component_of(component("Up", 1)).name, "Up");
}

TEST(V2a, MayHaveTheLineEndsOfAnySystem)
{
    for (const char* end : {"\n", "\r\n", "\r\r\n", "  \r\n"}) {
        const RecordFile file = parse_record(with_line_ends(sound_v2a, end), "a.txt");
        ASSERT_EQ(file.components.size(), 3);
        EXPECT_EQ(file.components[2].acceleration.back(), -39);
    }
}

TEST(V2a, MayEndWithBlankLines)
{
    EXPECT_EQ(parse_record(sound_v2a + "\n   \n", "a.txt").components.size(), 3);
}

TEST(V2a, MayEndWithPadding)
{
    for (const std::string& padding : paddings()) {
        const RecordFile file = parse_record(sound_v2a + padding, "a.txt");
        EXPECT_EQ(file.components.back().acceleration,
                  parse_record(sound_v2a, "a.txt").components.back().acceleration);
    }
}

TEST(V2a, MayOmitVelocityAndDisplacement)
{
    std::string text =
        with(component("Up", 1), "250      12      12      12", "250      12       0       0");
    text.resize(text.size() - block(0).size() - block(-1).size());
    EXPECT_EQ(component_of(text).acceleration.size(), 12);
}

const std::string counts = "   65536     250     250      12      12      12";

// clang-format off
TEST(V2a, IsRefusedWithFileLineAndReason)
{
    expect_refused({
        {"FewerSamples", with(sound_v2a, "    -3.0    -2.0    -1.0", "    -2.0    -1.0"),
            "a.txt:27: the line has 9 columns of 8 characters, but must have 10: line 20 announces 12 values of "
            "acceleration, 10 per line. Give the file as it was published."},
        {"MoreSamples", with(sound_v2a, "     7.0     8.0\n", "     7.0     8.0     9.0\n"),
            "a.txt:28: the line has 3 columns of 8 characters, but must have 2: line 20 announces 12 values of "
            "acceleration, 10 per line. Give the file as it was published."},
        {"AMissingLine", with(sound_v2a, "     7.0     8.0\n", ""),
            "a.txt:28: the line has 10 columns of 8 characters, but must have 2: line 20 announces 12 values of "
            "acceleration, 10 per line. Give the file as it was published."},
        {"AnEarlyEnd", sound_v2a.substr(0, sound_v2a.size() - block(-1).size()),
            "a.txt:94: the file ends after 0 of the 12 values of displacement that line 84 announces. Give the "
            "complete file."},
        {"AnEarlyEndInTheHeader", sound_v2a.substr(0, sound_v2a.find("   65536")),
            "a.txt:19: the file ends within the header. Give the complete file."},
        {"AGap", with(sound_v2a, "    -2.0", "        "),
            "a.txt:27: \"\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
        {"Nan", with(sound_v2a, "    -2.0", "     nan"),
            "a.txt:27: \"nan\" is not finite. Give a record without gaps."},
        {"NoPoints", with(sound_v2a, counts, "   65536     250     250       0      12      12"),
            "a.txt:20: the number of values of acceleration is \"0\", but must be an integer from 1 to 10000000. "
            "Correct it, or give another record."},
        {"TooManyPoints", with(sound_v2a, counts, "   65536     250     25012345678      12      12"),
            "a.txt:20: the number of values of acceleration is \"12345678\", but must be an integer from 1 to "
            "10000000. Correct it, or give another record."},
        {"NegativeVelocities", with(sound_v2a, counts, "   65536     250     250      12      -1      12"),
            "a.txt:20: the number of values of velocity is \"-1\", but must be an integer from 0 to 10000000. "
            "Correct it, or give another record."},
        {"ATimeStepOfZero", with(sound_v2a, "  0.0050  0.0200", "  0.0050  0.0000"),
            "a.txt:23: the time step is 0 s, but must be above 0. Correct it."},
        {"AMissingTimeStep", with(sound_v2a, "  0.0050  0.0200", "  0.0050        "),
            "a.txt:23: \"\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
        {"AnotherUnit", with(sound_v2a, "8.0 mm/s/s at   0.22 sec     rms      4.3 mm/s/s", "8.0 cm/s/s"),
            "a.txt:14: \"Acceleration:  peak      8.0 cm/s/s\" does not state the unit mm/s/s. Give the values as "
            "text with their unit."},
        {"AComponentWithoutName", with(sound_v2a, "Component N28W", "Direction N28W"),
            "a.txt:13: \"Direction N28W  Some Accelerometer Axis\" does not name the component. Write it as in "
            "Component N28W."},
        {"UncorrectedData", with(sound_v2a, "Corrected", "Uncorrected"),
            "a.txt:1: this is an uncorrected accelerogram (V1A or volume 1). Give the corrected one (V2A or volume 2)."},
        {"AFourthComponent", sound_v2a + component("Down", 1),
            "a.txt:97: more text follows the last of the 3 components. Remove it."},
        {"AnotherTextBehindAComponent", component("Up", 1) + std::string("rest\n") + component("N", 1),
            "a.txt:33: \"rest\" is not the first line of a channel, such as Corrected accelerogram. Give the "
            "file as it was published."}});
}
// clang-format on

TEST(V2a, RefusesAUnitBecauseItStatesItsOwn)
{
    EXPECT_EQ(refusal_of(sound_v2a, in_g),
              "a.txt: units = g was given, but this V2A file is in mm/s2. Remove units.");
}

} // namespace
} // namespace overturn
