#include "formats.hpp"
#include "numbers.hpp"
#include "stated_numbers.hpp"

#include <fmt/ranges.h>

#include <string>
#include <utility>

namespace overturn {

namespace {

// 11 lines of text, 6 of integers in columns of 10, 10 of numbers in columns of 15.
constexpr std::size_t smc_header_lines = 27;

constexpr std::string_view before_component = "component=";

std::string component_name(std::string_view station)
{
    const std::size_t place = place_after(station, before_component);
    return std::string(place == station.npos ? "" : trimmed(station.substr(place)));
}

/// `1989 10 18 0004 Loma Prieta, CA, station = APEEL Array #2`, of lines 4 and 6
std::string event_of(std::string_view earthquake, std::string_view station)
{
    const std::size_t place = place_after(station, before_component);
    const std::size_t end =
        place == station.npos ? station.size() : place - before_component.size();
    return fmt::format("{}, {}", fmt::join(words_of(earthquake, " "), " "),
                       trimmed(station.substr(0, end)));
}

/// Samples per second. It is unknown if the samples are not at even times.
double samples_per_second(const Lines& lines)
{
    const std::string_view word = column_of(lines.line(), 15, 1);
    if (is_number(word) && is_mark_of_unknown(number_of(lines, word))) {
        lines.refuse("the number of samples per second is {}, which stands for an unknown number: "
                     "the samples are not at even times, but pairs of times and accelerations. "
                     "Interpolate the accelerations at even times, and give both as text.",
                     word);
    }
    return sampling_rate_of(lines, word);
}

/// Whether every other sample, beginning with this one, is at least as large as the one before it.
bool do_not_decrease(const std::vector<double>& samples, std::size_t first)
{
    for (std::size_t i = first + 2; i < samples.size(); i += 2) {
        if (samples[i] < samples[i - 2]) {
            return false;
        }
    }
    return true;
}

/// Refuses samples of which every other one is a time, which may be equal in the printed digits.
void expect_no_times(const Lines& rates, const std::vector<double>& samples)
{
    constexpr std::size_t least_samples = 8; // of fewer, accelerations may increase
    if (samples.size() < least_samples || samples.size() % 2 != 0) {
        return;
    }
    const double first = samples.front();
    const double last = samples[samples.size() - 2];
    if (0 <= first && first < last && do_not_decrease(samples, 0) && !do_not_decrease(samples, 1)) {
        rates.refuse(
            "the header states {} samples per second, but every other sample is at least "
            "as large as the one before it, from {} to {}: the samples are pairs of times "
            "and accelerations. Interpolate the accelerations at even times, and give both "
            "as text.",
            column_of(rates.line(), 15, 1), first, last);
    }
}

/// Real numbers 29 to 32, and `epicentral dist =     63.0       pk     =    272.3`. before: the
/// header
std::vector<StatedNumber> stated_in_smc(const Lines& before)
{
    const Lines peak = ahead_by(before, 7), highest = ahead_by(before, 23),
                lowest = ahead_by(before, 24);
    const std::size_t place = std::min(place_after(peak.line(), " pk "), peak.line().size());
    const auto real = [](Stated what, Peak of, const Lines& lines, std::size_t index,
                         std::string_view name) {
        StatedNumber stated{what, lines, name, column_of(lines.line(), 15, index)};
        stated.peak = of;
        return stated;
    };
    return {{Stated::peak, peak, "the peak", word_after(peak.line().substr(place), "=")},
            real(Stated::peak, Peak::highest, highest, 4, "real number 30, the maximum,"),
            real(Stated::peak, Peak::lowest, lowest, 1, "real number 32, the minimum,"),
            real(Stated::time_of_peak, Peak::highest, highest, 3,
                 "real number 29, the time of the maximum,"),
            real(Stated::time_of_peak, Peak::lowest, lowest, 0,
                 "real number 31, the time of the minimum,")};
}

} // namespace

RecordFile read_smc(Lines lines, const RecordOptions&)
{
    const Lines before = lines;
    const Lines kind = ahead_by(before, 1);
    lines = ahead_by(before, smc_header_lines);
    if (!contains(kind.line(), "ACCELEROGRAM")) {
        refuse_motion(kind);
    }
    const Lines counts = ahead_by(before, 14);
    const Announcement announced{.count = count_of(counts, column_of(counts.line(), 10, 0),
                                                   "the number of samples, columns 1 to 10,"),
                                 .name = "the header",
                                 .line = counts.number()};
    const Lines rates = ahead_by(before, 18);
    const double rate = samples_per_second(rates);
    for (Lines ahead = lines; ahead.next() && ahead.line().starts_with('|');) { // a comment
        lines = ahead;
    }
    const std::size_t last_of_header = lines.number();
    const std::string_view station = ahead_by(before, 6).line();
    RecordComponent component{.name = component_name(station),
                              .event = event_of(ahead_by(before, 4).line(), station),
                              .acceleration = take_free_numbers(lines, announced),
                              .unit = AccelerationUnit::cm_per_s2,
                              .time_step = 1 / rate,
                              .is_uncorrected = contains(kind.line(), "UNCORRECTED"),
                              .header = kept_lines(before, last_of_header)};
    expect_no_times(rates, component.acceleration);
    compare(stated_in_smc(before), component, before,
            rounding_of(column_of(rates.line(), 15, 1)) / (rate * rate));
    return {.format = "SMC", .components = {std::move(component)}};
}

} // namespace overturn
