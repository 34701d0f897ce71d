#include "probable_mistakes.hpp"

#include "overturn/job/nearest_name.hpp"
#include "overturn/job/schema.hpp"
#include "overturn/problem/plausibility.hpp"
#include "overturn/text/quoting.hpp"

#include <boost/algorithm/string/predicate.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

namespace {

/// How many words of the name of a quantity or of its synonyms begin with four letters that the
/// column contains, ignoring case.
int shared_words(std::string_view column, std::string_view quantity)
{
    std::string words(quantity);
    words += quantity == "incline"         ? "_lean_tilt"
             : quantity == "center_offset" ? "_eccentricity"
                                           : "";
    return int(std::ranges::count_if(words | std::views::split('_'), [&](const auto& word) {
        const auto beginning = std::string_view(word.begin(), word.end()).substr(0, 4);
        return beginning.size() > 2 && boost::algorithm::icontains(column, beginning);
    }));
}

/// The quantity that a column without effect probably gives: its name is misspelt, or shares a word
/// with it, as in incline_deg. Empty if there is none, or if the points do not lack it.
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
        if (const int shared = shared_words(column, name); shared > most) {
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
