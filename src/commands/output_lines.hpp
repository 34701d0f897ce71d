// The lines that commands print: messages, warnings, and rows of a name and a text.
#pragma once

#include "overturn/text/quoting.hpp"

#include "overturn/job/job.hpp"
#include "overturn/job/nearest_name.hpp"
#include "overturn/problem/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// Prints a line and flushes it, so that it appears in a log at once, before the progress of a run.
/// Errors are ignored: a run continues if the reader of its log ends.
inline void say(const std::string& line)
{
    std::puts(line.c_str());
    std::fflush(stdout);
}

/// How many words of the two names begin with the same four letters, ignoring case; shorter words
/// are equal.
inline int shared_words(std::string_view one, std::string_view other)
{
    using std::views::split;
    const auto lower_case = [](unsigned char letter) { return std::tolower(letter); };
    const auto begins_alike = [&](const auto& a, const auto& b) {
        const auto [end, other_end] = std::ranges::mismatch(a, b, {}, lower_case, lower_case);
        const auto length = end - a.begin();
        return length >= 4 || (length == 3 && end == a.end() && other_end == b.end());
    };
    return int(std::ranges::count_if(one | split('_'), [&](const auto& word) {
        return std::ranges::any_of(other | split('_'), [&](const auto& other_word) {
            return begins_alike(word, other_word);
        });
    }));
}

/// The quantity that a column without effect probably gives: its name is misspelt, or has a word in
/// common with it, as in incline_deg. Empty if there is none, or if the points do not lack it.
inline std::string_view quantity_meant_by(std::string_view column, const Grid& grid)
{
    const auto is_lacking = [&](std::string_view name) {
        const auto excludes = [&](const Column& given) {
            return given.quantity->name == name || exclude_each_other(given.quantity->name, name);
        };
        return std::ranges::none_of(grid.numbers, excludes) &&
               std::ranges::none_of(grid.dimensions, [&](const Dimension& each) {
                   return std::ranges::any_of(each.columns, excludes);
               });
    };
    std::vector<std::string_view> names = axis_names();
    std::erase_if(names, [&](std::string_view name) { return !is_lacking(name); });
    if (const std::string_view nearest = nearest_name(column, names); !nearest.empty()) {
        return nearest;
    }
    std::string_view meant;
    int most = 0;
    for (const std::string_view name : names) {
        const std::string_view other_words = name == "incline"         ? "lean_tilt"
                                             : name == "center_offset" ? "eccentricity"
                                                                       : "";
        const int shared = shared_words(column, name) + shared_words(column, other_words);
        if (shared > most) {
            most = shared;
            meant = name;
        }
    }
    return meant;
}

/// Prints to stderr what looks like a mistake in the units, and misspelt columns of a table.
inline void warn_of_probable_mistakes(const Job& job)
{
    const auto warn = [](const std::string& text) {
        std::fflush(stdout);
        fmt::print(stderr, "overturn: warning: {}.\n", printable(text));
    };
    const Grid& grid = job.problem.grid;
    if (const std::string values = implausible_values(job.problem.scene, grid); !values.empty()) {
        warn(values);
    }
    for (const TableColumn& column :
         job.blocks ? job.blocks->table.columns : std::vector<TableColumn>()) {
        const std::string_view meant =
            grid.has_table_column(column.name) ? "" : quantity_meant_by(column.name, grid);
        if (!meant.empty()) {
            warn(fmt::format("the column {} of {} has no effect (did you mean {}?)",
                             in_quotes(column.name), job.blocks->file, meant));
        }
    }
}

/// The unit of a quantity after a number: begins with a blank, or is empty.
inline std::string unit_text(const Quantity& quantity)
{
    return quantity.name == "pga"               ? " g"
           : quantity.name == "pulse_frequency" ? " Hz"
           : quantity.units == "1"              ? ""
           : quantity.units == "s-1"            ? " 1/s"
                                                : fmt::format(" {}", quantity.units);
}

inline void print_row(std::string_view name, std::string_view text)
{
    fmt::print("{:<12} {}\n", name, text);
}

/// The row of a coordinate; `unit` is appended to the values.
inline void print_axis(std::string_view name, std::int64_t size, double first, double last,
                       std::string_view unit)
{
    const bool is_share = name == "restitution_of_maximum"; // too long for the column of names
    print_row(is_share ? "restitution" : name,
              fmt::format("{}{}{}",
                          size == 1 ? fmt::to_string(first)
                                    : fmt::format("{} values from {} to {}", size, first, last),
                          unit, is_share ? ", of the maximum" : ""));
}

} // namespace overturn
