#include "overturn/record/read_record.hpp"

#include "overturn/record/text_file.hpp"
#include "overturn/text/utf8.hpp"

#include "formats.hpp"
#include "numbers.hpp"
#include "stated_unit.hpp"
#include "unit_spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

namespace overturn {

namespace {

/// How many of a unit are one m/s2; 0 for g.
double units_per_m_per_s2(AccelerationUnit unit)
{
    constexpr std::array<double, acceleration_unit_names.size()> numbers{0, 1, 100, 1000, 100};
    return numbers[std::size_t(unit)];
}

enum class Format { at2, v2a, smc, text, unknown };

constexpr std::size_t at2_sampling_line = 4;
constexpr std::size_t v2a_count_line = 10;

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

Format format_of(const Lines& lines)
{
    constexpr std::string_view points = "Number of points";
    for (Lines head = lines; head.next() && head.number() <= v2a_count_line;) {
        const std::string_view line = trimmed(head.line());
        if (head.number() == 1 && is_smc_title(line)) {
            return Format::smc;
        }
        if (head.number() == at2_sampling_line && contains(line, "NPTS") && !is_comment(line)) {
            return Format::at2;
        }
        if (head.number() == v2a_count_line && place_after(line, points) == points.size()) {
            return Format::v2a;
        }
    }
    Lines data = lines;
    if (next_content(data)) {
        const std::string_view line = trimmed(data.line());
        if (is_number(line.substr(0, line.find_first_of(" \t,")))) {
            return Format::text;
        }
    }
    return Format::unknown;
}

/// Refuses a file whose header or comments state another unit than that of its samples, and not
/// this one as well, as "converted from cm/s2, units: g" does.
void expect_no_other_unit(const RecordFile& file, const std::string& name)
{
    // Comments of a text describe its columns, as in "time [s], acceleration [g]"; the header of a
    // station contains other brackets.
    const bool is_text = file.format == "text";
    const auto places = is_text ? UnitPlaces::title : UnitPlaces::after_units;
    for (const RecordComponent& component : file.components) {
        std::optional<std::pair<StatedUnit, std::string>> other;
        bool is_stated = false;
        for (const std::string& line : component.header) {
            for (const StatedUnit& stated : stated_units(line, places)) {
                if (is_text && is_time(simplified(stated.text))) {
                    refuse_record(name, fmt::format("the line {} states times in {}. Give times in "
                                                    "seconds.",
                                                    quoted_bytes(trimmed(std::string_view(line))),
                                                    stated.text));
                }
                const bool is_same = stated.unit && units_per_m_per_s2(*stated.unit) ==
                                                        units_per_m_per_s2(component.unit);
                is_stated = is_stated || is_same;
                if (!is_same && !other && (stated.unit || is_text)) {
                    other = {stated, line};
                }
            }
        }
        if (other && !is_stated) {
            refuse_record(
                name, fmt::format("the line {} states the unit {}, but {} is {}. Correct one of "
                                  "them.",
                                  quoted_bytes(trimmed(std::string_view(other->second))),
                                  quoted_bytes(std::string_view(other->first.text)),
                                  file.has_given_unit ? "the given unit" : "that of the format",
                                  name_of(component.unit)));
        }
    }
}

/// Refuses characters that no text has. A carriage return may only precede the end of a line.
void expect_text(std::string_view text, const std::string& name)
{
    const auto is_allowed = [&](const char& letter) {
        const auto code = static_cast<unsigned char>(letter);
        const std::size_t next = std::size_t(&letter - text.data()) + 1;
        return code >= 0x20 || letter == '\t' || letter == '\n' ||
               (letter == '\r' &&
                (next == text.size() || text[next] == '\n' || text[next] == '\r'));
    };
    const auto found = std::find_if_not(text.begin(), text.end(), is_allowed);
    if (found == text.end()) {
        return;
    }
    Lines lines(text, name);
    for (auto ends = std::count(text.begin(), found, '\n'); ends >= 0; --ends) {
        lines.next();
    }
    if (*found == '\r') {
        lines.refuse("a carriage return is within the line. Convert line ends to LF or CR LF.");
    }
    lines.refuse(fmt::format("the character 0x{:02x} is not text. Give a file of text: AT2, V2A, "
                             "SMC or columns.",
                             static_cast<unsigned char>(*found)));
}

void expect_valid(const RecordOptions& options, const std::string& name)
{
    if (options.time_step && !(*options.time_step > 0 && std::isfinite(*options.time_step))) {
        refuse_record(name, fmt::format("time_step = {} was given, but must be above 0 and finite. "
                                        "Give the seconds between two samples.",
                                        *options.time_step));
    }
}

/// The text without the byte-order mark of UTF-8 and without the character that ends DOS files.
std::string_view without_marks(std::string_view text)
{
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (text.starts_with(byte_order_mark)) {
        text.remove_prefix(byte_order_mark.size());
    }
    if (text.ends_with('\x1a')) {
        text.remove_suffix(1);
    }
    return text;
}

RecordFile read_text_with_unit(const Lines& lines, const std::string& name,
                               const RecordOptions& options)
{
    if (!options.unit) {
        refuse_record(
            name,
            fmt::format("files in text format do not state the unit of the accelerations. Give "
                        "one of {}: {}.",
                        fmt::join(acceleration_unit_names, ", "), how_to_state("units")));
    }
    return read_text(lines, options);
}

[[noreturn]] void refuse_format(Lines lines, const std::string& name)
{
    if (!next_content(lines)) {
        refuse_record(name, lines.number() == 0
                                ? "is empty. Give a file with a recorded motion."
                                : "has no samples. Give a file with a recorded motion.");
    }
    lines.refuse(fmt::format(
        "{} is not the beginning of a known format: AT2 (NPTS and DT in line 4), V2A, SMC, or "
        "text of one or two columns, in which # or % precedes comments. "
        "Convert the file to one of these.",
        quoted_bytes(trimmed(lines.line()))));
}

/// Refuses options that a file states itself.
void expect_no_options(const RecordFile& file, const RecordOptions& options,
                       const std::string& name)
{
    const RecordComponent& component = file.components.front();
    if (options.unit && !file.has_given_unit) {
        refuse_record(name,
                      fmt::format("units = {} was given, but this {} file is in {}. Remove units.",
                                  name_of(*options.unit), file.format, name_of(component.unit)));
    }
    if (options.time_step) {
        refuse_record(name,
                      fmt::format("time_step = {} was given, but the {} file states its own, {} s. "
                                  "Remove time_step.",
                                  *options.time_step, file.format, component.time_step));
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
    expect_valid(options, name);
    text = without_marks(text);
    expect_text(text, name);
    const Lines lines(text, name);
    RecordFile file;
    switch (format_of(lines)) {
    case Format::at2: file = read_at2(lines, options.unit); break;
    case Format::v2a: file = read_v2a(lines); break;
    case Format::smc: file = read_smc(lines); break;
    case Format::text: file = read_text_with_unit(lines, name, options); break;
    case Format::unknown: refuse_format(lines, name);
    }
    for (RecordComponent& component : file.components) {
        component.name = as_utf8(component.name);
    }
    if (file.format != "AT2") { // which may state any unit
        expect_no_other_unit(file, name);
    }
    if (file.format != "text") { // which states neither
        expect_no_options(file, options, name);
    }
    return file;
}

RecordFile read_record(const std::string& path, const RecordOptions& options)
{
    return parse_record(text_of_file(path, record_file), path, options);
}

} // namespace overturn
