#include "formats.hpp"
#include "numbers.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace overturn {

namespace {

constexpr std::size_t header_lines = 26;
constexpr std::size_t most_components = 3;

// Lines of the header, counted from 1, and columns of the numbers, counted from 0.
constexpr std::size_t title_line = 1;
constexpr std::size_t component_line = 13;
constexpr std::size_t peak_line = 14;
constexpr std::size_t counts_line = 20;
constexpr std::size_t first_count = 3; // of acceleration, velocity, displacement
constexpr std::size_t interval_line = 23;
constexpr std::size_t interval = 5;
constexpr Columns columns{.width = 8, .per_line = 10};

void expect_title(const Lines& lines)
{
    if (contains(lines.line(), "uncorrected")) {
        lines.refuse(
            "this is an uncorrected accelerogram (V1A). Give the V2A file of this record.");
    }
    if (!contains(lines.line(), "accelerogram")) {
        lines.refuse(fmt::format("{} is not the first line of a component, such as Corrected "
                                 "accelerogram. Give the file as it was published.",
                                 quoted_bytes(lines.line())));
    }
}

/// The second word of `Component N28W  Longitudinal Accelerometer Axis`.
std::string component_name(const Lines& lines)
{
    const std::size_t place = place_after(lines.line(), "Component");
    if (place == std::string_view::npos) {
        lines.refuse(fmt::format("{} does not name the component. Write it as in Component N28W.",
                                 quoted_bytes(lines.line())));
    }
    const std::string_view name = trimmed(lines.line().substr(place));
    return std::string(name.substr(0, name.find_first_of(" \t")));
}

void expect_unit(const Lines& lines)
{
    if (!contains(lines.line(), "mm/s/s")) {
        lines.refuse(fmt::format("{} does not state the unit mm/s/s. Give the values as text with "
                                 "their unit.",
                                 quoted_bytes(lines.line())));
    }
}

/// Of a quantity whose count is in this column; velocities and displacements may be missing.
Announcement announcement(const Lines& lines, std::size_t column, std::string_view name,
                          std::size_t least)
{
    return {.count = count_of(lines, column_of(lines.line(), columns.width, column),
                              fmt::format("the number of values of {}", name), least),
            .name = name,
            .line = lines.number()};
}

RecordComponent take_component(Lines& lines)
{
    const Lines before = lines;
    Header header;
    header.take(lines, header_lines);
    expect_title(ahead_by(before, title_line));
    expect_unit(ahead_by(before, peak_line));
    const Lines counts = ahead_by(before, counts_line);
    const Lines times = ahead_by(before, interval_line);
    RecordComponent component{
        .name = component_name(ahead_by(before, component_line)),
        .acceleration = {},
        .unit = AccelerationUnit::mm_per_s2,
        .time_step = time_step_of(times, column_of(times.line(), columns.width, interval)),
        .header = std::move(header).kept()};
    component.acceleration =
        take_columns(lines, columns, announcement(counts, first_count, "acceleration", 1));
    take_columns(lines, columns, announcement(counts, first_count + 1, "velocity", 0));
    take_columns(lines, columns, announcement(counts, first_count + 2, "displacement", 0));
    return component;
}

bool is_at_end(Lines lines)
{
    while (lines.next()) {
        if (!trimmed(lines.line()).empty()) {
            return false;
        }
    }
    return true;
}

} // namespace

RecordFile read_v2a(Lines lines)
{
    RecordFile file{.format = "V2A", .components = {}};
    do {
        if (file.components.size() == most_components) {
            lines.next();
            lines.refuse(fmt::format("more text follows the last of the {} components. Remove it.",
                                     most_components));
        }
        file.components.push_back(take_component(lines));
    } while (!is_at_end(lines));
    return file;
}

} // namespace overturn
