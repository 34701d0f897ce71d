#include "overturn/record/read_record.hpp"

#include "overturn/record/text_file.hpp"
#include "overturn/text/utf8.hpp"

#include "formats.hpp"
#include "numbers.hpp"
#include "stated_unit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace overturn {

namespace {

/// How many of a unit are one m/s2; 0 for g.
double units_per_m_per_s2(AccelerationUnit unit)
{
    constexpr std::array<double, acceleration_unit_names.size()> numbers{0, 1, 100, 1000, 100};
    return numbers[std::size_t(unit)];
}

/// Whether a line is like `2 CORRECTED ACCELEROGRAM`: the digit and the name of a kind of data.
bool is_smc_title(std::string_view text)
{
    return text.size() > 1 && '0' <= text[0] && text[0] <= '9' && text[1] == ' ' &&
           (contains(text, "ACCELEROGRAM") || contains(text, "VELOCITY") ||
            contains(text, "DISPLACEMENT") || contains(text, "SPECTR"));
}

/// Proceeds to the first line that is neither blank nor a comment; false if there is none.
bool next_content(Lines& lines)
{
    while (lines.next()) {
        if (!trimmed(lines.line()).empty() && !is_comment(lines.line())) {
            return true;
        }
    }
    return false;
}

/// Words by which a line of a header shows its format.
struct Mark {
    std::string_view words;
    bool is_at_begin; ///< of a line
    RecordFile (*read)(Lines lines);
};

constexpr std::array<Mark, 10> marks{{{"Origin Time", true, read_knet},
                                      {"Sampling Freq", true, read_knet},
                                      {"Scale Factor", true, read_knet},
                                      {"EVENT_NAME:", true, read_esm},
                                      {"SAMPLING_INTERVAL_S:", true, read_esm},
                                      {"NDATA:", true, read_esm},
                                      {"(Format v", false, read_cosmos},
                                      {"Uncorrected accelerogram", true, read_csmip},
                                      {"equally-spaced intervals of", false, read_csmip},
                                      {"data equally spaced at", false, read_csmip}}};

/// The reader of the first mark in the lines that may be a header; null if they have none.
const Mark* first_mark(Lines lines)
{
    constexpr std::size_t most_lines = 100;
    constexpr std::size_t most_characters = 200;
    while (lines.number() < most_lines && lines.next()) {
        const std::string_view line = trimmed(lines.line()).substr(0, most_characters);
        for (const Mark& mark : marks) {
            const std::size_t end = place_after(line, mark.words);
            if (!is_comment(line) && end != std::string_view::npos &&
                (!mark.is_at_begin || end == mark.words.size())) {
                return &mark;
            }
        }
    }
    return nullptr;
}

[[noreturn]] void refuse_format(Lines lines)
{
    if (!next_content(lines)) {
        lines.refuse_file("{}", lines.number() == 0
                                    ? "is empty. Give a file with a recorded motion."
                                    : "has no samples. Give a file with a recorded motion.");
    }
    lines.refuse("{} is not the beginning of a known format: AT2 (NPTS and DT in line 4), V2A, "
                 "SMC, K-NET, KiK-net, COSMOS, CSMIP (volume 2), ESM, or text of one or two "
                 "columns, in which # or % precedes comments. Convert the file to one of these.",
                 quoted_bytes(trimmed(lines.line())));
}

/// Reads the samples in the format that the first lines have.
RecordFile read_known_format(const Lines& lines, const RecordOptions& options)
{
    constexpr std::string_view points = "Number of points";
    for (Lines head = lines; head.next() && head.number() <= 10;) {
        const std::string_view line = trimmed(head.line());
        if (head.number() == 1 && is_smc_title(line)) {
            return read_smc(lines);
        }
        if (head.number() == 4 && contains(line, "NPTS") && !is_comment(line)) {
            return read_at2(lines, options.unit);
        }
        if (head.number() == 10 && place_after(line, points) == points.size()) {
            return read_v2a(lines);
        }
    }
    if (const Mark* const mark = first_mark(lines)) {
        return mark->read(lines);
    }
    Lines data = lines;
    if (next_content(data)) {
        const std::string_view line = trimmed(data.line());
        if (is_number(line.substr(0, line.find_first_of(" \t,")))) {
            return read_text(lines, options);
        }
    }
    refuse_format(lines);
}

/// A comment without its marks, and with plain blanks.
std::string words_of_comment(std::string_view line)
{
    std::string words(line);
    for (const std::string_view blank : {"\u00a0", "\u2009", "\u202f"}) {
        for (std::size_t at = 0; (at = words.find(blank, at)) != words.npos;) {
            words.replace(at, blank.size(), 1, ' ');
        }
    }
    return words.substr(std::min(words.find_first_not_of(" \t#%"), words.size()));
}

/// Refuses a file whose header or comments state another unit than that of its samples, and not
/// this one as well, as "converted from cm/s2, units: g" does.
void expect_no_other_unit(const RecordFile& file, const Lines& lines)
{
    // Comments of a text describe its columns, as in "time [s], acceleration [g]"; the header of a
    // station contains other brackets.
    const bool is_text = file.format == "text";
    const auto places = is_text ? UnitPlaces::comment : UnitPlaces::after_units;
    for (const RecordComponent& component : file.components) {
        const auto is_same = [&](const StatedUnit& stated) {
            return stated.unit &&
                   units_per_m_per_s2(*stated.unit) == units_per_m_per_s2(component.unit);
        };
        std::string refusal;
        bool is_stated = false;
        for (const std::string& line : component.header) {
            const std::string quoted = quoted_bytes(trimmed(line));
            const std::string words = is_text ? words_of_comment(line) : line;
            for (const StatedUnit& stated : stated_units(words, places)) {
                if (is_text && stated.is_time) {
                    lines.refuse_file("the line {} states times in {}. Give times in seconds.",
                                      quoted, stated.text);
                }
                is_stated = is_stated || is_same(stated);
                if (!is_same(stated) && refusal.empty() && (stated.unit || is_text)) {
                    refusal = fmt::format(
                        "the line {} states the unit {}, but {} is {}. Correct one of them.",
                        quoted, quoted_bytes(stated.text),
                        file.has_given_unit ? "the given unit" : "that of the format",
                        name_of(component.unit));
                }
            }
        }
        if (!refusal.empty() && !is_stated) {
            lines.refuse_file("{}", refusal);
        }
    }
}

/// Refuses characters that no text has. A carriage return may only precede the end of a line.
void expect_text(Lines lines)
{
    while (lines.next()) {
        for (const char letter : lines.line()) {
            const auto code = static_cast<unsigned char>(letter);
            if (letter == '\r') {
                lines.refuse(
                    "a carriage return is within the line. Convert line ends to LF or CR LF.");
            }
            if (code < 0x20 && letter != '\t') {
                lines.refuse("the character 0x{:02x} is not text. Give a file of text: a "
                             "published record, or columns.",
                             code);
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

constexpr TextFileKind record_file{"a record", largest_record_file,
                                   "Give the path of a recorded motion.",
                                   "Give one record per file."};

} // namespace

std::vector<double> over_gravity(const RecordComponent& component, double gravity)
{
    std::vector<double> values = component.acceleration;
    if (component.unit != AccelerationUnit::g) {
        const double g = gravity * units_per_m_per_s2(component.unit);
        std::transform(values.begin(), values.end(), values.begin(),
                       [&](double value) { return value / g; });
    }
    return values;
}

RecordFile parse_record(std::string_view text, const std::string& name,
                        const RecordOptions& options)
{
    text = without_byte_order_mark(text);
    if (text.ends_with('\x1a')) { // of DOS files
        text.remove_suffix(1);
    }
    const Lines lines(text, name);
    if (options.time_step && !(*options.time_step > 0 && std::isfinite(*options.time_step))) {
        lines.refuse_file("time_step = {} was given, but must be above 0 and finite. Give the "
                          "seconds between two samples.",
                          *options.time_step);
    }
    expect_text(lines);
    RecordFile file = read_known_format(lines, options);
    for (RecordComponent& component : file.components) {
        component.name = as_utf8(component.name);
    }
    if (file.format != "AT2") { // which may state any unit
        expect_no_other_unit(file, lines);
    }
    if (file.format != "text") { // which states neither
        expect_no_options(file, options, lines);
    }
    return file;
}

RecordFile read_record(const std::string& path, const RecordOptions& options)
{
    return parse_record(text_of_file(path, record_file), path, options);
}

} // namespace overturn
