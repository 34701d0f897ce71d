#include "formats.hpp"
#include "numbers.hpp"

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
    const Lines rates = ahead_by(before, 18);
    const double rate = sampling_rate_of(rates, column_of(rates.line(), 15, 1));
    for (Lines ahead = lines; ahead.next() && ahead.line().starts_with('|');) { // a comment
        lines = ahead;
    }
    const std::size_t last_of_header = lines.number();
    RecordComponent component{.name = component_name(ahead_by(before, 6).line()),
                              .acceleration = take_free_numbers(lines, announced),
                              .unit = AccelerationUnit::cm_per_s2,
                              .time_step = 1 / rate,
                              .is_uncorrected = contains(kind.line(), "UNCORRECTED"),
                              .header = kept_lines(before, last_of_header)};
    return {.format = "SMC", .components = {std::move(component)}};
}

} // namespace overturn
