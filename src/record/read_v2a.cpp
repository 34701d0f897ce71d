#include "channels.hpp"
#include "formats.hpp"
#include "numbers.hpp"
#include "stated_numbers.hpp"

#include <string>

namespace overturn {

namespace {

constexpr std::size_t v2a_header_lines = 26;
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

/// The numbers of `Number of points  8192    Duration 163.82 sec`, `Instrument corrected data at
/// 0.020 sec intervals`, `Acceleration:  peak  -9733.1 mm/s/s at  44.88 sec     rms    719.0
/// mm/s/s`, and of columns. before: the header
std::vector<StatedNumber> stated_in_v2a(const Lines& before)
{
    const Lines length = ahead_by(before, 10), interval = ahead_by(before, 11),
                peak = ahead_by(before, 14), times = ahead_by(before, 23),
                peaks = ahead_by(before, 24);
    const auto column = [](const Lines& lines, std::size_t index) {
        return column_of(lines.line(), columns.width, index);
    };
    const auto time_of_peak = [&](const Lines& lines, std::string_view name,
                                  std::string_view word) {
        StatedNumber stated{Stated::time_of_peak, lines, name, word};
        const std::string_view before_trigger = column(times, 1);
        stated.start = is_number(before_trigger) ? -number_of(times, before_trigger) : 0;
        return stated;
    };
    StatedNumber mean = peak_after(peak, "rms", "the rms");
    mean.what = Stated::root_mean_square;
    return {{Stated::count, length, "the number of points", word_after(length.line(), "points")},
            {Stated::duration, length, "the duration", word_after(length.line(), "duration")},
            {Stated::duration, times, "the duration, column 4,", column(times, 3)},
            {Stated::time_step, interval, "the interval", word_after(interval.line(), "data at")},
            peak_after(peak, "peak", "the peak"),
            mean,
            {Stated::peak, peaks, "the peak, column 6,", column(peaks, 5)},
            time_of_peak(peak, "the time of the peak", word_after(peak.line(), " at ")),
            time_of_peak(peaks, "the time of the peak, column 7,", column(peaks, 6))};
}

RecordComponent take_component(Lines& lines)
{
    const Lines before = lines;
    lines = ahead_by(lines, v2a_header_lines);
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
    compare(stated_in_v2a(before), component, before,
            rounding_of(column_of(times.line(), columns.width, 5)));
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
