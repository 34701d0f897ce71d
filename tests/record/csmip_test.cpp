// Files of CSMIP, volume 2.
#include "reading.hpp"

namespace overturn {
namespace {

const std::string accelerations =
    "  -.001239   .250000 -1.500000  2.000000  3.000000  4.000000  5.000000  "
    "6.000000\n  7.000000  8.000000\n";
const std::string velocities = "-.00141810 .25000000 -1.5000000 2.00000000 3.00000000 4.00000000 "
                               "5.00000000 6.0000000\n";

/// A channel of ten samples.
std::string channel(const std::string& name)
{
    return "Corrected accelerogram   99999-L1-14236.52       Chan  1:  " + name +
           "         from\n"
           "Uncorrected Accelerogram Data             Processed: 08/24/14, CGS\n"
           "Station No. 99999   37.973N, 122.038W    Etna    s/n 1  (3 Chns of  3 at Sta)\n"
           "Nowhere                                 CGS   Data: Acceleration\n"
           "Chan  1:  " +
           name +
           "          \n"
           "  10 points of instrument- and baseline-corrected accel, veloc and displ data\n"
           "At equally-spaced intervals of    .010  sec.\n"
           "Peak acceleration =     8.000    cm/sec/sec  at     .090   sec.\n"
           "\n"
           "    1  100    1    3\n"
           "  .0101833  .6400000\n"
           "  10 points of accel data equally spaced at  .010 sec, in cm/sec2. (8f10.6)\n" +
           accelerations +
           "   2 points of veloc data equally spaced at  .010 sec, in cm/sec.  (8f10.7)\n"
           " -.0014181 -.0014305\n"
           "   2 points of displ data equally spaced at  .010 sec, in cm.      (8f10.7)\n"
           "  .0022269  .0022127\n"
           "/&  ----------  End of data for channel  1  ----------\n";
}

const std::string sound_csmip = channel("90 Deg") + channel("Up") + channel("360 Deg");
const Values csmip_samples{-0.001239, 0.25, -1.5, 2, 3, 4, 5, 6, 7, 8};

TEST(Csmip, HasAComponentForEachChannel)
{
    const RecordFile file = parse_record(sound_csmip, "a.txt");
    EXPECT_EQ(file.format, "CSMIP");
    const std::vector<std::string> names{"90 Deg", "Up", "360 Deg"};
    ASSERT_EQ(file.components.size(), 3);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(file.components[i].name, names[i]);
        EXPECT_EQ(file.components[i].unit, AccelerationUnit::cm_per_s2);
        EXPECT_EQ(file.components[i].time_step, 0.01);
        EXPECT_EQ(file.components[i].acceleration, csmip_samples);
        EXPECT_FALSE(file.components[i].is_uncorrected);
        EXPECT_EQ(file.components[i].header.size(), 12);
    }
}

// clang-format off
TEST(Csmip, NamesAChannelByItsDirectionAndNotByItsPlace)
{
    struct Line { const char* text; const char* direction; const char* place; };
    for (const auto& [text, direction, place] : std::vector<Line>{
             {"Chan  1:  90 Deg", "90 Deg", ""}, {"Chan  1: 360 Deg      Location: Roof: SW", "360 Deg", "Roof: SW"},
             {"Chan  2: Up   Ground", "Up", "Ground"}, {"CHAN  1:  90 DEG", "90 DEG", ""},
             {"Chan 12:  H1  ", "H1", ""}, {"Chan  3: 360 Deg Location: Ground Floor", "360 Deg", "Ground Floor"},
             {"Sta Chan  1: 340 deg (Rcrdr Chan  1) Location: roof", "340 deg", "roof"},
             {"Sta Cha:  1: 340 deg (Rcrdr Chan  1) Location: a: b", "340 deg", "a: b"},
             {"Sta Chan   ?:Other   (Rcrdr Chan  ?) Location:", "Other", ""}, {"Chan  4: N 45 E   2nd floor: N", "N 45 E", "2nd floor: N"},
             {"Chan  5: 90 Deg (Rcrdr: 7) Location: x", "90 Deg", "x"}, {"Chan  6", "", ""},
             {"Chan  7: -90 Deg\tDeck", "-90 Deg", "Deck"}, {"Chan  8: Vert   Bent 5: top", "Vert", "Bent 5: top"},
             {"Chan: 9: Up", "Up", ""}, {"chan  1: up location: 1st: N: E", "up", "1st: N: E"},
             {"Chan. 2: Up", "Up", ""}, {"Chan 10:", "", ""}, {"Chan 11: 180 Deg   (Roof: W)", "180 Deg", "(Roof: W)"},
             {"Chan A: S16E", "S16E", ""}, {"Chan  2:Radial  Dam: crest", "Radial", "Dam: crest"}}) {
        const RecordComponent component = component_of(with(channel("90 Deg"), "Chan  1:  90 Deg          \n", std::string(text) + "\n"));
        EXPECT_EQ(component.name, direction) << text;
        EXPECT_EQ(component.place, place) << text;
    }
}
// clang-format on

TEST(Csmip, MayHaveAnyNumberOfChannels)
{
    EXPECT_EQ(component_of(channel("90 Deg")).name, "90 Deg");
    EXPECT_EQ(parse_record(sound_csmip + sound_csmip, "a.txt").components.size(), 6);
}

TEST(Csmip, MayBeInCapitalsWithoutFormatOfTheValues)
{
    std::string text =
        with(channel("90 Deg"), " sec, in cm/sec2. (8f10.6)", " SEC.  (UNITS: CM/SEC/SEC)");
    text = with(text, accelerations,
                "    -3.038     -.787     2.288     4.106     4.898     3.777      .630    "
                "-1.080\n    -2.112    -5.659\n");
    text = with(text, "8.000    cm/sec/sec", "-5.659   cm/sec/sec");
    for (char& letter : text) {
        letter = 'a' <= letter && letter <= 'z' ? char(letter - 'a' + 'A') : letter;
    }
    const RecordComponent component = component_of(text);
    EXPECT_EQ(component.name, "90 DEG");
    EXPECT_EQ(component.unit, AccelerationUnit::cm_per_s2);
    EXPECT_EQ(component.acceleration,
              (Values{-3.038, -.787, 2.288, 4.106, 4.898, 3.777, .630, -1.080, -2.112, -5.659}));
}

TEST(Csmip, MayHaveOtherUnits)
{
    const auto unit_of_channel = [](const char* unit, const char* peak) {
        const std::string text = with(channel("Up"), "in cm/sec2.", unit);
        return component_of(with(text, "8.000    cm/sec/sec", peak)).unit;
    };
    EXPECT_EQ(unit_of_channel("in g.", "8.000    g"), AccelerationUnit::g);
    EXPECT_EQ(unit_of_channel("in mm/sec/sec.", "8.000    mm/sec/sec"),
              AccelerationUnit::mm_per_s2);
    EXPECT_EQ(unit_of_channel("in mm/sec/sec.", " .800    cm/sec/sec"),
              AccelerationUnit::mm_per_s2);
}

TEST(Csmip, MayHaveAnyFormatOfTheValues)
{
    const std::vector<std::pair<const char*, std::string>> formats{
        {"(5f9.3)",
         "    1.500    2.000   -3.500    4.000    5.000\n    6.000    7.000    8.000    9.000   "
         "10.500\n"},
        {"(10F4.1)", " 1.5 2.0-3.5 4.0 5.0 6.0 7.0 8.0 9.010.5\n"},
        {"(1PE12.4)", "  1.5000E+00\n  2.0000E+00\n -3.5000E+00\n  4.0000E+00\n  5.0000E+00\n  "
                      "6.0000E+00\n  7.0000E+00\n  8.0000E+00\n  9.0000E+00\n  1.0500E+01\n"}};
    for (const auto& [format, data] : formats) {
        const std::string text = with(with(channel("Up"), "(8f10.6)", format), accelerations, data);
        EXPECT_EQ(component_of(with(text, "=     8.000", "=    10.500")).acceleration,
                  (Values{1.5, 2, -3.5, 4, 5, 6, 7, 8, 9, 10.5}))
            << format;
    }
}

TEST(Csmip, ReadsColumnsThatTouch)
{
    std::string text = with(channel("Up"), "   .250000 -1.500000", "123.250000100.500000");
    text = with(text, "=     8.000", "=   123.250");
    EXPECT_EQ(component_of(text).acceleration[1], 123.25);
    EXPECT_EQ(component_of(text).acceleration[2], 100.5);
}

TEST(Csmip, MayHaveTheLineEndsOfAnySystemAndBlankLines)
{
    for (const char* end : {"\r\n", "\n\n", "   \r\n"}) {
        const RecordFile file = parse_record(with_line_ends(sound_csmip, end), "a.txt");
        ASSERT_EQ(file.components.size(), 3);
        EXPECT_EQ(file.components[2].acceleration, csmip_samples);
    }
}

TEST(Csmip, MayEndWithPadding)
{
    for (const std::string& padding : paddings()) {
        const RecordFile file = parse_record(sound_csmip + padding, "a.txt");
        EXPECT_EQ(file.components.back().acceleration,
                  parse_record(sound_csmip, "a.txt").components.back().acceleration);
    }
}

TEST(Csmip, MayOmitVelocityDisplacementAndEnd)
{
    const std::string text = channel("Up");
    const std::string only = text.substr(0, text.find("   2 points of veloc"));
    EXPECT_EQ(component_of(only).acceleration, csmip_samples);
    EXPECT_EQ(parse_record(only + only, "a.txt").components.size(), 2);
}

// clang-format off
TEST(Csmip, IsRefusedWithFileLineAndReason)
{
    const std::string announces = "  10 points of accel data equally spaced at  .010 sec, in cm/sec2. (8f10.6)";
    expect_refused({
        {"Velocities", with(sound_csmip, announces, "  10 points of veloc data equally spaced at  .010 sec, in cm/sec. (8f10.6)"),
            "a.txt:12: \"10 points of veloc data equally spaced a...\" does not announce "
            "accelerations. Give the file of the acceleration."},
        {"FewerSamples", with(sound_csmip, "  7.000000  8.000000\n", "  7.000000\n"),
            "a.txt:14: the line has 1 column of 10 characters, but must have 2: line 12 announces 10 values of "
            "acceleration, 8 per line. Give the file as it was published."},
        {"MoreSamples", with(sound_csmip, "  7.000000  8.000000\n", "  7.000000  8.000000\n  9.000000\n"),
            "a.txt:15: \"9.000000\" is not the first line of a channel, such as Corrected accelerogram. Give the file "
            "as it was published."},
        {"AnEarlyEnd", channel("Up").substr(0, channel("Up").find("  7.000000")),
            "a.txt:13: the file ends after 8 of the 10 values of acceleration that line 12 announces. Give the "
            "complete file."},
        {"AnEarlyEndInTheHeader", channel("Up").substr(0, channel("Up").find(announces)),
            "a.txt:11: the channel that begins in line 1 has no line such as 7500 points of accel data equally spaced "
            "at .010 sec, in cm/sec2. (8f10.6). Give the complete file of volume 2."},
        {"NoUnit", with(sound_csmip, "in cm/sec2. ", ""),
            "a.txt:12: the unit \"\" of the samples is not understood. Understood are g, m/s2, cm/s2, mm/s2, gal and their "
            "usual spellings, such as cm/sec2. Give the file of the acceleration, or the values as text with their "
            "unit."},
        {"AnotherUnit", with(sound_csmip, "in cm/sec2.", "in g/10."),
            "a.txt:12: the unit \"g/10.\" of the samples is not understood. Understood are g, m/s2, cm/s2, mm/s2, gal and "
            "their usual spellings, such as cm/sec2. Give the file of the acceleration, or the values as text with "
            "their unit."},
        {"AnotherUnitOfTheTimeStep", with(sound_csmip, ".010 sec, in", "10. msec, in"),
            "a.txt:12: the time step \"10.\" is followed by \"msec,\", but must be in seconds, as in .010 sec. Correct "
            "it."},
        {"ContradictoryTimeSteps", with(sound_csmip, "intervals of    .010", "intervals of    .005"),
            "a.txt:7: the interval is .005 s, but that of the samples is 0.01 s. Give the file as it was published, or "
            "correct the wrong one."},
        {"ACutNumber", with(sound_csmip, "(8f10.6)", "(10f8.6)"),
            "a.txt:13: column 1 of 8 characters ends within a number: \"-.0012\". Give the file as it was published."},
        {"AnUncorrectedRecord", with(sound_csmip, "Corrected accelerogram", "Uncorrected accelerogram"),
            "a.txt:1: this is an uncorrected accelerogram (V1A or volume 1). Give the corrected one (V2A or volume 2)."},
        {"AnotherTextBehindAChannel", channel("Up") + "rest\n",
            "a.txt:20: \"rest\" is not the first line of a channel, such as Corrected accelerogram. Give the file as "
            "it was published."}});
}
// clang-format on

} // namespace
} // namespace overturn
