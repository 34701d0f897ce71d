#include "overturn/sweep/verdict_ranges.hpp"

#include "overturn/problem/axis.hpp"
#include "overturn/problem/coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace overturn {

namespace {

/// Bounds the time of an answer if a slow pulse has hundreds of flips. A line of usual pulses needs
/// a thousand amplitudes, none of them in 50 digits, in which one may take a second.
constexpr std::size_t most_points = 2500;
constexpr int most_in_50_digits = 4;

FlipSearch search_at(const Scene& scene, const Point& point)
{
    FlipSearch search = flip_search(scene, may_slip(point));
    if (scene.motion_traits().is_sensitive) {
        search.most_in_50_digits = 0;
    } else {
        search.most_points = most_points;
        search.most_in_50_digits = most_in_50_digits;
    }
    return search;
}

/// Also the included acceleration, and under a record those next to it, in small steps: the nearest
/// toppling range may be narrower than the steps of the scan.
std::vector<double> with_neighbours(std::vector<double> scan, double included, const Scene& scene)
{
    constexpr int neighbours = 100; // on each side
    constexpr double step = 0.001;  // over the acceleration
    const int most = scene.motion_traits().is_sensitive ? neighbours : 0;
    const double first = scan.front();
    const double last = scan.back();
    for (int i = -most; i <= most; ++i) {
        const double acceleration = included * (1 + i * step);
        if (first < acceleration && acceleration < last) {
            scan.push_back(acceleration);
        }
    }
    std::ranges::sort(scan);
    const auto [begin, end] = std::ranges::unique(scan);
    scan.erase(begin, end);
    return scan;
}

/// Adds the ranges of a boundary from `first` to `last` to those below `first`, if there are any.
void add_ranges(const Boundary& boundary, double first, double last,
                std::vector<VerdictRange>& ranges)
{
    const auto end_last_range_at = [&](double end) {
        ranges.back().last = end;
        // A single safe value does not separate undecided ones.
        if (ranges.size() > 1 && ranges.back().first == end &&
            ranges.back().verdict == Verdict::safe) {
            ranges.pop_back();
            ranges.back().last = end;
        }
    };
    const auto continue_with = [&](Region region, double from) {
        const Verdict verdict = verdict_of(region);
        if (ranges.empty()) {
            ranges.push_back({from, from, verdict});
            return;
        }
        end_last_range_at(from);
        if (ranges.back().verdict != verdict) {
            ranges.push_back({from, from, verdict});
        }
    };
    continue_with(boundary.region_at_first, first);
    for (const Flip& flip : boundary.flips) { // a flip has a width: safe ranges end before it
        continue_with(flip.region_above, is_safe(flip.region_below) ? flip.below : flip.above);
    }
    end_last_range_at(last);
}

} // namespace

Verdict verdict_of(Region region)
{
    return is_safe(region)     ? Verdict::safe
           : is_unsafe(region) ? Verdict::topples
                               : Verdict::undecided;
}

/// Under a pulse, steps of 0.1 times the acceleration that lifts the block find the flips, see
/// docs/boundaries.md, but for narrow strips just above it, which slow pulses cause: there the
/// steps are 200 times smaller.
std::vector<double> scanned_accelerations(const Scene& scene, double first, double last,
                                          double included)
{
    const auto values = [](double from, double to, double steps, Spacing spacing) {
        return Axis(AxisRange{from, to, 1 + std::int64_t(std::ceil(steps)), spacing}).values();
    };
    if (scene.motion_traits().is_sensitive) {
        return with_neighbours(values(first, last,
                                      std::max(std::log(last / first) / toppling_step, 10.0),
                                      Spacing::log),
                               included, scene);
    }
    const double low = std::min(1.3 * first, last);
    std::vector<double> all =
        values(first, low, std::max((low - first) / (0.0005 * first), 10.0), Spacing::linear);
    if (low < last) {
        const std::vector<double> rest = values(
            low, last, std::clamp((last - low) / (0.1 * first), 10.0, 2000.0), Spacing::linear);
        all.insert(all.end(), rest.begin() + 1, rest.end());
    }
    return with_neighbours(std::move(all), included, scene);
}

VerdictRanges verdict_ranges(const Scene& scene, const BoundaryLine& line, double lifting,
                             double end, double included, const DropRequested& drop_requested)
{
    VerdictRanges ranges;
    ranges.begin_of_search = lifting;
    const double computable = last_before_free_fall(scene, line);
    ranges.ends_in_free_fall = computable < end;
    end = std::min(end, computable);
    if (!(lifting < end)) {
        ranges.all.push_back({0, end, Verdict::safe});
        return ranges;
    }
    const std::vector<double> accelerations = scanned_accelerations(scene, lifting, end, included);
    FlipSearch search = search_at(scene, line.point);
    search.drop_requested = drop_requested;
    if (scene.motion_traits().is_sensitive) {
        search.finest_step = 2 * toppling_step; // above every step: the scan is not divided
    }
    const Boundary boundary = boundary_on(scene, line, accelerations, widest_kernel(), search);
    ranges.coarse = boundary.coarse;
    ranges.all.push_back({0, lifting, Verdict::safe});
    add_ranges(boundary, lifting, end, ranges.all);
    return ranges;
}

VerdictRanges verdict_ranges(const Scene& scene, const QuantityLine& line, double first,
                             double last)
{
    const Boundary boundary = boundary_on(scene, line, {first, last}, widest_kernel(),
                                          search_at(scene, line.points(scene, {first}).front()));
    VerdictRanges ranges{.all = {}, .begin_of_search = first, .coarse = boundary.coarse};
    add_ranges(boundary, first, last, ranges.all);
    return ranges;
}

VerdictRanges worst_of(const std::vector<VerdictRanges>& each)
{
    VerdictRanges worst{.all = {}, .begin_of_search = each.front().begin_of_search};
    std::vector<double> ends{worst.begin_of_search};
    for (const VerdictRanges& ranges : each) {
        for (const VerdictRange& range : ranges.all) {
            ends.push_back(range.last);
        }
        if (const auto& coarse = ranges.coarse) {
            const CoarseSearch& so_far = worst.coarse.value_or(*coarse);
            worst.coarse = {std::min(so_far.first, coarse->first),
                            std::max(so_far.last, coarse->last),
                            std::max(so_far.step, coarse->step)};
        }
    }
    std::ranges::sort(ends);
    for (std::size_t i = 1; i < ends.size(); ++i) {
        if (ends[i] == ends[i - 1]) {
            continue;
        }
        Verdict verdict = Verdict::safe;
        for (const VerdictRanges& ranges : each) {
            verdict = std::max(verdict, ranges.verdict_at(std::midpoint(ends[i - 1], ends[i])));
        }
        if (worst.all.empty() || worst.all.back().verdict != verdict) {
            worst.all.push_back({ends[i - 1], ends[i], verdict});
        }
        worst.all.back().last = ends[i];
    }
    return worst;
}

std::vector<VerdictRange> VerdictRanges::with(Verdict verdict) const
{
    std::vector<VerdictRange> ranges = all;
    std::erase_if(ranges, [&](const VerdictRange& each) { return each.verdict != verdict; });
    return ranges;
}

double VerdictRanges::undecided_share() const
{
    double undecided = 0;
    for (const VerdictRange& range : with(Verdict::undecided)) {
        undecided += range.last - range.first;
    }
    return undecided > 0 ? undecided / (end_of_search() - begin_of_search) : 0;
}

Verdict VerdictRanges::verdict_at(double value) const
{
    Verdict worst = Verdict::safe;
    for (const VerdictRange& range : all) {
        if (range.first <= value && value <= range.last) {
            worst = std::max(worst, range.verdict);
        }
    }
    return worst;
}

std::optional<double> VerdictRanges::nearest_below(Verdict verdict, double value) const
{
    std::optional<double> nearest;
    for (const VerdictRange& range : with(verdict)) {
        if (range.first < value) {
            nearest = std::min(range.last, value);
        }
    }
    return nearest;
}

std::optional<double> VerdictRanges::nearest_above(Verdict verdict, double value) const
{
    for (const VerdictRange& range : with(verdict)) {
        if (range.last > value) {
            return std::max(range.first, value);
        }
    }
    return std::nullopt;
}

std::optional<double> VerdictRanges::safe_from() const
{
    return all.back().verdict == Verdict::safe ? std::optional(all.back().first) : std::nullopt;
}

std::optional<double> VerdictRanges::safe_up_to() const
{
    return all.front().verdict == Verdict::safe ? std::optional(all.front().last) : std::nullopt;
}

} // namespace overturn
