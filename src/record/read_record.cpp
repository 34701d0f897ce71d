#include "overturn/record/read_record.hpp"

#include "overturn/record/text_file.hpp"
#include "overturn/text/utf8.hpp"

#include "comment.hpp"
#include "formats.hpp"
#include "numbers.hpp"
#include "stated_unit.hpp"

#include <fmt/ranges.h>

#include <array>
#include <cmath>

namespace overturn {

namespace {

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
    return next_line(
        lines, [](std::string_view line) { return !trimmed(line).empty() && !is_comment(line); });
}

/// Words by which a line of a header shows its format.
struct Mark {
    std::string_view words;
    bool is_at_begin; ///< of a line
    RecordFile (*read)(Lines lines, const RecordOptions& options);
    std::size_t line = 0; ///< the only line that may contain them; 0: any
};

constexpr std::array<Mark, 12> marks{{{"NPTS", false, read_at2, 4},
                                      {"Number of points", true, read_v2a, 10},
                                      {"Origin Time", true, read_knet},
                                      {"Sampling Freq", true, read_knet},
                                      {"Scale Factor", true, read_knet},
                                      {"EVENT_NAME:", true, read_esm},
                                      {"SAMPLING_INTERVAL_S:", true, read_esm},
                                      {"NDATA:", true, read_esm},
                                      {"(Format v", false, read_cosmos},
                                      {"Uncorrected accelerogram", true, read_csmip},
                                      {"equally-spaced intervals of", false, read_csmip},
                                      {"data equally spaced at", false, read_csmip}}};

/// The first mark in the lines that may be a header; null if they have none.
const Mark* first_mark(Lines lines)
{
    constexpr std::size_t most_lines = 100;
    constexpr std::size_t most_characters = 200;
    while (lines.number() < most_lines && lines.next()) {
        const std::string_view line = trimmed(lines.line()).substr(0, most_characters);
        for (const Mark& mark : marks) {
            const std::size_t end = place_after(line, mark.words);
            if (!is_comment(line) && end != std::string_view::npos &&
                (!mark.is_at_begin || end == mark.words.size()) &&
                (mark.line == 0 || mark.line == lines.number())) {
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
                 lines.quoted());
}

/// Reads the samples in the format that the first lines have.
RecordFile read_known_format(const Lines& lines, const RecordOptions& options)
{
    Lines title = lines;
    if (title.next() && is_smc_title(trimmed(title.line()))) {
        return read_smc(lines, options);
    }
    if (const Mark* const mark = first_mark(lines)) {
        return mark->read(lines, options);
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
