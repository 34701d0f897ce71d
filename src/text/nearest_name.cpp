#include "overturn/text/nearest_name.hpp"

#include "overturn/text/quoting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace overturn {

namespace {

/// The number of letters to insert, remove, replace or swap with their neighbour to turn one word
/// into the other (optimal string alignment).
std::size_t edit_distance(std::string_view from, std::string_view to)
{
    // distance[i][j]: between the first i letters of `from` and the first j of `to`.
    std::vector<std::vector<std::size_t>> distance(from.size() + 1,
                                                   std::vector<std::size_t>(to.size() + 1));
    for (std::size_t i = 0; i <= from.size(); ++i) {
        for (std::size_t j = 0; j <= to.size(); ++j) {
            if (i == 0 || j == 0) {
                distance[i][j] = i + j;
                continue;
            }
            distance[i][j] = std::min({distance[i - 1][j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1),
                                       distance[i - 1][j] + 1, distance[i][j - 1] + 1});
            if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1]) {
                distance[i][j] = std::min(distance[i][j], distance[i - 2][j - 2] + 1);
            }
        }
    }
    return distance[from.size()][to.size()];
}

/// Whether a word is part of a longer one: some of the words that underscores separate.
bool is_part(std::string_view part, std::string_view whole)
{
    const std::size_t place = fmt::format("_{}_", whole).find(fmt::format("_{}_", part));
    return !part.empty() && part.size() < whole.size() && place != std::string::npos;
}

bool is_beginning(std::string_view beginning, std::string_view word)
{
    constexpr std::size_t fewest = 3; // letters
    return beginning.size() >= fewest && word.starts_with(beginning);
}

} // namespace

std::string_view nearest_name(std::string_view word, std::span<const std::string_view> names)
{
    std::string_view nearest;
    std::size_t least = word.size() + 1;
    for (const std::string_view name : names) {
        const auto [shorter, longer] = std::minmax({word.size(), name.size()});
        // The distance is at least the difference in length; this skips huge words.
        if (3 * (longer - shorter) > longer) {
            continue;
        }
        const std::size_t distance = edit_distance(lower(word), lower(name));
        if (3 * distance <= longer && distance < least) {
            nearest = name;
            least = distance;
        }
    }
    const bool is_far = nearest.empty();
    const std::string meant = word == "mu" ? "friction_coefficient" : lower(word);
    least = std::numeric_limits<std::size_t>::max();
    for (auto name = names.begin(); is_far && name != names.end(); ++name) {
        const auto [shorter, longer] = std::minmax({meant.size(), name->size()});
        if ((is_part(meant, *name) || is_part(*name, meant) || is_beginning(*name, meant)) &&
            longer - shorter < least) {
            nearest = *name;
            least = longer - shorter;
        }
    }
    return nearest;
}

std::string suggestion(std::string_view word, std::span<const std::string_view> names,
                       std::string_view prefix)
{
    const std::string_view name = nearest_name(word, names);
    return name.empty() ? "" : fmt::format(" Did you mean \"{}{}\"?", prefix, name);
}

} // namespace overturn
