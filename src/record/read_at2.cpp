#include "formats.hpp"
#include "numbers.hpp"
#include "stated_unit.hpp"
#include "unit_spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace overturn {

namespace {

constexpr std::size_t header_lines = 4;
constexpr std::size_t unit_line = 3;

struct Sampling {
    std::size_t count;
    double time_step; ///< [s]
};

/// The next word: without the blanks, tabs, commas and equals signs before it, and up to the next.
std::string_view first_word(std::string_view text)
{
    constexpr std::string_view separators = " \t,=";
    text.remove_prefix(std::min(text.find_first_not_of(separators), text.size()));
    return text.substr(0, text.find_first_of(separators));
}

/// The word after a key and an equals sign; nullopt if there is none.
std::optional<std::string_view> value_of(std::string_view line, std::string_view key)
{
    const std::size_t place = place_after(line, key);
    if (place == line.npos || !trimmed(line.substr(place)).starts_with('=')) {
        return std::nullopt;
    }
    return first_word(line.substr(place));
}

/// The number before a unit that touches it, as in .01SEC.
std::string_view without_unit(std::string_view word)
{
    const std::size_t unit = word.find_first_of("sS");
    return unit == 0 ? word : word.substr(0, unit);
}

/// New files: `NPTS=  4000, DT= .01000 SEC`. Old ones: `7997 0.0050 NPTS, DT`.
Sampling read_sampling(const Lines& lines)
{
    const std::string_view line = lines.line();
    std::optional<std::string_view> count = value_of(line, "NPTS");
    std::optional<std::string_view> step = value_of(line, "DT");
    if (!count && !step && contains(line, "DT")) {
        count = first_word(line);
        step = first_word(line.substr(std::size_t(count->data() - line.data()) + count->size()));
    }
    if (!count || !step || count->empty() || step->empty()) {
        lines.refuse(fmt::format("{} lacks the number of points or the time step. Write it as in "
                                 "NPTS= 4000, DT= .01 SEC.",
                                 quoted_bytes(line)));
    }
    const char* after = step->data() + step->size();
    if (line.data() + line.size() - after > 1 && after[0] == ',' && '0' <= after[1] &&
        after[1] <= '9') {
        lines.refuse(fmt::format("the time step {} has a decimal comma. Write it with a point, as "
                                 "in DT= .01 SEC.",
                                 quoted_bytes(std::string_view(step->data(), step->size() + 2))));
    }
    const std::string_view unit =
        first_word(trimmed(line.substr(std::size_t(step->data() - line.data()) + step->size())));
    const std::string of_step = simplified(unit.substr(0, unit.find_first_of(",;.")));
    const bool is_word = !of_step.empty() && 'a' <= of_step[0] && of_step[0] <= 'z';
    if (is_word && of_step[0] != 's' && of_step != "npts") {
        lines.refuse(fmt::format("the unit {} of the time step is not understood. Write it in "
                                 "seconds, as in DT= .01 SEC.",
                                 quoted_bytes(unit)));
    }
    return {.count = count_of(lines, *count, "NPTS"),
            .time_step = time_step_of(lines, without_unit(*step))};
}

void expect_acceleration(const Lines& lines)
{
    const std::string_view line = lines.line();
    if (contains(line, "SPECTR") ||
        (!contains(line, "ACCELERATION") &&
         (contains(line, "VELOCITY") || contains(line, "DISPLACEMENT")))) {
        lines.refuse(
            fmt::format("{} does not contain accelerations. Give the AT2 file of this record.",
                        quoted_bytes(trimmed(line))));
    }
}

struct Unit {
    AccelerationUnit unit;
    bool is_given; ///< not stated by the file
};

/// The unit that the header states. If it states none, or one that is not understood, the given
/// one; g if there is neither.
Unit unit_of_header(const Lines& before, const std::optional<AccelerationUnit>& given)
{
    std::optional<StatedUnit> found;
    for (Lines lines = before; lines.number() < header_lines && lines.next();) {
        // The first two lines name the database and the station.
        const auto places =
            lines.number() < unit_line ? UnitPlaces::after_units : UnitPlaces::title;
        for (const StatedUnit& stated : stated_units(lines.line(), places)) {
            if (stated.unit && (!found || found->unit == stated.unit)) {
                found = stated;
                continue;
            }
            if (given) {
                return {*given, true};
            }
            const std::string reason =
                stated.unit ? fmt::format("contradicts {}", quoted_bytes(found->text))
                            : "is not understood";
            lines.refuse(fmt::format("the unit {} {}. Understood are {} and their usual spellings, "
                                     "such as CM/SEC/SEC. State the unit of the samples: {}.",
                                     quoted_bytes(stated.text), reason,
                                     fmt::join(acceleration_unit_names, ", "),
                                     how_to_state("units")));
        }
    }
    return found ? Unit{*found->unit, false}
                 : Unit{given.value_or(AccelerationUnit::g), given.has_value()};
}

} // namespace

RecordFile read_at2(Lines lines, const std::optional<AccelerationUnit>& unit)
{
    RecordComponent component;
    const Lines before = lines;
    Header header;
    for (std::size_t i = 0; i < header_lines; ++i) {
        header.take(lines, 1);
        if (i == 1) { // event, date, station, component
            const std::string_view title = lines.line();
            const std::size_t comma = title.rfind(',');
            component.name = comma == title.npos ? "" : trimmed(title.substr(comma + 1));
        } else if (i + 1 == unit_line) {
            expect_acceleration(lines);
        }
    }
    const Sampling sampling = read_sampling(lines);
    component.header = std::move(header).kept();
    const Unit used = unit_of_header(before, unit);
    component.unit = used.unit;
    component.time_step = sampling.time_step;
    component.acceleration =
        take_free_numbers(lines, {.count = sampling.count, .name = "NPTS", .line = lines.number()});
    return {.format = "AT2", .components = {std::move(component)}, .has_given_unit = used.is_given};
}

} // namespace overturn
