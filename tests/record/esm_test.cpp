// Files of ESM.
#include "reading.hpp"

#include <fmt/format.h>

namespace overturn {
namespace {

const std::string sound_esm = "EVENT_NAME: NOWHERE\n"
                              "STATION_CODE: NONE\n"
                              "EARTHQUAKE_BACKAZIMUTH_DEGREE: \n"
                              "SAMPLING_INTERVAL_S: 0.005000\n"
                              "NDATA: 4\n"
                              "DURATION_S: 0.020\n"
                              "STREAM: HNE\n"
                              "UNITS: cm/s^2\n"
                              "FULL_SCALE_G: \n"
                              "PGA_CM/S^2: -1.500000\n"
                              "BASELINE_CORRECTION: BASELINE REMOVED\n"
                              "DATA_TYPE: ACCELERATION\n"
                              "PROCESSING: manual (Nobody, 2011)\n"
                              "USER5: \n"
                              "0.000000\n-1.500000\n0.250000\n1.000000\n";

TEST(Esm, GivesItsSamplesInTheUnitOfItsHeader)
{
    const RecordFile file = parse_record(sound_esm, "a.txt");
    EXPECT_EQ(file.format, "ESM");
    ASSERT_EQ(file.components.size(), 1);
    EXPECT_EQ(file.components[0].unit, AccelerationUnit::cm_per_s2);
    EXPECT_EQ(file.components[0].acceleration, (Values{0, -1.5, 0.25, 1}));
    const std::string peak = "PGA_CM/S^2: -1.500000";
    EXPECT_EQ(component_of(with(with(sound_esm, "cm/s^2", "m/s^2"), peak, "PGA_CM/S^2: -150")).unit,
              AccelerationUnit::m_per_s2);
    EXPECT_EQ(component_of(with(with(sound_esm, "cm/s^2", "g"), peak, "PGA_G: -1.5")).unit,
              AccelerationUnit::g);
}

TEST(Esm, HasTheTimeStepAndTheStreamOfItsHeader)
{
    EXPECT_EQ(component_of(sound_esm).time_step, 0.005);
    EXPECT_EQ(component_of(sound_esm).name, "HNE");
    EXPECT_EQ(component_of(with(sound_esm, "STREAM: HNE\n", "")).name, "");
}

TEST(Esm, StatesItsEarthquakeAndItsStation)
{
    EXPECT_EQ(component_of(sound_esm).event, "NOWHERE, NONE");
    EXPECT_EQ(component_of(with(sound_esm, "NOWHERE\n",
                                "NOWHERE\nEVENT_DATE_YYYYMMDD: 20190728\n"
                                "EVENT_TIME_HHMMSS: 160908\n"))
                  .event,
              "NOWHERE, 20190728, 160908, NONE");
}

TEST(Esm, IsNotCorrectedIfItWasNotProcessed)
{
    EXPECT_FALSE(component_of(sound_esm).is_uncorrected);
    for (const char* processing : {"", "none", "NONE"}) {
        EXPECT_TRUE(
            component_of(with(sound_esm, "manual (Nobody, 2011)", processing)).is_uncorrected)
            << processing;
    }
}

TEST(Esm, KeepsItsHeader)
{
    const std::vector<std::string> header = component_of(sound_esm).header;
    ASSERT_EQ(header.size(), 14);
    EXPECT_EQ(header.front(), "EVENT_NAME: NOWHERE");
    EXPECT_EQ(header.back(), "USER5: ");
}

TEST(Esm, MayHaveTheLineEndsOfAnySystemAndBlankLines)
{
    for (const char* end : {"\r\n", "\n\n", " \n"}) {
        EXPECT_EQ(component_of(with_line_ends(sound_esm, end)).acceleration,
                  component_of(sound_esm).acceleration);
    }
}

TEST(Esm, MayEndWithPadding)
{
    for (const std::string& padding : paddings()) {
        const RecordFile file = parse_record(sound_esm + padding, "a.txt");
        EXPECT_EQ(file.components.back().acceleration,
                  parse_record(sound_esm, "a.txt").components.back().acceleration);
    }
}

TEST(Esm, MayLackKeysThatAreNotNeeded)
{
    for (const char* line : {"EVENT_NAME: NOWHERE\n", "DURATION_S: 0.020\n", "USER5: \n",
                             "DATA_TYPE: ACCELERATION\n"}) {
        EXPECT_EQ(component_of(with(sound_esm, line, "")).acceleration.size(), 4);
    }
    EXPECT_EQ(
        component_of(with(sound_esm, "DURATION_S: 0.020", "DURATION_S: ")).acceleration.size(), 4);
}

std::vector<std::string> remarks_on_peak(const std::string& peak)
{
    return component_of(with(sound_esm, "-1.500000\nBASE", peak + "\nBASE")).remarks;
}

TEST(Esm, RemarksOnAPeakThatDiffersByMoreThanOnePercent)
{
    for (const char* peak : {"-1.500000", "1.500000", "1.487", "1.513", "1.5", "2", "0", "-999"}) {
        EXPECT_EQ(remarks_on_peak(peak), std::vector<std::string>()) << peak; // 2 may be 1.5
    }
    for (const char* peak : {"1.470000", "1.53", "1.57"}) {
        EXPECT_EQ(remarks_on_peak(peak),
                  std::vector{fmt::format("a.txt:10: PGA is {} cm/s2, but that of the samples is "
                                          "1.5 cm/s2",
                                          peak)});
    }
}

TEST(Esm, ThatWasNotProcessedMayStateThePeakWithoutTheMean)
{
    const std::string raw = with(sound_esm, "manual (Nobody, 2011)", "none");
    const std::string without_mean = "1.4375"; // -1.5 - (-1.5 + 0.25 + 1) / 4
    EXPECT_EQ(component_of(with(raw, "-1.500000\nBASE", without_mean + "\nBASE")).remarks.size(),
              0);
    EXPECT_EQ(remarks_on_peak(without_mean).size(), 1);
}

TEST(Esm, RemarksOnATimeOfThePeakIfAnotherNumberConfirmsTheTimeStep)
{
    const std::string wrong = with(sound_esm, "USER5: ", "TIME_PGA_S: 0.015");
    EXPECT_EQ(
        component_of(wrong).remarks,
        std::vector<std::string>{"a.txt:14: TIME_PGA_S is 0.015 s, but that of the samples is "
                                 "0.005 s, at 0.005 s per sample"});
    EXPECT_EQ(component_of(with(wrong, "0.015", "0.005")).remarks.size(), 0);
    EXPECT_EQ(refusal_of(with(wrong, "DURATION_S: 0.020\n", "")),
              "a.txt:13: TIME_PGA_S is 0.015 s, but that of the samples is 0.005 s, at 0.005 s per "
              "sample. Give the file as it was published, or correct the wrong one.");
}

// clang-format off
TEST(Esm, IsRefusedWithFileLineAndReason)
{
    expect_refused({
        {"Velocities", with(with(sound_esm, "DATA_TYPE: ACCELERATION", "DATA_TYPE: VELOCITY"), "cm/s^2", "cm/s"),
            "a.txt:12: \"DATA_TYPE: VELOCITY\" does not announce accelerations. Give the file of the acceleration."},
        {"Displacements", with(with(sound_esm, "DATA_TYPE: ACCELERATION\n", ""), "cm/s^2", "cm"),
            "a.txt:8: the unit \"cm\" of the samples is not understood. Understood are g, m/s2, cm/s2, mm/s2, gal and their "
            "usual spellings, such as cm/sec2. Give the file of the acceleration, or the values as text with their "
            "unit."},
        {"Spectra", with(sound_esm, "DATA_TYPE: ACCELERATION", "DATA_TYPE: ACCELERATION RESPONSE SPECTRUM"),
            "a.txt:12: \"DATA_TYPE: ACCELERATION RESPONSE SPECTRU...\" does not announce accelerations. Give the "
            "file of the acceleration."},
        {"NoUnit", with(sound_esm, "UNITS: cm/s^2", "UNITS: "),
            "a.txt:8: the unit \"\" of the samples is not understood. Understood are g, m/s2, cm/s2, mm/s2, gal and their "
            "usual spellings, such as cm/sec2. Give the file of the acceleration, or the values as text with their "
            "unit."},
        {"NoLineOfTheUnit", with(sound_esm, "UNITS: cm/s^2\n", ""),
            "a.txt:13: the header, which ends with this line, has no line that begins with \"UNITS:\". Give the file "
            "as it was published."},
        {"NoTimeStep", with(sound_esm, "SAMPLING_INTERVAL_S: 0.005000\n", ""),
            "a.txt:13: the header, which ends with this line, has no line that begins with \"SAMPLING_INTERVAL_S:\". "
            "Give the file as it was published."},
        {"ATimeStepOfZero", with(sound_esm, "0.005000", "0.000000"),
            "a.txt:4: the time step is 0 s, but must be above 0. Correct it."},
        {"AContradictoryTimeStep", with(sound_esm, "0.005000", "0.020000"),
            "a.txt:6: DURATION_S is 0.020 s, but 4 samples at 0.02 s are 0.08 s. Give the file as it was published, or "
            "correct the wrong one."},
        {"AContradictoryUnit", with(sound_esm, "UNITS: cm/s^2", "UNITS: g"),
            "a.txt:10: PGA is -1.500000 cm/s2, but that of the samples is 1471 cm/s2. Give the file as it was published, "
            "or correct the wrong one."},
        {"AContradictoryPeak", with(sound_esm, "PGA_CM/S^2: -1.500000", "PGA_CM/S^2: -1.60"),
            "a.txt:10: PGA is -1.60 cm/s2, but that of the samples is 1.5 cm/s2. Give the file as it was published, or "
            "correct the wrong one."},
        {"AnUnknownTimeStep", with(sound_esm, "0.005000", "-999"),
            "a.txt:4: the time step is \"-999\", which stands for an unknown number. Give a file that states it."},
        {"TwoTimeSteps", with(sound_esm, "USER5: ", "SAMPLING_INTERVAL_S: 0.01"),
            "a.txt:14: the header states \"SAMPLING_INTERVAL_S:\" for the second time; the first is line 4. Remove one "
            "of them."},
        {"FewerSamples", with(sound_esm, "1.000000\n", ""),
            "a.txt:17: the file ends after 3 samples, but NDATA announces 4 in line 5. Give the complete file."},
        {"MoreSamples", sound_esm + "1.0\n",
            "a.txt:19: \"1.0\" follows the last of the 4 samples that NDATA announces in line 5. Correct NDATA or "
            "remove the rest."},
        {"NoCount", with(sound_esm, "NDATA: 4", "NDATA: "),
            "a.txt:5: NDATA is \"\", but must be an integer from 1 to 10000000. Correct it, or give another record."}});
}
// clang-format on

} // namespace
} // namespace overturn
