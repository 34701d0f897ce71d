#include "probable_mistakes.hpp"

#include "overturn/job/nearest_name.hpp"
#include "overturn/job/schema.hpp"
#include "overturn/problem/plausibility.hpp"
#include "overturn/text/quoting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

namespace {

/// How many words of the two names begin with the same four letters, ignoring case; shorter words
/// are equal.
int shared_words(std::string_view one, std::string_view other)
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
std::string_view quantity_meant_by(std::string_view column, const Grid& grid)
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

} // namespace

void warn_of_probable_mistakes(const Job& job)
{
    const auto warn = [](const std::string& text) {
        std::fflush(stdout);
        fmt::print(stderr, "overturn: warning: {}.\n", printable(text));
    };
    const Grid& grid = job.problem.grid;
    const auto is_key_of_scene = [](const std::string& name) {
        return std::ranges::count(keys_of("scene"), name) > 0;
    };
    if (const std::string values = implausible_values(job.problem.scene, grid); !values.empty()) {
        warn(values);
    }
    for (const TableColumn& column :
         job.blocks ? job.blocks->table.columns : std::vector<TableColumn>()) {
        if (grid.has_table_column(column.name)) {
            continue;
        }
        if (is_key_of_scene(column.name) || find_quantity(column.name) != nullptr) {
            warn(fmt::format("the column {} of {} has no effect: it is a key of the job, but not a "
                             "property of the blocks under this ground motion",
                             in_quotes(column.name), job.blocks->file));
        } else if (const std::string_view meant = quantity_meant_by(column.name, grid);
                   !meant.empty()) {
            warn(fmt::format("the column {} of {} has no effect (did you mean {}?)",
                             in_quotes(column.name), job.blocks->file, meant));
        }
    }
}

} // namespace overturn
