#include "channels.hpp"
#include "formats.hpp"
#include "numbers.hpp"
#include "stated_numbers.hpp"
#include "stated_unit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace overturn {

namespace {

/// Integers or real numbers of a header, counted from 1 as in the description of the format.
struct HeaderValues {
    Lines lines; ///< at the line that announces them
    std::vector<Printed> values;

    /// nullopt if it is missing or unknown, such as -999.
    std::optional<double> operator[](std::size_t number) const
    {
        const Printed found = printed(number);
        const double value = found.word.empty() ? -1 : number_of(found.lines, found.word);
        return value < 0 ? std::nullopt : std::optional(value);
    }

    /// Empty if it is missing.
    Printed printed(std::size_t number) const
    {
        return number <= values.size() ? values[number - 1] : Printed{lines, ""};
    }
};

/// Takes the lines up to the one that contains the name, and the values that it announces.
HeaderValues take_header_values(Lines& lines, std::string_view name)
{
    const std::size_t begin = lines.number() + 1;
    if (!next_with(lines, name)) {
        lines.refuse("no line such as 100 {} values follow after line {}. Give the complete file.",
                     name, begin);
    }
    const Lines announcing = lines;
    return {announcing, take_announced_as_printed(lines, name)};
}

/// Takes the comments. The channel of `<SCNL>BMR.BNZ.AK.--`; empty if they contain none.
std::string take_comments(Lines& lines)
{
    std::string channel;
    for (Lines ahead = lines; next_text(ahead) && (contains(ahead.line(), "comment line") ||
                                                   trimmed(ahead.line()).starts_with('|'));) {
        lines = ahead;
        const std::size_t station = place_after(lines.line(), "<SCNL>");
        const std::size_t point = lines.line().find('.', station);
        if (station != point && point != std::string_view::npos) {
            const std::string_view rest = lines.line().substr(point + 1);
            channel = rest.substr(0, rest.find_first_of(". \t"));
        }
    }
    return channel;
}

/// The unit in the line before the samples; nullopt for counts. Refuses other units, and one that
/// contradicts its code.
std::optional<AccelerationUnit> unit_of(const Lines& lines, const std::optional<double>& code)
{
    const std::string_view name = text_after(lines.line(), "units");
    const bool is_counts = is_one_of(lower(name), {"count", "counts"});
    const auto unit = is_counts ? std::nullopt : std::optional(unit_of_samples(lines, name));
    const bool agrees = (code == 2 && unit == AccelerationUnit::g) ||
                        ((code == 4 || code == 10) && unit == AccelerationUnit::cm_per_s2) ||
                        (code == 50 && is_counts);
    if (code && !agrees) {
        lines.refuse("the unit {} contradicts integer 3 of the header, {}. Correct one of them.",
                     quoted_bytes(name), *code);
    }
    return unit;
}

/// Interval [s] of the samples, or of the recorder if the former is unknown, and its rounding.
std::pair<double, double> time_step_of(const HeaderValues& reals)
{
    const auto interval = reals[62]; // [ms]
    const auto of_recorder = reals[34];
    const double step = interval ? *interval / 1000 : of_recorder.value_or(0);
    if (!(step > 0)) {
        reals.lines.refuse("the time step, real 62 of the header in ms, is unknown or 0. Give a "
                           "file that states it.");
    }
    return {step, interval ? rounding_of(reals.printed(62).word) / 1000
                           : rounding_of(reals.printed(34).word)};
}

/// A channel as the file contains it.
struct Channel {
    Lines text; ///< before the lines of text
    const HeaderValues& integers;
    const HeaderValues& reals;
    Lines announcing; ///< the line before the samples
    bool is_counts;
};

/// The peak of `Processed: 06/17/2005, PDT  Max = -161.962 cm/sec2 at 27.850 sec`, and of `Raw
/// record length = 70.000 sec, Uncor max = 985881 counts, at 27.850 sec` if the samples are counts.
void add_peaks_of_text(const Channel& channel, std::vector<StatedNumber>& stated)
{
    constexpr std::string_view words = "max =";
    Lines lines = channel.text;
    while (lines.next() && lines.number() < channel.integers.lines.number()) {
        const std::size_t place = place_after(lines.line(), words);
        if (place != std::string_view::npos &&
            (channel.is_counts || !contains(lines.line(), "uncor"))) {
            stated.push_back(peak_after(lines, words, "Max"));
            stated.push_back({Stated::time_of_peak, lines, "the time of Max",
                              word_after(lines.line().substr(place), " at ")});
        }
    }
}

std::vector<StatedNumber> stated_numbers(const Channel& channel)
{
    const Lines& line = channel.announcing;
    std::vector<StatedNumber> stated{{.what = Stated::duration,
                                      .lines = line,
                                      .name = "the approximate duration",
                                      .word = word_after(line.line(), "approx"),
                                      .least_rounding = 1}};
    const auto add_real = [&](Stated what, std::size_t number, std::string_view name) {
        const Printed printed = channel.reals.printed(number);
        stated.push_back({what, printed.lines, name, printed.word});
    };
    add_real(Stated::duration, 63, "real 63, the length of the series,");
    add_real(Stated::peak, 64, "real 64, the maximum,");
    add_real(Stated::time_of_peak, 65, "real 65, the time of the maximum,");
    if (channel.is_counts) { // which are at the interval of the recorder
        add_real(Stated::time_step, 34, "real 34, the interval of the recorder,");
        add_real(Stated::duration, 35, "real 35, the length of the raw record,");
    }
    add_peaks_of_text(channel, stated);
    return stated;
}

/// Counts in g: real 22 is the voltage of a count [uV], real 42 the sensitivity [V/g], real 47 the
/// gain.
std::vector<double> over_g(const HeaderValues& reals, std::vector<double> counts)
{
    const auto voltage = reals[22], sensitivity = reals[42];
    const double gain = reals[47].value_or(1);
    if (!(voltage.value_or(0) > 0 && sensitivity.value_or(0) > 0 && gain == 1)) {
        reals.lines.refuse("the samples are counts, but reals 22 (microvolts per count), 42 "
                           "(volts per g) and 47 (gain, must be 1) of the header are {}, {} and "
                           "{}. Give the file of volume 1 or 2, in cm/sec2.",
                           voltage.value_or(-999), sensitivity.value_or(-999), gain);
    }
    // Reals 43 and 44: full scale of the sensor [V] and [g].
    if (const auto volts = reals[43], g = reals[44]; volts && g && *volts > 0 && *g > 0) {
        if (std::abs(*sensitivity * *g / *volts - 1) > 0.05) {
            reals.lines.refuse(
                "the sensitivity of the sensor, real 42 of the header, is {} V/g, but "
                "its full scale, reals 43 and 44, is {} V at {} g. Give the file as "
                "it was published, or correct the wrong one.",
                *sensitivity, *volts, *g);
        }
    }
    return acceleration_of_counts(reals.lines, std::move(counts), *voltage / 1e6, *sensitivity);
}

/// Whether the title of a channel says so.
bool is_uncorrected(Lines lines)
{
    next_text(lines);
    return contains(lines.line(), "uncorrected") || lower(trimmed(lines.line())).starts_with("raw");
}

/// A channel; nullopt if it is not an acceleration.
std::optional<RecordComponent> take_cosmos_channel(Lines& lines)
{
    const Lines before = lines;
    const HeaderValues integers = take_header_values(lines, "Integer-header");
    ChannelName name = channel_name(before, integers.lines.number());
    const HeaderValues reals = take_header_values(lines, "Real-header");
    std::string code = take_comments(lines);
    if (!next_text(lines)) {
        lines.refuse("the file ends within the header. Give the complete file.");
    }
    const Lines announcing = lines;
    std::vector<double> samples = take_announced(lines, "the series");
    const bool is_acceleration = contains(announcing.line(), "accel");
    if (integers[2] && is_acceleration != (*integers[2] == 1)) {
        announcing.refuse("{} contradicts integer 2 of the header, {}: 1 is acceleration. Correct "
                          "one of them.",
                          announcing.quoted(), *integers[2]);
    }
    if (!is_acceleration) {
        return std::nullopt;
    }
    const bool is_named = !is_one_of(lower(name.direction), {"", "?", "other"});
    const auto [time_step, rounding] = time_step_of(reals);
    const auto unit = unit_of(announcing, integers[3]);
    // 0: counts, 1: accelerations, 2: corrected ones
    const bool is_raw = integers[1].value_or(2) < 2 || is_uncorrected(before);
    std::vector<std::string> remarks = compare(
        stated_numbers({before, integers, reals, announcing, !unit}), {.lines = announcing,
                                                                       .values = samples,
                                                                       .unit = unit,
                                                                       .time_step = time_step,
                                                                       .rounding = rounding,
                                                                       .may_have_offset = is_raw});
    return RecordComponent{
        .name = is_named || code.empty() ? std::move(name.direction) : std::move(code),
        .place = std::move(name.place),
        .acceleration = unit ? std::move(samples) : over_g(reals, std::move(samples)),
        .unit = unit.value_or(AccelerationUnit::g),
        .time_step = time_step,
        .is_uncorrected = is_raw,
        .remarks = std::move(remarks),
        .header = kept_lines(before, announcing.number())};
}

/// Proceeds beyond the line that ends a channel. Refuses further samples.
void expect_end(Lines& lines)
{
    Lines ahead = lines;
    if (next_text(ahead) && !contains(ahead.line(), "(Format v")) {
        lines = ahead;
        if (!contains(lines.line(), "end-of-data") && !contains(lines.line(), "end of data")) {
            lines.refuse("{} follows the last of the samples that were announced. Correct their "
                         "number, or give the file as it was published.",
                         lines.quoted());
        }
    }
}

} // namespace

RecordFile read_cosmos(Lines lines, const RecordOptions&)
{
    Lines title = lines;
    next_text(title);
    RecordFile file{.format = "COSMOS", .components = {}};
    do {
        if (auto component = take_cosmos_channel(lines)) {
            file.components.push_back(std::move(*component));
        }
        expect_end(lines);
    } while (!is_at_end(lines));
    if (file.components.empty()) {
        refuse_motion(title);
    }
    return file;
}

} // namespace overturn
