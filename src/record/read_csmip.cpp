#include "channels.hpp"
#include "formats.hpp"
#include "numbers.hpp"
#include "stated_numbers.hpp"
#include "stated_unit.hpp"

#include <utility>
#include <vector>

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

/// The time step in the line before the accelerations, as printed.
std::string_view step_of(const Lines& announcing)
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
    return step;
}

/// The numbers of the lines of text, which may be missing.
void add_numbers_of_text(Lines header, const Lines& announcing, std::vector<StatedNumber>& stated)
{
    while (header.next() && header.number() < announcing.number()) {
        const std::string_view line = header.line();
        if (contains(line, "points of instrument-")) {
            stated.push_back({Stated::count, header, "the number of points", first_word(line)});
        }
        stated.push_back(
            {Stated::duration, header, "the record length", word_after(line, "Record length")});
        stated.push_back({Stated::time_step, header, "the interval",
                          word_after(line, "equally-spaced intervals of")});
        if (contains(line, "Peak acceleration")) {
            stated.push_back(peak_after(header, "Peak acceleration", "the peak"));
            stated.push_back(
                {Stated::time_of_peak, header, "the time of the peak", word_after(line, " at ")});
        }
    }
}

/// Those of the integers and real numbers between text and samples: 25 lines of text, 7 of integers
/// in columns of 5, and 13 of real numbers in columns of 10. Nothing of a shorter header.
void add_numbers_of_columns(const Lines& header, const Lines& announcing,
                            std::vector<StatedNumber>& stated)
{
    constexpr std::size_t lines_of_text = 25, lines_of_integers = 7, header_lines = 45;
    if (header.number() + header_lines + 1 != announcing.number()) {
        return;
    }
    const auto add = [&](Stated what, std::size_t line, std::size_t width, std::size_t column,
                         std::string_view name, const std::optional<AccelerationUnit>& unit = {}) {
        const Lines at = ahead_by(header, lines_of_text + line);
        stated.push_back({what, at, name, column_of(at.line(), width, column), unit});
    };
    constexpr std::size_t reals = lines_of_integers;
    add(Stated::count, 4, 5, 4, "integer 53, the number of points,");
    add(Stated::duration, reals + 8, 10, 3, "real 60, the record length,");
    add(Stated::time_step, reals + 8, 10, 4, "real 61, the interval,");
    add(Stated::peak, reals + 9, 10, 1, "real 66, the peak,", AccelerationUnit::cm_per_s2);
    add(Stated::time_of_peak, reals + 9, 10, 0, "real 65, the time of the peak,");
}

RecordComponent take_csmip_channel(Lines& lines)
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
    const std::string_view step = step_of(announcing);
    ChannelName name = channel_name(before, announcing.number());
    RecordComponent component{.name = std::move(name.direction),
                              .place = std::move(name.place),
                              .acceleration = take_announced(lines, "acceleration", usual_columns),
                              .unit = unit_of(announcing),
                              .time_step = time_step_of(announcing, step),
                              .header = kept_lines(before, announcing.number())};
    std::vector<StatedNumber> stated;
    add_numbers_of_text(before, announcing, stated);
    add_numbers_of_columns(before, announcing, stated);
    compare(stated, component, announcing, rounding_of(step));
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
        file.components.push_back(take_csmip_channel(lines));
    } while (!is_at_end(lines));
    return file;
}

} // namespace overturn
