#include "stated_numbers.hpp"

#include "numbers.hpp"
#include "stated_unit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace overturn {

namespace {

constexpr double standard_gravity = 9.80665; // [m/s2]

/// How far a number is from the samples, beyond its rounding, and what they have instead.
struct Difference {
    double relative;
    std::string found; ///< empty if the number agrees
};

constexpr double not_at_all = std::numeric_limits<double>::infinity();
constexpr double noticeable = 0.01;
constexpr double largest_allowed = 0.05;

/// Digits that single precision adds to a number, and ties of rounding.
double printed_rounding(const StatedNumber& stated, double value)
{
    constexpr double of_single_precision = 0x1p-23;
    return std::max(rounding_of(stated.word), stated.least_rounding) +
           of_single_precision * std::abs(value);
}

/// The unit of a stated peak; nullopt: counts.
std::optional<AccelerationUnit> unit_of_peak(const StatedNumber& stated, const Samples& samples)
{
    return stated.unit ? stated.unit : samples.unit;
}

/// How many of the unit of a stated peak are one of the unit of the samples.
double units_per_unit_of_samples(const StatedNumber& stated, const Samples& samples)
{
    const auto per_m_per_s2 = [](AccelerationUnit unit) {
        return unit == AccelerationUnit::g ? 1 / standard_gravity : units_per_m_per_s2(unit);
    };
    return stated.unit && samples.unit ? per_m_per_s2(*stated.unit) / per_m_per_s2(*samples.unit)
                                       : 1;
}

std::string name_of_unit(const std::optional<AccelerationUnit>& unit)
{
    return unit ? std::string(name_of(*unit)) : "counts";
}

double size_of(double acceleration, Peak peak)
{
    return peak == Peak::highest  ? acceleration
           : peak == Peak::lowest ? -acceleration
                                  : std::abs(acceleration);
}

/// The size of the samples without an offset.
double peak_size(const Samples& samples, double offset, Peak peak)
{
    double largest = -not_at_all;
    for (const double value : samples.values) {
        largest = std::max(largest, size_of(value - offset, peak));
    }
    return largest;
}

double root_mean_square(const Samples& samples, double offset)
{
    const double peak = peak_size(samples, offset, Peak::absolute);
    double sum = 0; // of squares over that of the peak
    for (const double value : samples.values) {
        sum += peak > 0 ? std::pow((value - offset) / peak, 2) : 0;
    }
    return peak * std::sqrt(sum / double(samples.values.size()));
}

/// What a stated peak may be without: nothing, or the mean of all samples.
std::vector<double> offsets_of(const Samples& samples)
{
    std::vector<double> offsets{0};
    if (samples.may_have_offset) {
        double mean = 0;
        for (const double value : samples.values) {
            mean += value / double(samples.values.size());
        }
        offsets.push_back(mean);
    }
    return offsets;
}

Difference from_peak(const StatedNumber& stated, double value, const Samples& samples)
{
    const double factor = units_per_unit_of_samples(stated, samples);
    const double size = size_of(value, stated.peak);
    Difference least{not_at_all, ""};
    for (const double offset : offsets_of(samples)) {
        const double found =
            factor * (stated.what == Stated::peak ? peak_size(samples, offset, stated.peak)
                                                  : root_mean_square(samples, offset));
        const double difference = std::abs(size - found) - printed_rounding(stated, value);
        const double relative = difference <= 0 ? 0
                                : found == 0    ? not_at_all
                                                : difference / std::abs(found);
        if (relative < least.relative || least.found.empty()) {
            least = {relative,
                     fmt::format("that of the samples is {:.6g} {}", size_of(found, stated.peak),
                                 name_of_unit(unit_of_peak(stated, samples)))};
        }
    }
    return least;
}

/// The stated time may be that of the first sample of the peak or the next one.
Difference from_time_of_peak(const StatedNumber& stated, double time, const Samples& samples)
{
    const double allowed = 1.5 * samples.time_step + printed_rounding(stated, time);
    double last = 0; // time of the last peak
    for (const double offset : offsets_of(samples)) {
        const double least = (1 - noticeable) * peak_size(samples, offset, stated.peak);
        for (std::size_t i = 0; i < samples.values.size(); ++i) {
            if (size_of(samples.values[i] - offset, stated.peak) >= least) {
                last = stated.start + double(i) * samples.time_step;
                if (std::abs(last - time) <= allowed) {
                    return {0, ""};
                }
            }
        }
    }
    return {not_at_all, fmt::format("that of the samples is {:.6g} s, at {:.6g} s per sample", last,
                                    samples.time_step)};
}

/// rounding: of both numbers
Difference from_time_step(double stated, double time_step, double rounding)
{
    const double difference = std::abs(stated - time_step);
    return {difference <= std::min(rounding, largest_allowed * time_step) ? difference / time_step
                                                                          : not_at_all,
            fmt::format("that of the samples is {:.6g} s", time_step)};
}

Difference from_duration(const StatedNumber& stated, double duration, const Samples& samples)
{
    const auto count = double(samples.values.size());
    const double longest = count * samples.time_step;
    const double shortest = longest - samples.time_step;
    const double allowed = std::max(printed_rounding(stated, duration),
                                    std::min(count * samples.rounding, largest_allowed * longest));
    const bool agrees = shortest - allowed <= duration && duration <= longest + allowed;
    return {agrees ? 0 : not_at_all,
            fmt::format("{} {} at {:.6g} s are {:.6g} s", samples.values.size(),
                        noun_of(samples.values.size(), "samples"), samples.time_step, longest)};
}

/// value: in seconds, if it is a time
Difference difference_from(const StatedNumber& stated, double value, const Samples& samples)
{
    const double step = samples.time_step;
    const double rounding = printed_rounding(stated, value);
    switch (stated.what) {
    case Stated::count:
        return {value == double(samples.values.size()) ? 0 : not_at_all,
                fmt::format("there are {}", samples.values.size())};
    case Stated::time_step:
        return from_time_step(value, step, std::max(rounding, samples.rounding));
    case Stated::duration: return from_duration(stated, value, samples);
    case Stated::peak:
    case Stated::root_mean_square: return from_peak(stated, value, samples);
    default: return from_time_of_peak(stated, value, samples);
    }
}

std::string name_of_unit(const StatedNumber& stated, const Samples& samples)
{
    switch (stated.what) {
    case Stated::count: return "";
    case Stated::peak:
    case Stated::root_mean_square: return " " + name_of_unit(unit_of_peak(stated, samples));
    default: return " s";
    }
}

/// Refuses marks of missing values among the samples.
void expect_no_marks(const Samples& samples)
{
    const auto mark = std::ranges::find_if(samples.values, is_mark_of_unknown);
    if (mark == samples.values.end()) {
        return;
    }
    double largest = 0; // of the others
    for (const double value : samples.values) {
        largest = std::max(largest, is_mark_of_unknown(value) ? 0 : std::abs(value));
    }
    if (std::abs(*mark) > 2 * largest) {
        samples.lines.refuse_file("sample {} is {}, which stands for a missing value; the largest "
                                  "other one is {}. Give a record without gaps.",
                                  mark - samples.values.begin() + 1, *mark, largest);
    }
}

} // namespace

std::vector<std::string> compare(const std::vector<StatedNumber>& stated, const Samples& samples)
{
    expect_no_marks(samples);
    std::vector<std::string> remarks;
    bool is_confirmed = false; // whether another number states the time step
    const auto judge = [&](const StatedNumber& number) {
        const double printed = is_number(number.word) ? number_of(number.lines, number.word) : 0;
        const bool is_of_counts = number.unit && !samples.unit; // but states an acceleration
        if (printed == 0 || is_mark_of_unknown(printed) || is_of_counts) {
            return;
        }
        const Difference difference = difference_from(number, printed, samples);
        const std::string text = fmt::format("{} is {}{}, but {}", number.name, number.word,
                                             name_of_unit(number, samples), difference.found);
        // The window of a mean, and the origin of a time, are not stated.
        const bool may_differ = number.what == Stated::root_mean_square ||
                                (number.what == Stated::time_of_peak && is_confirmed);
        if (difference.relative > largest_allowed && !may_differ) {
            number.lines.refuse("{}. Give the file as it was published, or correct the wrong one.",
                                text);
        }
        if (difference.relative > noticeable) {
            remarks.push_back(fmt::format("{}: {}", number.lines.place(), text));
        }
        is_confirmed |= number.what == Stated::time_step || number.what == Stated::duration;
    };
    for (const bool are_times_of_peaks : {false, true}) {
        for (const StatedNumber& number : stated) {
            if ((number.what == Stated::time_of_peak) == are_times_of_peaks) {
                judge(number);
            }
        }
    }
    return remarks;
}

void compare(const std::vector<StatedNumber>& stated, RecordComponent& component,
             const Lines& lines, double rounding)
{
    component.remarks = compare(stated, {.lines = lines,
                                         .values = component.acceleration,
                                         .unit = component.unit,
                                         .time_step = component.time_step,
                                         .rounding = rounding,
                                         .may_have_offset = component.is_uncorrected});
}

StatedNumber peak_after(const Lines& lines, std::string_view words, std::string_view name)
{
    const std::string_view line = lines.line();
    StatedNumber peak{Stated::peak, lines, name, word_after(line, words)};
    if (peak.word.empty()) {
        return peak;
    }
    const auto after_number = std::size_t(peak.word.data() + peak.word.size() - line.data());
    const std::vector<std::string_view> after = words_of(line.substr(after_number), " \t,;");
    const std::string unit = after.empty() ? "" : lower(after.front());
    peak.unit = unit_named(unit);
    if (!peak.unit && !is_one_of(unit, {"", "at", "count", "counts"})) {
        peak.word = "";
    }
    return peak;
}

std::string_view word_after(std::string_view line, std::string_view words)
{
    const std::size_t place = place_after(line, words);
    const std::string_view rest = place == line.npos ? "" : line.substr(place);
    const std::size_t begin = std::min(rest.find_first_not_of(" \t=:"), rest.size());
    const std::size_t end = std::min(rest.find_first_of(" \t,;", begin), rest.size());
    return rest.substr(begin, end - begin);
}

} // namespace overturn
