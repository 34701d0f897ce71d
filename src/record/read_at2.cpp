#include "formats.hpp"
#include "numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace overturn {

namespace {

constexpr std::size_t header_lines = 4;

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
                                 quoted(line)));
    }
    return {.count = count_of(lines, *count, "NPTS"),
            .time_step = time_step_of(lines, without_unit(*step))};
}

/// Refuses velocities, displacements, and units other than g, in `ACCELERATION TIME SERIES IN UNITS
/// OF G`.
void expect_acceleration_in_g(const Lines& lines)
{
    const std::string_view line = lines.line();
    if (!contains(line, "ACCELERATION") &&
        (contains(line, "VELOCITY") || contains(line, "DISPLACEMENT"))) {
        lines.refuse(
            fmt::format("{} does not contain accelerations. Give the AT2 file of this record.",
                        quoted(trimmed(line))));
    }
    const std::size_t place = place_after(line, "UNITS OF");
    if (place == line.npos) {
        return;
    }
    const std::string_view unit = trimmed(line.substr(place));
    const std::string_view word = unit.substr(0, unit.find_first_of(" \t,.;"));
    if (word != "G" && word != "g") {
        lines.refuse(fmt::format("the unit is {}, but must be G in AT2 files. Give the values as "
                                 "text with their unit.",
                                 quoted(word)));
    }
}

} // namespace

RecordFile read_at2(Lines lines)
{
    RecordComponent component;
    Header header;
    for (std::size_t i = 0; i < header_lines; ++i) {
        header.take(lines, 1);
        if (i == 1) { // event, date, station, component
            const std::string_view title = lines.line();
            const std::size_t comma = title.rfind(',');
            component.name = comma == title.npos ? "" : trimmed(title.substr(comma + 1));
        } else if (i == 2) {
            expect_acceleration_in_g(lines);
        }
    }
    const Sampling sampling = read_sampling(lines);
    component.header = std::move(header).kept();
    component.time_step = sampling.time_step;
    component.unit = AccelerationUnit::g;
    component.acceleration =
        take_free_numbers(lines, {.count = sampling.count, .name = "NPTS", .line = lines.number()});
    return {.format = "AT2", .components = {std::move(component)}};
}

} // namespace overturn
