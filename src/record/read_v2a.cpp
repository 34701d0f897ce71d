#include "channels.hpp"
#include "formats.hpp"
#include "numbers.hpp"

#include <string>

namespace overturn {

namespace {

constexpr std::size_t header_lines = 26;
constexpr std::size_t most_components = 3;
constexpr Columns columns{.width = 8, .per_line = 10};

/// The second word of `Component N28W  Longitudinal Accelerometer Axis`.
std::string component_name(const Lines& lines)
{
    const std::size_t place = place_after(lines.line(), "Component");
    if (place == std::string_view::npos) {
        lines.refuse("{} does not name the component. Write it as in Component N28W.",
                     lines.quoted());
    }
    return std::string(first_word(lines.line().substr(place)));
}

void expect_unit(const Lines& lines)
{
    if (!contains(lines.line(), "mm/s/s")) {
        lines.refuse("{} does not state the unit mm/s/s. Give the values as text with their unit.",
                     lines.quoted());
    }
}

RecordComponent take_component(Lines& lines)
{
    const Lines before = lines;
    lines = ahead_by(lines, header_lines);
    expect_corrected_accelerogram(ahead_by(before, 1));
    expect_unit(ahead_by(before, 14));
    const Lines times = ahead_by(before, 23);
    RecordComponent component{.name = component_name(ahead_by(before, 13)),
                              .acceleration = {},
                              .unit = AccelerationUnit::mm_per_s2,
                              .time_step =
                                  time_step_of(times, column_of(times.line(), columns.width, 5)),
                              .header = kept_lines(before, lines.number())};
    const Lines counts = ahead_by(before, 20);
    // The values of a quantity whose count is in this column.
    const auto take = [&](std::size_t column, std::string_view name, std::size_t least) {
        const std::size_t count = count_of(counts, column_of(counts.line(), columns.width, column),
                                           fmt::format("the number of values of {}", name), least);
        return take_columns(lines, columns, {count, name, counts.number()});
    };
    component.acceleration = take(3, "acceleration", 1);
    take(4, "velocity", 0); // which may be missing, like the displacement
    take(5, "displacement", 0);
    return component;
}

} // namespace

RecordFile read_v2a(Lines lines, const RecordOptions&)
{
    RecordFile file{.format = "V2A", .components = {}};
    do {
        if (file.components.size() == most_components) {
            lines.next();
            lines.refuse("more text follows the last of the {} components. Remove it.",
                         most_components);
        }
        file.components.push_back(take_component(lines));
    } while (!is_at_end(lines));
    return file;
}

} // namespace overturn
