#include "channels.hpp"
#include "formats.hpp"
#include "numbers.hpp"
#include "stated_unit.hpp"

namespace overturn {

namespace {

// Follows the number of points in the line before the values of each quantity.
constexpr std::string_view marks_values = "data equally spaced at";

// Of files that state none.
constexpr Columns usual_columns{.width = 10, .per_line = 8, .decimals = 3};

/// `in cm/sec2. (8f10.6)` or `(UNITS: CM/SEC/SEC)`
AccelerationUnit unit_of(const Lines& lines)
{
    const std::string_view name = text_after(lines.line(), "units");
    return unit_of_samples(lines, name.empty() ? text_after(lines.line(), " in ") : name);
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

RecordComponent take_channel(Lines& lines)
{
    const Lines before = lines;
    if (!next_with(lines, marks_values)) {
        lines.refuse("the channel that begins in line {} has no line such as 7500 points of accel "
                     "data equally spaced at .010 sec, in cm/sec2. (8f10.6). Give the complete "
                     "file of volume 2.",
                     before.number() + 1);
    }
    if (!contains(lines.line(), "accel")) {
        refuse_motion(lines);
    }
    const Lines announcing = lines;
    RecordComponent component{.name = channel_name(before, announcing.number()),
                              .acceleration = take_announced(lines, "acceleration", usual_columns),
                              .unit = unit_of(announcing),
                              .time_step = step_of_channel(before, announcing),
                              .header = kept_lines(before, announcing.number())};
    for (Lines ahead = lines; next_text(ahead) && contains(ahead.line(), marks_values);) {
        take_announced(ahead, "velocity or displacement", usual_columns);
        lines = ahead;
    }
    if (Lines ahead = lines; next_text(ahead) && trimmed(ahead.line()).starts_with("/&")) {
        lines = ahead;
    }
    return component;
}

} // namespace

RecordFile read_csmip(Lines lines, const RecordOptions&)
{
    RecordFile file{.format = "CSMIP", .components = {}};
    do {
        Lines title = lines;
        next_text(title);
        expect_corrected_accelerogram(title);
        file.components.push_back(take_channel(lines));
    } while (!is_at_end(lines));
    return file;
}

} // namespace overturn
