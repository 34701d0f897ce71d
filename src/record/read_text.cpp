#include "even_times.hpp"
#include "formats.hpp"
#include "numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace overturn {

namespace {

constexpr std::size_t most_columns = 2;

struct Row {
    std::array<std::string_view, most_columns> columns;
    std::size_t size = 0; ///< may exceed most_columns
};

/// Columns are separated by blanks, or by a comma with or without blanks.
Row row_of(std::string_view line)
{
    Row row;
    std::string_view rest = trimmed(line);
    for (bool more = !rest.empty(); more; ++row.size) {
        const std::size_t end = std::min(rest.find_first_of(" \t,"), rest.size());
        if (row.size < most_columns) {
            row.columns[row.size] = rest.substr(0, end);
        }
        rest = trimmed(rest.substr(end));
        more = !rest.empty();
        if (rest.starts_with(',')) {
            rest = trimmed(rest.substr(1)); // another column follows, even if it is empty
        }
    }
    return row;
}

/// The first row decides how many columns there are.
void expect_columns(const Lines& lines, std::size_t found, std::size_t expected)
{
    if (found > most_columns) {
        lines.refuse(fmt::format("the line has {} columns. Give one column of accelerations, or "
                                 "two of times and accelerations; the decimal mark is a point.",
                                 found));
    }
    if (found != expected) {
        lines.refuse(fmt::format("the line has {} column{}, but the previous lines have {}. "
                                 "Correct it.",
                                 found, found == 1 ? "" : "s", expected));
    }
}

void expect_time_step_of_column(const Lines& lines, const std::optional<double>& time_step)
{
    if (!time_step) {
        lines.refuse("the file has one column, so the time step is not known. Give time_step "
                     "in seconds, or two columns with time in seconds first.");
    }
}

void expect_no_time_step(const Lines& lines, const std::optional<double>& time_step)
{
    if (time_step) {
        lines.refuse(fmt::format("time_step = {} was given, but the file has two columns, which "
                                 "state the times. Remove time_step.",
                                 *time_step));
    }
}

} // namespace

RecordFile read_text(Lines lines, const RecordOptions& options)
{
    RecordComponent component;
    component.unit = options.unit.value();
    Header header;
    EvenTimes times;
    std::size_t columns = 0;
    while (lines.next()) {
        if (is_comment(lines.line())) {
            header.add(lines);
            continue;
        }
        const Row row = row_of(lines.line());
        if (row.size == 0) {
            continue;
        }
        const bool is_first = columns == 0;
        columns = is_first ? row.size : columns;
        expect_columns(lines, row.size, columns);
        if (is_first) {
            columns == 1 ? expect_time_step_of_column(lines, options.time_step)
                         : expect_no_time_step(lines, options.time_step);
        }
        if (component.acceleration.size() == most_samples) {
            lines.refuse(fmt::format("the file has more than {} samples, the maximum. Give a "
                                     "shorter record.",
                                     most_samples));
        }
        if (columns == 2) {
            times.add(lines, row.columns[0]);
        }
        component.acceleration.push_back(number_of(lines, row.columns[columns - 1]));
    }
    if (columns == 2 && times.size() == 1) {
        lines.refuse("the file has one sample, but the time step can be determined only from two "
                     "or more. Give the complete file.");
    }
    component.header = std::move(header).kept();
    component.time_step = columns == 1 ? *options.time_step : times.step();
    return {.format = "text", .components = {std::move(component)}};
}

} // namespace overturn
