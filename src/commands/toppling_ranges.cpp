#include "toppling_ranges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace overturn {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Under a pulse, steps of 0.1 times the acceleration that lifts the block find the flips; see
/// docs/boundaries.md.
std::vector<double> scan(const Scene& scene, double first, double last)
{
    const double steps = scene.is_recorded() ? std::log(last / first) / toppling_step
                                             : std::min((last - first) / (0.1 * first), 2000.0);
    const std::int64_t count = 1 + std::int64_t(std::ceil(std::max(steps, 50.0)));
    return Axis(AxisRange{first, last, count, scene.is_recorded() ? Spacing::log : Spacing::linear})
        .values();
}

} // namespace

TopplingRanges toppling_ranges(const Scene& scene, const BoundaryLine& line, double first,
                               double last, double included)
{
    TopplingRanges ranges;
    if (!(first < last)) {
        return ranges;
    }
    SearchResolution resolution = search_resolution(scene);
    if (scene.is_recorded()) { // an answer in seconds
        // Above every step of the scan, which is therefore not divided.
        resolution.finest_step = 2 * toppling_step;
        resolution.most_in_50_digits = 0;
    }
    std::vector<double> accelerations = scan(scene, first, last);
    const auto place = std::lower_bound(accelerations.begin(), accelerations.end(), included);
    if (first < included && included < last && *place != included) {
        accelerations.insert(place, included);
    }
    const Boundary boundary =
        boundary_on(scene, line, accelerations, widest_kernel(),
                    std::numeric_limits<std::size_t>::max(), nullptr, resolution);
    ranges.undecided_share = boundary.undecided_share;

    // Undecided accelerations belong to the range next to them; those between safe ones to none.
    bool topples = is_unsafe(boundary.region_at_first);
    double begin = first;
    double settled_until = first;
    for (const Flip& flip : boundary.flips) {
        if (flip.region_above == Region::undecided) {
            settled_until = flip.amplitude();
            continue;
        }
        const bool was_undecided = flip.region_below == Region::undecided;
        if (is_unsafe(flip.region_above) == topples) {
            continue;
        }
        topples = !topples;
        if (topples) {
            begin = was_undecided ? settled_until : flip.amplitude();
            // The safe accelerations between two ranges may all have been undecided.
            if (!ranges.toppling.empty() && ranges.toppling.back().last >= begin) {
                begin = ranges.toppling.back().first;
                ranges.toppling.pop_back();
            }
        } else {
            ranges.toppling.push_back({begin, flip.amplitude()});
        }
    }
    if (topples) {
        ranges.toppling.push_back({begin, infinity});
    }
    return ranges;
}

std::string TopplingRanges::text(int decimals, std::size_t most) const
{
    std::string line;
    for (std::size_t i = 0; i < toppling.size(); ++i) {
        const bool is_last = i + 1 == toppling.size();
        if (i + 1 >= most && !is_last) {
            continue;
        }
        line += line.empty() ? "" : ", ";
        if (is_last && i >= most) {
            line += fmt::format("{} more, ", toppling.size() - most);
        }
        const auto& [first, last] = toppling[i];
        line += std::isinf(last)
                    ? fmt::format("above {:.{}f} g", first, decimals)
                    : fmt::format("{:.{}f} to {:.{}f} g", first, decimals, last, decimals);
    }
    return line.empty() ? "none" : line;
}

int TopplingRanges::decimals(double pga) const
{
    std::vector<double> numbers{pga};
    for (const Range& range : toppling) {
        numbers.push_back(range.first);
        numbers.push_back(range.last);
    }
    std::sort(numbers.begin(), numbers.end());
    int decimals = 4;
    const auto look_the_same = [&](double a, double b) {
        return a != b && fmt::format("{:.{}f}", a, decimals) == fmt::format("{:.{}f}", b, decimals);
    };
    while (decimals < std::numeric_limits<double>::digits10 &&
           std::adjacent_find(numbers.begin(), numbers.end(), look_the_same) != numbers.end()) {
        ++decimals;
    }
    return decimals;
}

std::string TopplingRanges::json() const
{
    std::string list;
    for (const Range& range : toppling) {
        list += fmt::format("{}[{}, {}]", list.empty() ? "" : ", ", range.first,
                            std::isinf(range.last) ? "null" : fmt::format("{}", range.last));
    }
    return "[" + list + "]";
}

} // namespace overturn
