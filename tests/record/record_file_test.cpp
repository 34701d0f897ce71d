// What holds for files of every format, and for files of none.
#include "reading.hpp"

#include "support/scratch_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <clocale>
#include <filesystem>
#include <locale>
#include <random>

namespace overturn {
namespace {

std::string refusal_of_file(const std::string& path)
{
    return refusal(exit_code::job, [&] { read_record(path, in_g); });
}

TEST(UnitNames, AreInTheOrderOfTheUnits)
{
    EXPECT_EQ(name_of(AccelerationUnit::g), "g");
    EXPECT_EQ(name_of(AccelerationUnit::m_per_s2), "m/s2");
    EXPECT_EQ(name_of(AccelerationUnit::cm_per_s2), "cm/s2");
    EXPECT_EQ(name_of(AccelerationUnit::mm_per_s2), "mm/s2");
}

/// A file of components with these names.
RecordFile file_of(const std::vector<std::string>& names)
{
    RecordFile file{.format = "CSMIP", .components = {}};
    for (const std::string& name : names) {
        file.components.push_back({.name = name, .acceleration = {0}, .header = {}});
    }
    return file;
}

TEST(AComponent, IsChosenByItsNumberOrByANameThatNoOtherOneHas)
{
    std::mt19937 random(1);
    for (int i = 0; i < 50; ++i) {
        std::vector<std::string> names;
        for (std::size_t j = 0; j < 1 + random() % 6; ++j) {
            names.push_back(std::array{"Up", "360 Deg", "90 Deg", ""}[random() % 4]);
        }
        const RecordFile file = file_of(names);
        for (std::size_t j = 0; j < names.size(); ++j) {
            EXPECT_EQ(chosen_component(file, std::int64_t(j + 1), "a.V2").component,
                      &file.components[j]);
            const ChosenComponent named = chosen_component(file, names[j], "a.V2");
            const bool is_unique = std::ranges::count(names, names[j]) == 1;
            EXPECT_EQ(named.component, is_unique ? &file.components[j] : nullptr);
            EXPECT_EQ(named.is_ambiguous, !is_unique);
        }
    }
}

TEST(AComponent, OfANameThatSeveralHaveIsRefusedWithAListOfAll)
{
    RecordFile file = file_of({"360 Deg", "Up", "360 Deg", ""});
    file.components[0].place = "Roof: SW";
    file.components[3].place = "Ground";
    const std::string all = "It has the components 1 (\"360 Deg\", Roof: SW), 2 (\"Up\"), 3 (\"360 "
                            "Deg\"), 4 (Ground).";
    EXPECT_EQ(chosen_component(file, "360 Deg", "a.V2").refusal,
              "is the name of 2 components of \"a.V2\". " + all + " Give the number of one.");
    EXPECT_EQ(chosen_component(file, "90 Deg", "a.V2").refusal,
              "is not a component of \"a.V2\". " + all);
    EXPECT_EQ(chosen_component(file, std::int64_t(5), "a.V2").refusal,
              "is not a component of \"a.V2\". " + all);
}

TEST(RecordFile, IsReadFromItsPath)
{
    const ScratchFolder folder;
    write_bytes(folder / "a.txt", "0 1\n1 2\n");
    EXPECT_EQ(read_record(folder / "a.txt", in_g).components.at(0).acceleration, (Values{1, 2}));
}

TEST(RecordFile, IsRecognisedFromItsContentWhateverItsName)
{
    const ScratchFolder folder;
    write_bytes(folder / "a.V2A", "0 1\n1 2\n");
    EXPECT_EQ(read_record(folder / "a.V2A", in_g).format, "text");
}

TEST(RecordFile, IsNamedInItsRefusal)
{
    const ScratchFolder folder;
    write_bytes(folder / "a.txt", "0 1\n1 x\n");
    EXPECT_EQ(refusal_of_file(folder / "a.txt"),
              folder / "a.txt" +
                  ":2: \"x\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01.");
}

TEST(RecordFile, IsRefusedIfItIsMissing)
{
    const ScratchFolder folder;
    EXPECT_EQ(
        refusal_of_file(folder / "none"),
        folder / "none" +
            ": cannot be read: No such file or directory. Give the path of a recorded motion.");
}

TEST(RecordFile, IsRefusedIfItIsAFolder)
{
    const ScratchFolder folder;
    EXPECT_EQ(refusal_of_file(folder / ""),
              folder / "" +
                  ": cannot be read: Is a directory. Give the path of a recorded motion.");
}

TEST(RecordFile, IsRefusedBeforeItIsReadIfItIsTooLarge)
{
    const ScratchFolder folder;
    write_bytes(folder / "a.txt", "1\n");
    std::filesystem::resize_file(folder / "a.txt", largest_record_file + 1); // sparse
    EXPECT_EQ(refusal_of_file(folder / "a.txt"),
              folder / "a.txt" +
                  ": is larger than 1024 MiB, the maximum size of a record. Give one record per "
                  "file.");
}

TEST(RecordText, IsRefusedIfItIsEmpty)
{
    EXPECT_EQ(refusal_of(""), "a.txt: is empty. Give a file with a recorded motion.");
}

TEST(RecordText, IsRefusedIfItHasNoSamples)
{
    for (const char* text : {"\n \n", "# a comment\n", "\xef\xbb\xbf\n\x1a"}) {
        EXPECT_EQ(refusal_of(text), "a.txt: has no samples. Give a file with a recorded motion.");
    }
}

const std::string known_formats =
    "AT2 (NPTS and DT in line 4), V2A, SMC, K-NET, KiK-net, COSMOS, CSMIP (volume 2), ESM, or text "
    "of one or two columns, in which # or % precedes comments. Convert the file to one of these.";

TEST(RecordText, IsRefusedIfItsFormatIsUnknown)
{
    EXPECT_EQ(refusal_of("# a\n\nEVENT: none\nSTATION: none\n"),
              "a.txt:3: \"EVENT: none\" is not the beginning of a known format: " + known_formats);
}

TEST(RecordText, OfAnotherNetworkIsRefusedWithTheKnownFormats)
{
    const std::vector<std::pair<const char*, std::string>> headers{
        {"AFAD",
         "STRONG GROUND MOTION RECORDS OF TURKIYE\nPLACE : NOWHERE\nSTATION ALTITUDE (m) : 1\n"
         "NUMBER OF DATA : 2\nSAMPLING INTERVAL (sec) : 0.01\n  N-S  E-W  U-D\n 0.1 0.2 0.3\n"},
        {"UNAM", "================\nARCHIVO ESTANDAR DE ACELERACION\nDURACION DEL REGISTRO (s) : "
                 "2\n 1 2 3\n"},
        {"JMA", "SITE CODE= 1NOWHERE\n LAT.= 35.0\nSAMPLING RATE= 100Hz\nUNIT  = gal(cm/s/s)\n"
                "NS,EW,UD\n0.1,0.2,0.3\n"},
        {"GeoCSV", "# dataset: GeoCSV 2.0\n# sample_rate_hz: 100\n# field_unit: UTC, M/S**2\n"
                   "Time, Sample\n2020-01-01T00:00:00Z, 1\n"},
        {"TSPAIR", "TIMESERIES XX_ABC__HNE_D, 2 samples, 100 sps, TSPAIR, FLOAT, M/S**2\n"
                   "2020-01-01T00:00:00.000000  0.1\n"},
        {"AColumnWithAName", "time,acc\n0.0,0.1\n0.1,0.2\n"},
        {"Json", "{\"dt\": 0.01, \"acceleration\": [0.1, 0.2]}\n"},
        {"Xml", "<?xml version=\"1.0\"?>\n<record dt=\"0.01\">0.1 0.2</record>\n"},
        {"OnlyAnOriginTime", "Name = A\nOrigin Time : 2012/08/11   12:23:16\nNo unit\n 0.1 0.2\n"},
        {"OnlyAScaleFactor", "Station A\nScale Factor: 2\n0.1\n0.2\n"},
        {"OnlyADirection", "Station A\nDir. N\n0.1\n0.2\n"},
        {"OnlyANameOfTheEvent", "EVENT_NAME: NOWHERE\nRATE: 100\n0.1\n0.2\n"},
        {"OnlyACount", "STATION: A\nNDATA: 2\nRATE: 100\n0.1\n0.2\n"},
        {"ANumberOfPointsInLineTen",
         std::string("Station A\n") + std::string(8, '\n') + "Number of points: 2\n0.1\n"}};
    for (const auto& [name, text] : headers) {
        for (const char* end : {"\n", "\r\n"}) {
            EXPECT_THAT(
                refusal_of(with_line_ends(text, end)),
                testing::EndsWith("is not the beginning of a known format: " + known_formats))
                << name;
        }
    }
}

TEST(RecordText, OfANetworkWhoseHeaderResemblesAKnownOneIsRefusedWithTheKnownFormats)
{
    const std::string usc_2 =
        "CORRECTED ACCELEROGRAM  IIAB001  90.000.0 COMP N00E   FILE   0  CORRESPONDING T \n"
        "FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:                        \n"
        "NOWHERE EARTHQUAKE\nSTATION USC# 0000   34 00 00N, 118 00 00W\n"
        "UNITS ARE SEC AND G/10\nAT EQUALLY-SPACED INTERVALS OF    .020  SEC.\n"
        "   2 POINTS OF ACC DATA EQUALLY SPACED AT   .020 SEC.  IN UNITS CM/SEC/SEC\n"
        "    -1.133    -1.152\n";
    const std::string usc_1 = "FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:\n"
                              "STATION USC# 0000   34 00 00N, 118 00 00W\n .0 .1 .0 .2\n";
    const std::string bhrc = "* VOL1DS FILE:  0000/01\nInst Type = SSA-2\n"
                             "Origin Time : 2012/08/11   12:23:16\n\nL\n\nCOMP L1\n"
                             "NO. OF POINTS =  2      DURATION =  .005\n"
                             "UNITS ARE SECONDS AND G/10\n  .457339E-03  .457339E-03\n";
    const std::string cwb =
        "#Earthquake Information\n#Origin Time(GMT+08): 2018/02/06-23:50:42\n#Depth(km): 10.0\n"
        "#SampleRate(Hz): 50\n#AmplitudeUnit:  gal. DCoffset(corr)\n"
        "#DataSequence: Time U(+); N(+); E(+)\n#Data: 4F10.3\n"
        "     0.000     0.000     0.000     0.000\n     0.020     0.001     0.002     0.003\n";
    const std::vector<std::pair<const char*, std::string>> files{
        {"USC", usc_2},
        {"USC", with(usc_2, "STATION USC# 0000", "STATION 0")},
        {"USC", usc_1},
        {"BHRC (Iran)", bhrc},
        {"CWB (Taiwan)", cwb}};
    for (const auto& [name, text] : files) {
        for (const RecordOptions& options :
             {RecordOptions{}, in_g,
              RecordOptions{.time_step = {}, .unit = AccelerationUnit::gal}}) {
            EXPECT_THAT(
                refusal_of(text, options),
                testing::EndsWith(fmt::format(" shows the format of {}, which is not known. "
                                              "Known formats are {}",
                                              name, known_formats)));
        }
    }
}

TEST(RecordText, OfTwoColumnsMayHaveTheCommentsOfAFormatThatIsNotKnown)
{
    for (const char* comment :
         {"#Earthquake Information", "# STATION USC# 0000", "# * VOL1DS FILE:  0000/01"}) {
        EXPECT_EQ(component_of(std::string(comment) + "\n0.0 1\n0.1 2\n", in_g).acceleration,
                  (Values{1, 2}));
    }
}

TEST(RecordText, OfSpectraIsRefused)
{
    EXPECT_EQ(refusal_of("Response and Fourier amplitude spectra (86 periods)   for\n"
                         "Corrected accelerogram   0.XX.ABC.--.HN    Chan  1:  90 Deg     from\n"
                         "Uncorrected Accelerogram Data             Processed: 04/30/14\n"),
              "a.txt:1: \"Response and Fourier amplitude spectra (...\" does not announce "
              "accelerations. Give the file of the acceleration.");
}

TEST(RecordText, IsRefusedIfItIsBinary)
{
    const auto message = [](int line, const char* code) {
        return fmt::format("a.txt:{}: the character {} is not text, and the file does not begin in "
                           "a known format: {}",
                           line, code, known_formats);
    };
    EXPECT_EQ(refusal_of(std::string("\x89HDF\r\n\x1a\n\0\0\1", 11)), message(2, "0x1a"));
    EXPECT_EQ(refusal_of(std::string("000001D \0\1", 10)), message(1, "0x00"));    // miniSEED
    EXPECT_EQ(refusal_of(std::string("\0\xe4\x40\xc6\1", 5)), message(1, "0x00")); // SAC
    EXPECT_EQ(refusal_of("PK\3\4"), message(1, "0x03"));                           // ZIP
    EXPECT_EQ(refusal_of("\x1f\x8b\x08"), message(1, "0x1f"));                     // gzip
    EXPECT_EQ(refusal_of(std::string("\xff\xfe\x31\0\x0a\0\x32\0", 8)),
              message(1, "0x00")); // UTF-16
}

TEST(RecordText, IsRefusedIfItContainsABinaryCharacter)
{
    EXPECT_EQ(refusal_of(std::string("0 1\n1\0 2\n", 9), in_g),
              "a.txt:2: the character 0x00 is not text. Give a file of text: a published record, "
              "or columns.");
}

TEST(RecordText, IsRefusedIfItsLinesEndWithCarriageReturnsOnly)
{
    EXPECT_EQ(refusal_of("1\r2\r"),
              "a.txt:1: a carriage return is within the line. Convert line ends to LF or CR LF.");
}

struct DecimalComma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
};

TEST(RecordText, HasThePointAsDecimalMarkInAnyLocale)
{
    const std::locale before = std::locale::global(std::locale(std::locale(), new DecimalComma));
    const bool is_c_locale_set = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
    const RecordComponent component = component_of("0.5 1.5\n1.0 -2.5\n", in_g);
    const std::string refusal = refusal_of("1\n", {.time_step = -0.5, .unit = {}});
    std::locale::global(before);
    EXPECT_TRUE(!is_c_locale_set || std::setlocale(LC_ALL, "C") != nullptr);
    EXPECT_EQ(component.acceleration, (Values{1.5, -2.5}));
    EXPECT_EQ(component.time_step, 0.5);
    EXPECT_NE(refusal.find("-0.5"), refusal.npos) << refusal;
}

} // namespace
} // namespace overturn
