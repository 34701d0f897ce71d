#include "formats.hpp"
#include "numbers.hpp"

#include <limits>
#include <string>
#include <utility>

namespace overturn {

namespace {

// 11 lines of text, 6 of integers in columns of 10, 10 of numbers in columns of 15.
constexpr std::size_t header_lines = 27;

std::string component_name(std::string_view station)
{
    const std::size_t place = place_after(station, "component=");
    return std::string(place == station.npos ? "" : trimmed(station.substr(place)));
}

/// [s]
double time_step_of_rate(const Lines& lines)
{
    const std::string_view word = column_of(lines.line(), 15, 1);
    const double samples_per_second = number_of(lines, word);
    constexpr double least = std::numeric_limits<double>::min(); // its inverse does not overflow
    constexpr double no_value = 1.7e38; // stands for numbers that are not known
    if (!(samples_per_second >= least && samples_per_second < no_value)) {
        lines.refuse("the number of samples per second, columns 16 to 30, is {}, but must be above "
                     "0 and below 1.7e38. Correct it.",
                     quoted_bytes(word));
    }
    return 1 / samples_per_second;
}

} // namespace

RecordFile read_smc(Lines lines, const RecordOptions&)
{
    const Lines before = lines;
    const Lines kind = ahead_by(before, 1);
    lines = ahead_by(before, header_lines);
    if (!contains(kind.line(), "ACCELEROGRAM")) {
        refuse_motion(kind);
    }
    const Lines counts = ahead_by(before, 14);
    const Announcement announced{.count = count_of(counts, column_of(counts.line(), 10, 0),
                                                   "the number of samples, columns 1 to 10,"),
                                 .name = "the header",
                                 .line = counts.number()};
    const double time_step = time_step_of_rate(ahead_by(before, 18));
    for (Lines ahead = lines; ahead.next() && ahead.line().starts_with('|');) { // a comment
        lines = ahead;
    }
    const std::size_t last_of_header = lines.number();
    RecordComponent component{.name = component_name(ahead_by(before, 6).line()),
                              .acceleration = take_free_numbers(lines, announced),
                              .unit = AccelerationUnit::cm_per_s2,
                              .time_step = time_step,
                              .is_uncorrected = contains(kind.line(), "UNCORRECTED"),
                              .header = kept_lines(before, last_of_header)};
    return {.format = "SMC", .components = {std::move(component)}};
}

} // namespace overturn
