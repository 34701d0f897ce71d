#include "overturn/record/read_record.hpp"

#include "overturn/record/text_file.hpp"
#include "overturn/text/utf8.hpp"

#include "comment.hpp"
#include "formats.hpp"
#include "numbers.hpp"
#include "stated_unit.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace overturn {

namespace {

/// Without the end that fills a block of a tape or a disk, or that ends files of DOS: 0x1a or NUL,
/// and then only these, blanks and line ends.
std::string_view without_padding(std::string_view text)
{
    constexpr std::string_view fill("\x1a\0", 2);
    constexpr std::string_view padding("\x1a\0 \t\r\n", 6);
    const std::size_t end = text.find_last_not_of(padding) + 1; // 0 if there is nothing else
    return text.substr(0, text.find_first_of(fill, end));
}

/// Whether a line is like `2 CORRECTED ACCELEROGRAM`: the digit and the name of a kind of data.
bool is_smc_title(std::string_view text)
{
    return text.size() > 1 && '0' <= text[0] && text[0] <= '9' && text[1] == ' ' &&
           (contains(text, "ACCELEROGRAM") || contains(text, "VELOCITY") ||
            contains(text, "DISPLACEMENT") || contains(text, "SPECTR"));
}

using Reader = RecordFile (*)(Lines lines, const RecordOptions& options);

/// Words by which a line of a header shows its format.
struct Mark {
    std::string_view words;
    bool is_at_begin; ///< of a line
    Reader read;
    std::size_t line = 0;       ///< the only line that may contain them; 0: any
    bool needs_another = false; ///< of the same format: other formats have these words too
};

constexpr Mark marks[] = {{"NPTS", false, read_at2, 4},
                          {"Number of points", true, read_v2a, 10, true},
                          {"Component", true, read_v2a, 13, true},
                          {"Acceleration:", true, read_v2a, 14, true},
                          {"Origin Time", true, read_knet, 0, true},
                          {"Sampling Freq", true, read_knet, 0, true},
                          {"Duration Time", true, read_knet, 0, true},
                          {"Dir.", true, read_knet, 0, true},
                          {"Scale Factor", true, read_knet, 0, true},
                          {"EVENT_NAME:", true, read_esm, 0, true},
                          {"SAMPLING_INTERVAL_S:", true, read_esm, 0, true},
                          {"NDATA:", true, read_esm, 0, true},
                          {"(Format v", false, read_cosmos},
                          {"Uncorrected accelerogram", true, read_csmip},
                          {"equally-spaced intervals of", false, read_csmip},
                          {"data equally spaced at", false, read_csmip}};

constexpr std::size_t most_header_lines = 100;

/// As much of a line as a header may have; lines of other files may be long.
std::string_view begin_of(const Lines& lines)
{
    constexpr std::size_t most_characters = 200;
    return trimmed(lines.line()).substr(0, most_characters);
}

bool has_mark(const Lines& lines, const Mark& mark)
{
    const std::string_view line = begin_of(lines);
    const std::size_t end = place_after(line, mark.words);
    return !is_comment(line) && end != line.npos &&
           (!mark.is_at_begin || end == mark.words.size()) &&
           (mark.line == 0 || mark.line == lines.number());
}

/// The reader of the format that the lines which may be a header show; null if they show none.
Reader reader_of_header(Lines lines)
{
    std::vector<Mark> found; // that need another one
    while (lines.number() < most_header_lines && lines.next()) {
        for (const Mark& mark : marks) {
            if (!has_mark(lines, mark)) {
                continue;
            }
            if (!mark.needs_another || std::ranges::any_of(found, [&](const Mark& other) {
                    return other.read == mark.read && other.words != mark.words;
                })) {
                return mark.read;
            }
            found.push_back(mark);
        }
    }
    return nullptr;
}

/// The reader of the format that the first lines have; null if it is not known.
Reader reader_of(const Lines& lines)
{
    Lines title = lines;
    if (title.next() && is_smc_title(trimmed(title.line()))) {
        return read_smc;
    }
    if (const Reader read = reader_of_header(lines)) {
        return read;
    }
    Lines data = lines;
    if (next_content(data)) {
        const std::string_view line = trimmed(data.line());
        if (is_number(line.substr(0, line.find_first_of(" \t,")))) {
            return read_text;
        }
    }
    return nullptr;
}

constexpr std::string_view how_to_convert =
    "AT2 (NPTS and DT in line 4), V2A, SMC, K-NET, KiK-net, COSMOS, CSMIP (volume 2), ESM, or text "
    "of one or two columns, in which # or % precedes comments. Convert the file to one of these.";

/// A format that is not read.
struct UnreadFormat {
    std::string_view words; ///< in its header
    std::string_view name;
    Reader resembled; ///< of the format that its header resembles; null if that of none
};

constexpr UnreadFormat unread_formats[] = {
    {"Station USC#", "USC", nullptr},
    {"points of acc data equally spaced at", "USC", read_csmip},
    {"* VOL1DS FILE", "BHRC (Iran)", nullptr},
    {"#Earthquake Information", "CWB (Taiwan)", read_text}}; // time and three components

/// read: that of the format that the lines seem to have; null if it is not known.
void expect_no_unread_format(Lines lines, Reader read)
{
    Lines row = lines;
    if (read == read_text && next_content(row) && words_of(begin_of(row), " \t,").size() <= 2) {
        return;
    }
    while (lines.number() < most_header_lines && lines.next()) {
        for (const auto& [words, name, resembled] : unread_formats) {
            if ((read == nullptr || read == resembled) && contains(begin_of(lines), words)) {
                lines.refuse("{} shows the format of {}, which is not known. Known formats are {}",
                             lines.quoted(), name, how_to_convert);
            }
        }
    }
}

[[noreturn]] void refuse_format(Lines lines)
{
    if (!next_content(lines)) {
        lines.refuse_file("{}", lines.number() == 0
                                    ? "is empty. Give a file with a recorded motion."
                                    : "has no samples. Give a file with a recorded motion.");
    }
    lines.refuse("{} is not the beginning of a known format: {}", lines.quoted(), how_to_convert);
}

/// Refuses characters that no text has. A carriage return may only precede the end of a line.
/// is_known: whether the file begins in a known format.
void expect_text(Lines lines, bool is_known)
{
    while (lines.next()) {
        for (const char letter : lines.line()) {
            const auto code = static_cast<unsigned char>(letter);
            if (letter == '\r') {
                lines.refuse(
                    "a carriage return is within the line. Convert line ends to LF or CR LF.");
            }
            if (code < 0x20 && letter != '\t') {
                lines.refuse("the character 0x{:02x} is not text{}{}", code,
                             is_known ? ". Give a file of text: a published record, or columns."
                                      : ", and the file does not begin in a known format: ",
                             is_known ? "" : how_to_convert);
            }
        }
    }
}

/// Reads the samples in the format that the first lines have.
RecordFile read_known_format(const Lines& lines, const RecordOptions& options)
{
    const Reader read = reader_of(lines);
    expect_no_unread_format(lines, read);
    expect_text(lines, read != nullptr);
    if (read == nullptr) {
        refuse_format(lines);
    }
    Lines title = lines;
    if (next_content(title) && (contains(begin_of(title), "Fourier amplitude spectra") ||
                                contains(begin_of(title), "Response spectra"))) { // volume 3
        refuse_motion(title);
    }
    return read(lines, options);
}

/// Refuses a header of which a line states another unit than that of the format, as in "units: g".
void expect_no_other_unit(const RecordFile& file, const Lines& lines)
{
    for (const RecordComponent& component : file.components) {
        for (const std::string& line : component.header) {
            for (const char* words : {"units", "units of", "units are"}) {
                const std::string_view name = first_word(text_after(line, words));
                const auto stated = unit_named(name);
                if (stated && units_per_m_per_s2(*stated) != units_per_m_per_s2(component.unit)) {
                    lines.refuse_file("the line {} states the unit {}, but that of the format is "
                                      "{}. Correct one of them.",
                                      quoted_bytes(trimmed(line)), quoted_bytes(name),
                                      name_of(component.unit));
                }
            }
        }
    }
}

/// Refuses options that a file states itself.
void expect_no_options(const RecordFile& file, const RecordOptions& options, const Lines& lines)
{
    const RecordComponent& component = file.components.front();
    if (options.unit && !file.has_given_unit) {
        lines.refuse_file("units = {} was given, but this {} file is in {}. Remove units.",
                          name_of(*options.unit), file.format, name_of(component.unit));
    }
    if (options.time_step) {
        lines.refuse_file(
            "time_step = {} was given, but the {} file states its own, {} s. Remove time_step.",
            *options.time_step, file.format, component.time_step);
    }
}

/// `1 ("360 Deg", Roof: SW)`, or `1` if the component has no name.
std::string component_text(const RecordFile& content, const RecordComponent& component)
{
    std::string text = component.name.empty() ? "" : in_quotes(component.name);
    text += component.place.empty() ? "" : (text.empty() ? "" : ", ") + component.place;
    return fmt::format("{}{}", &component - content.components.data() + 1,
                       text.empty() ? "" : " (" + text + ")");
}

constexpr TextFileKind record_file{"a record", largest_record_file,
                                   "Give the path of a recorded motion.",
                                   "Give one record per file."};

} // namespace

std::vector<double> over_gravity(const RecordComponent& component, double gravity)
{
    const bool is_in_g = component.unit == AccelerationUnit::g;
    const double g = is_in_g ? 1 : gravity * units_per_m_per_s2(component.unit);
    std::vector<double> values = component.acceleration;
    for (double& value : values) {
        value /= g;
    }
    return values;
}

ChosenComponent chosen_component(const RecordFile& content, const ComponentChoice& choice,
                                 const std::string& file)
{
    std::vector<const RecordComponent*> meant;
    std::vector<std::string> all;
    for (const RecordComponent& component : content.components) {
        const auto* const name = std::get_if<std::string>(&choice);
        all.push_back(component_text(content, component));
        if (name != nullptr ? *name == component.name
                            : std::get<std::int64_t>(choice) == std::int64_t(all.size())) {
            meant.push_back(&component);
        }
    }
    if (meant.size() == 1) {
        return {meant.front(), false, ""};
    }
    const bool is_ambiguous = !meant.empty();
    return {nullptr, is_ambiguous,
            fmt::format("is {} of {}. It has the components {}.{}",
                        is_ambiguous ? fmt::format("the name of {} components", meant.size())
                                     : std::string("not a component"),
                        in_quotes(file), fmt::join(all, ", "),
                        is_ambiguous ? " Give the number of one." : "")};
}

RecordFile parse_record(std::string_view text, const std::string& name,
                        const RecordOptions& options)
{
    const Lines lines(without_padding(without_byte_order_mark(text)), name);
    if (options.time_step && !(*options.time_step > 0 && std::isfinite(*options.time_step))) {
        lines.refuse_file("time_step = {} was given, but must be above 0 and finite. Give the "
                          "seconds between two samples.",
                          *options.time_step);
    }
    RecordFile file = read_known_format(lines, options);
    for (RecordComponent& component : file.components) {
        component.name = as_utf8(component.name);
        component.place = as_utf8(component.place);
    }
    if (file.format != "text") { // which states neither unit nor time step
        expect_no_options(file, options, lines);
    }
    if (file.format != "text" && file.format != "AT2") { // which may state any unit
        expect_no_other_unit(file, lines);
    }
    return file;
}

RecordFile read_record(const std::string& path, const RecordOptions& options)
{
    return parse_record(text_of_file(path, record_file), path, options);
}

} // namespace overturn
