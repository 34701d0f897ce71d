#include "channel_name.hpp"
#include "formats.hpp"
#include "fortran_format.hpp"
#include "numbers.hpp"
#include "stated_unit.hpp"

#include <utility>

namespace overturn {

namespace {

// Follows the number of points in the line before the values of each quantity.
constexpr std::string_view marks_values = "data equally spaced at";

// Of files that state none.
constexpr Columns usual_columns{.width = 10, .per_line = 8, .decimals = 3};

AccelerationUnit unit_of(const Lines& lines)
{
    const auto stated = stated_units(lines.line(), UnitPlaces::title);
    if (stated.size() != 1 || !stated.front().unit) {
        lines.refuse("the unit {} of the samples is not understood; cm/sec2 is, for example. Give "
                     "the values as text with their unit.",
                     quoted_bytes(stated.empty() ? "" : stated.front().text));
    }
    return *stated.front().unit;
}

/// The time step in the line before the accelerations. Refuses another one in the header.
double step_of_channel(Lines header, const Lines& announcing)
{
    const std::string_view after =
        trimmed(announcing.line().substr(place_after(announcing.line(), marks_values)));
    const std::string_view step = first_word(after);
    const std::string_view unit = first_word(after.substr(step.size()));
    if (!lower(unit).starts_with("sec")) {
        announcing.refuse("the time step {} is followed by {}, but must be in seconds, as in .010 "
                          "sec. Correct it.",
                          quoted_bytes(step), quoted_bytes(unit));
    }
    const double time_step = time_step_of(announcing, step);
    while (header.number() < announcing.number() && header.next()) {
        const std::size_t place = place_after(header.line(), "equally-spaced intervals of");
        const std::string_view other =
            place == step.npos ? step : first_word(header.line().substr(place));
        if (number_of(header, other) != time_step) {
            header.refuse("the time step {} s contradicts that of line {}, {} s. Correct one of "
                          "them.",
                          other, announcing.number(), step);
        }
    }
    return time_step;
}

/// The values that the current line announces.
std::vector<double> take_values(Lines& lines, std::string_view name)
{
    const Announcement announced{
        .count = count_of(lines, first_word(lines.line()), "the number of points"),
        .name = name,
        .line = lines.number()};
    const Columns columns = columns_of_format(lines.line()).value_or(usual_columns);
    return take_columns(lines, columns, announced);
}

RecordComponent take_channel(Lines& lines)
{
    const Lines before = lines;
    Header header;
    if (!header.take_through(lines, marks_values)) {
        lines.refuse("the channel that begins in line {} has no line such as 7500 points of accel "
                     "data equally spaced at .010 sec, in cm/sec2. (8f10.6). Give the complete "
                     "file of volume 2.",
                     before.number() + 1);
    }
    if (!contains(lines.line(), "accel")) {
        lines.refuse("{} does not announce accelerations. Give the file of volume 2 that contains "
                     "them.",
                     quoted_bytes(trimmed(lines.line())));
    }
    const AccelerationUnit unit = unit_of(lines);
    const double time_step = step_of_channel(before, lines);
    RecordComponent component{.name = channel_name(before, lines.number()),
                              .acceleration = take_values(lines, "acceleration"),
                              .unit = unit,
                              .time_step = time_step,
                              .header = std::move(header).kept()};
    for (Lines ahead = lines; next_text(ahead) && contains(ahead.line(), marks_values);) {
        lines = ahead; // velocity and displacement
        take_values(lines, "velocity or displacement");
        ahead = lines;
    }
    if (Lines ahead = lines; next_text(ahead) && trimmed(ahead.line()).starts_with("/&")) {
        lines = ahead;
    }
    return component;
}

/// Refuses the end of a channel that was not expected, such as further samples.
void expect_title(Lines lines)
{
    next_text(lines);
    if (contains(lines.line(), "uncorrected")) {
        lines.refuse("this is an uncorrected accelerogram (volume 1). Give the file of volume 2.");
    }
    if (!contains(lines.line(), "accelerogram")) {
        lines.refuse("{} is not the first line of a channel, such as Corrected accelerogram. Give "
                     "the file as it was published.",
                     quoted_bytes(trimmed(lines.line())));
    }
}

} // namespace

RecordFile read_csmip(Lines lines)
{
    RecordFile file{.format = "CSMIP", .components = {}};
    do {
        expect_title(lines);
        file.components.push_back(take_channel(lines));
    } while (!is_at_end(lines));
    return file;
}

} // namespace overturn
