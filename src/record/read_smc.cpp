#include "formats.hpp"
#include "numbers.hpp"

#include <fmt/format.h>

#include <limits>
#include <string>
#include <utility>

namespace overturn {

namespace {

// 11 lines of text, 6 of integers in columns of 10, 10 of numbers in columns of 15.
constexpr std::size_t header_lines = 27;

// Lines of the header, counted from 1, and columns of the numbers, counted from 0.
constexpr std::size_t kind_line = 1;
constexpr std::size_t station_line = 6;
constexpr std::size_t count_line = 14;
constexpr std::size_t count = 0;
constexpr std::size_t rate_line = 18;
constexpr std::size_t rate = 1;
constexpr std::size_t integer_width = 10;
constexpr std::size_t number_width = 15;

constexpr double no_value = 1.7e38; // stands for numbers that are not known

void expect_accelerogram(const Lines& lines)
{
    if (!contains(lines.line(), "ACCELEROGRAM")) {
        lines.refuse(fmt::format("{} is not an accelerogram. Give the file of the acceleration.",
                                 quoted_bytes(trimmed(lines.line()))));
    }
}

std::string component_name(const Lines& lines)
{
    const std::size_t place = place_after(lines.line(), "component=");
    return place == std::string_view::npos ? "" : std::string(trimmed(lines.line().substr(place)));
}

Announcement announcement(const Lines& lines)
{
    return {.count = count_of(lines, column_of(lines.line(), integer_width, count),
                              "the number of samples, columns 1 to 10,"),
            .name = "the header",
            .line = lines.number()};
}

double time_step_of_rate(const Lines& lines)
{
    const std::string_view word = column_of(lines.line(), number_width, rate);
    const double samples_per_second = number_of(lines, word);
    constexpr double least = std::numeric_limits<double>::min(); // its inverse does not overflow
    if (!(samples_per_second >= least && samples_per_second < no_value)) {
        lines.refuse(fmt::format("the number of samples per second, columns 16 to 30, is {}, but "
                                 "must be above 0 and below 1.7e38. Correct it.",
                                 quoted_bytes(word)));
    }
    return 1 / samples_per_second;
}

} // namespace

RecordFile read_smc(Lines lines)
{
    const Lines before = lines;
    Header header;
    header.take(lines, header_lines);
    expect_accelerogram(ahead_by(before, kind_line));
    const Announcement announced = announcement(ahead_by(before, count_line));
    RecordComponent component{.name = component_name(ahead_by(before, station_line)),
                              .acceleration = {},
                              .unit = AccelerationUnit::cm_per_s2,
                              .time_step = time_step_of_rate(ahead_by(before, rate_line)),
                              .header = {}};
    for (Lines ahead = lines; ahead.next() && ahead.line().starts_with('|');) { // a comment
        header.take(lines, 1);
    }
    component.header = std::move(header).kept();
    component.acceleration = take_free_numbers(lines, announced);
    return {.format = "SMC", .components = {std::move(component)}};
}

} // namespace overturn
