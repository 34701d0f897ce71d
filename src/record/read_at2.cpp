#include "formats.hpp"
#include "numbers.hpp"
#include "stated_unit.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace overturn {

namespace {

constexpr std::size_t header_lines = 4;
constexpr std::size_t unit_line = 3;

constexpr std::string_view separators = " \t,=";

/// The text from the next word on: without blanks, tabs, commas and equals signs.
std::string_view from_word(std::string_view text)
{
    return text.substr(std::min(text.find_first_not_of(separators), text.size()));
}

std::string_view word_at(std::string_view text)
{
    return text.substr(0, text.find_first_of(separators));
}

/// The text from the word after a key and an equals sign on; empty if there is none.
std::string_view from_value(std::string_view line, std::string_view key)
{
    const std::size_t place = place_after(line, key);
    return place == line.npos || !trimmed(line.substr(place)).starts_with('=')
               ? ""
               : from_word(line.substr(place));
}

/// Refuses a time step with a decimal comma or with another unit than seconds.
void expect_seconds(const Lines& lines, std::string_view step, std::string_view after)
{
    if (after.starts_with(',') && after.size() > 1 && '0' <= after[1] && after[1] <= '9') {
        lines.refuse(
            "the time step {} has a decimal comma. Write it with a point, as in DT= .01 SEC.",
            quoted_bytes(std::string(step).append(after.substr(0, 2))));
    }
    const std::string_view unit = word_at(from_word(after));
    const std::string word = lower(unit.substr(0, unit.find_first_of(",;.")));
    constexpr std::array<std::string_view, 7> allowed{"",     "npts",   "s",      "sec",
                                                      "secs", "second", "seconds"};
    if (std::ranges::count(allowed, word) == 0) {
        lines.refuse("the unit {} of the time step is not understood. Write it in seconds, as in "
                     "DT= .01 SEC.",
                     quoted_bytes(unit));
    }
}

/// The number of words that begin like a number.
std::size_t count_numbers(std::string_view line)
{
    std::size_t count = 0;
    for (std::string_view rest = from_word(line); !rest.empty();) {
        const std::string_view word = word_at(rest);
        const std::size_t digit = word.find_first_not_of("+-.");
        count += digit != word.npos && '0' <= word[digit] && word[digit] <= '9';
        rest = from_word(rest.substr(word.size()));
    }
    return count;
}

/// New files: `NPTS=  4000, DT= .01000 SEC`. Old ones: `7997 0.0050 NPTS, DT`.
Sampling read_sampling(const Lines& lines)
{
    const std::string_view line = lines.line();
    std::string_view count = from_value(line, "NPTS");
    std::string_view step = from_value(line, "DT");
    const bool is_old = count.empty() && step.empty() && contains(line, "DT");
    if (is_old) {
        count = from_word(line);
        step = from_word(count.substr(word_at(count).size()));
    }
    const bool begins_with_key =
        contains(word_at(from_word(line)), "NPTS") || contains(word_at(from_word(line)), "DT");
    if (count.empty() || step.empty() || !(is_old || begins_with_key)) {
        lines.refuse("{} lacks the number of points or the time step. Write it as in NPTS= 4000, "
                     "DT= .01 SEC.",
                     quoted_bytes(line));
    }
    std::string_view number = word_at(step);
    if (const std::size_t unit = number.find_first_of("sS"); unit > 0) { // as in .01SEC
        number = number.substr(0, unit);
    }
    std::string_view after = step.substr(number.size());
    if (is_old) {
        for (const std::string_view key : {"npts", "dt"}) {
            const std::string_view word = word_at(from_word(after));
            if (lower(word) != key) {
                lines.refuse("{} is not understood. Write it as in NPTS= 4000, DT= .01 SEC.",
                             quoted_bytes(trimmed(line)));
            }
            after = from_word(after).substr(word.size());
        }
    }
    expect_seconds(lines, number, after);
    if (count_numbers(line) > (contains(line, "DURATION") ? 3 : 2)) {
        lines.refuse("{} has other numbers beside the number of points and the time step. Write it "
                     "as in NPTS= 4000, DT= .01 SEC.",
                     quoted_bytes(trimmed(line)));
    }
    return {.count = count_of(lines, word_at(count), "NPTS"),
            .time_step = time_step_of(lines, number)};
}

void expect_acceleration(const Lines& lines)
{
    const std::string_view line = lines.line();
    if (contains(line, "SPECTR") ||
        (!contains(line, "ACCELERATION") &&
         (contains(line, "VELOCITY") || contains(line, "DISPLACEMENT")))) {
        lines.refuse("{} does not contain accelerations. Give the AT2 file of this record.",
                     quoted_bytes(trimmed(line)));
    }
}

/// Refuses words behind the unit in the title, which may be a factor on the samples, as in UNITS OF
/// G, SCALED. Corner frequencies of filters and the peak may follow.
void expect_no_factor(const Lines& title_line, std::string_view unit)
{
    const std::string_view title = title_line.line();
    const std::size_t place = title.find(unit);
    if (place == title.npos) {
        return;
    }
    constexpr std::string_view marks = " \t.,;:()[]-";
    std::string rest = lower(title.substr(place + unit.size()));
    const auto next_word = [&] {
        rest.erase(0, rest.find_first_not_of(marks));
        return rest.substr(0, rest.find_first_of(marks));
    };
    std::string word = next_word();
    while (word == "units" || word == "corrected" || word == "uncorrected") {
        rest.erase(0, word.size());
        word = next_word();
    }
    if (!word.empty() && !word.starts_with("filter") && word != "peak" && word != "dt") {
        title_line.refuse(
            "the unit {} may be changed by what follows it. State the unit of the samples: "
            "{}.",
            quoted_bytes(unit), how_to_state("units"));
    }
}

/// The unit that the header states; nullopt if it states none, or one that is not understood
/// although another is given.
std::optional<AccelerationUnit> unit_of_header(Lines lines,
                                               const std::optional<AccelerationUnit>& given)
{
    const Lines before = lines;
    std::optional<StatedUnit> found;
    while (lines.number() < header_lines && lines.next()) {
        // The first two lines name the database and the station.
        const auto places =
            lines.number() < unit_line ? UnitPlaces::after_units : UnitPlaces::title;
        for (const StatedUnit& stated : stated_units(lines.line(), places)) {
            if (stated.unit && (!found || found->unit == stated.unit)) {
                found = stated;
                continue;
            }
            if (given) {
                return std::nullopt;
            }
            const std::string reason =
                stated.unit ? fmt::format("contradicts {}", quoted_bytes(found->text))
                            : "is not understood, or is changed by what follows it";
            lines.refuse("the unit {} {}. Understood are {} and their usual spellings, such as "
                         "CM/SEC/SEC. State the unit of the samples: {}.",
                         quoted_bytes(stated.text), reason,
                         fmt::join(acceleration_unit_names, ", "), how_to_state("units"));
        }
    }
    if (found && !given) {
        expect_no_factor(ahead_by(before, unit_line), found->text);
    }
    return found ? found->unit : std::nullopt;
}

} // namespace

RecordFile read_at2(Lines lines, const std::optional<AccelerationUnit>& unit)
{
    const Lines before = lines;
    Header header;
    header.take(lines, header_lines);
    expect_acceleration(ahead_by(before, unit_line));
    const Sampling sampling = read_sampling(lines);
    const auto stated = unit_of_header(before, unit);
    if (!stated && !unit) {
        Lines title_line = ahead_by(before, unit_line);
        title_line.refuse("{} states no unit that is understood, such as UNITS OF G. Give one of "
                          "{}: {}.",
                          quoted_bytes(trimmed(title_line.line())),
                          fmt::join(acceleration_unit_names, ", "), how_to_state("units"));
    }
    const std::string_view title = ahead_by(before, 2).line(); // event, date, station, component
    const std::size_t comma = title.rfind(',');
    RecordComponent component{
        .name = std::string(comma == title.npos ? "" : trimmed(title.substr(comma + 1))),
        .acceleration = take_free_numbers(
            lines, {.count = sampling.count, .name = "NPTS", .line = header_lines}),
        .unit = stated ? *stated : *unit,
        .time_step = sampling.time_step,
        .header = std::move(header).kept()};
    return {
        .format = "AT2", .components = {std::move(component)}, .has_given_unit = unit && !stated};
}

} // namespace overturn
