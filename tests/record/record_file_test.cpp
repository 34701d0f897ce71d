// What holds for files of every format, and for files of none.
#include "reading.hpp"

#include "support/scratch_folder.hpp"

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

TEST(RecordText, IsRefusedIfItsFormatIsUnknown)
{
    EXPECT_EQ(refusal_of("# a\n\nEVENT: none\nSTATION: none\n"),
              "a.txt:3: \"EVENT: none\" is not the beginning of a known format: AT2 (NPTS and "
              "DT in line 4), V2A, SMC, K-NET, KiK-net, COSMOS, CSMIP (volume 2), ESM, or text of "
              "one or two columns, in which # or % precedes comments. Convert "
              "the file to one of these.");
}

TEST(RecordText, IsRefusedIfItIsBinary)
{
    EXPECT_EQ(refusal_of(std::string("\x89HDF\r\n\x1a\n\0\0", 10)),
              "a.txt:2: the character 0x1a is not text. Give a file of text: a published record, "
              "or columns.");
    EXPECT_EQ(refusal_of(std::string("1\0", 2)),
              "a.txt:1: the character 0x00 is not text. Give a file of text: a published record, "
              "or columns.");
    EXPECT_EQ(refusal_of(std::string("\xff\xfe\x31\0\x0a\0", 6)), // UTF-16
              "a.txt:1: the character 0x00 is not text. Give a file of text: a published record, "
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
