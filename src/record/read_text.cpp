#include "even_times.hpp"
#include "formats.hpp"
#include "numbers.hpp"
#include "stated_unit.hpp"

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
        lines.refuse(fmt::format("the file has one column, so the time step is not known. Give "
                                 "two columns with time in seconds first, or the time step in "
                                 "seconds: {}.",
                                 how_to_state("time_step")));
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

/// Whether a comma is between two digits, as in 1,5: it separates two columns or is a decimal mark.
bool has_doubtful_comma(std::string_view line)
{
    const auto is_digit = [&](std::size_t i) {
        return i < line.size() && '0' <= line[i] && line[i] <= '9';
    };
    for (std::size_t i = line.find(','); i != line.npos; i = line.find(',', i + 1)) {
        if (i > 0 && is_digit(i - 1) && is_digit(i + 1)) {
            return true;
        }
    }
    return false;
}

/// Refuses decimal commas: commas between digits in a file without any decimal point.
void expect_decimal_points(Lines lines)
{
    std::optional<Lines> doubtful;
    while (lines.next()) {
        if (is_comment(lines.line())) {
            continue;
        }
        if (lines.line().find('.') != std::string_view::npos) {
            return;
        }
        if (!doubtful && has_doubtful_comma(lines.line())) {
            doubtful = lines;
        }
    }
    if (doubtful) {
        doubtful->refuse(fmt::format(
            "{} may be a number with a decimal comma, because the file has no decimal point. Write "
            "numbers with a point, and separate columns by blanks.",
            quoted_bytes(trimmed(doubtful->line()))));
    }
}

} // namespace

RecordFile read_text(Lines lines, const RecordOptions& options)
{
    expect_decimal_points(lines);
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
    return {.format = "text", .components = {std::move(component)}, .has_given_unit = true};
}

} // namespace overturn
