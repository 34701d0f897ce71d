#include "formats.hpp"
#include "numbers.hpp"
#include "stated_numbers.hpp"
#include "stated_unit.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

namespace overturn {

namespace {

constexpr std::size_t at2_header_lines = 4;
constexpr std::size_t title_line = 3; // states the kind of data and their unit

bool is_seconds(std::string_view word)
{
    return is_one_of(lower(word), {"s", "sec", "sec.", "secs", "second", "seconds"});
}

/// What line 4 states.
struct Sampling {
    std::size_t count;
    double time_step;          ///< [s]
    double rounding;           ///< of the time step [s]
    std::string_view duration; ///< [s], as printed; empty if it is not stated
};

/// A number and its unit, as in .01SEC, without the unit.
std::string_view without_seconds(std::string_view word)
{
    const std::size_t unit = std::min(word.find_first_of("sS"), word.size());
    return is_seconds(word.substr(unit)) ? word.substr(0, unit) : word;
}

/// New files: `NPTS=  4000, DT= .01000 SEC`, perhaps with `DURATION= 40 SEC`. Old ones: `7997
/// 0.0050 NPTS, DT`.
Sampling read_sampling(const Lines& lines)
{
    const auto refuse = [&] {
        lines.refuse("{} is not understood. Write only the number of points and the time step in "
                     "seconds, as in NPTS= 4000, DT= .01 SEC.",
                     lines.quoted());
    };
    std::vector<std::string_view> words = words_of(lines.line(), " \t,;=");
    std::erase_if(words, is_seconds);
    if (words.size() == 4 && lower(words[2]) == "npts") { // an old one
        words = {words[2], words[0], words[3], words[1]};
    }
    std::map<std::string, std::string_view> values;
    for (std::size_t i = 0; i < words.size(); i += 2) {
        const std::string key = lower(words[i]);
        if (i + 1 == words.size() || !is_one_of(key, {"npts", "dt", "duration"}) ||
            !values.emplace(key, words[i + 1]).second) {
            refuse();
        }
    }
    if (!values.contains("npts") || !values.contains("dt")) {
        refuse();
    }
    const std::string_view step = without_seconds(values["dt"]);
    return {.count = count_of(lines, values["npts"], "NPTS"),
            .time_step = time_step_of(lines, step),
            .rounding = rounding_of(step),
            .duration = without_seconds(values["duration"])};
}

void expect_acceleration(const Lines& title)
{
    if (contains(title.line(), "SPECTR") ||
        (!contains(title.line(), "ACCELERATION") &&
         (contains(title.line(), "VELOCITY") || contains(title.line(), "DISPLACEMENT")))) {
        refuse_motion(title);
    }
}

/// What remains of a title without words that do not change its unit: "g" of "ACCELERATION TIME
/// SERIES IN UNITS OF G, FILTERED". Corner frequencies of filters and the peak may follow.
std::string unit_of_title(std::string_view title)
{
    constexpr std::string_view separators = " \t,;:=()[].-";
    std::string text = lower(title);
    for (const std::string_view word : words_of(text, separators)) {
        const auto begin = text.begin() + (word.data() - text.data());
        if (is_one_of(word, {"filter", "filters", "peak", "dt"})) {
            text.erase(begin, text.end());
            break;
        }
        if (is_one_of(word,
                      {"acceleration", "accelerations", "accelerogram", "accel", "acc", "time",
                       "series", "history", "in", "of", "unit", "units", "are", "fraction",
                       "fractions", "multiples", "corrected", "uncorrected", "filtered"})) {
            std::fill_n(begin, word.size(), ' ');
        }
    }
    const std::size_t first = std::min(text.find_first_not_of(separators), text.size());
    return text.substr(first, text.find_last_not_of(separators) + 1 - first);
}

/// The unit that the title states; nullopt if it states none, or one that is not understood, or if
/// another line may state one.
std::optional<AccelerationUnit> unit_of_header(const Lines& before)
{
    const bool is_stated_before = contains(ahead_by(before, 1).line(), "units") ||
                                  contains(ahead_by(before, 2).line(), "units");
    return is_stated_before ? std::nullopt
                            : unit_named(unit_of_title(ahead_by(before, title_line).line()));
}

} // namespace

RecordFile read_at2(Lines lines, const RecordOptions& options)
{
    const Lines before = lines;
    lines = ahead_by(lines, at2_header_lines);
    const Lines title = ahead_by(before, title_line);
    expect_acceleration(title);
    const Lines times = lines;
    const Sampling sampling = read_sampling(times);
    const auto stated = unit_of_header(before);
    if (!stated && !options.unit) {
        title.refuse(
            "{} does not state a unit that is understood, such as UNITS OF G or CM/SEC/SEC, "
            "as the only one of the header and without a factor. Give one of {}: {}.",
            title.quoted(), fmt::join(names_of<AccelerationUnit>, ", "), how_to_state("units"));
    }
    const std::string_view station = ahead_by(before, 2).line(); // event, date, station, component
    const std::size_t comma = station.rfind(',');
    RecordComponent component{
        .name = std::string(comma == station.npos ? "" : trimmed(station.substr(comma + 1))),
        .event = std::string(comma == station.npos ? "" : trimmed(station.substr(0, comma))),
        .acceleration = take_free_numbers(
            lines, {.count = sampling.count, .name = "NPTS", .line = at2_header_lines}),
        .unit = stated ? *stated : *options.unit,
        .time_step = sampling.time_step,
        .header = kept_lines(before, at2_header_lines)};
    compare({{Stated::duration, times, "DURATION", sampling.duration},
             peak_after(title, "peak", "the peak")},
            component, times, sampling.rounding);
    return {.format = "AT2", .components = {std::move(component)}, .has_given_unit = !stated};
}

} // namespace overturn
