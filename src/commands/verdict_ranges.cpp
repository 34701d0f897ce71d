#include "verdict_ranges.hpp"

#include "overturn/problem/axis.hpp"
#include "overturn/text/mapped.hpp"
#include "overturn/text/parse_number.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace overturn {

namespace {

/// Bounds the time of an answer if a slow pulse has hundreds of flips. A line of usual pulses needs
/// a thousand amplitudes, none of them in 50 digits, in which one may take a second.
constexpr std::size_t most_amplitudes = 2500;
constexpr int most_in_50_digits = 4;

FlipSearch search_in(const Scene& scene, const DropRequested& drop_requested)
{
    FlipSearch search = flip_search(scene);
    search.drop_requested = drop_requested;
    if (scene.is_recorded()) {
        // Above every step of the scan, which is therefore not divided.
        search.finest_step = 2 * toppling_step;
        search.most_in_50_digits = 0;
    } else {
        search.most_amplitudes = most_amplitudes;
        search.most_in_50_digits = most_in_50_digits;
    }
    return search;
}

/// One interval of both; each may be a single acceleration.
VerdictInterval joined(const VerdictInterval& one, const VerdictInterval& next)
{
    const auto width = [](const VerdictInterval& each) { return each.last - each.first; };
    VerdictInterval both{one.first, next.last};
    if (width(both) > 0) {
        both.share = (one.share * width(one) + next.share * width(next)) / width(both);
    }
    return both;
}

/// Rounded outwards; intervals that touch or overlap then are one.
std::vector<VerdictInterval> rounded(const std::vector<VerdictInterval>& intervals, int decimals)
{
    std::vector<VerdictInterval> all;
    for (VerdictInterval interval : intervals) {
        interval.first = rounded_down(interval.first, decimals);
        interval.last = rounded_up(interval.last, decimals);
        if (!all.empty() && interval.first <= all.back().last) {
            all.back() = joined(all.back(), interval);
        } else {
            all.push_back(interval);
        }
    }
    return all;
}

/// "above 2.1300 g" if the interval reaches the end of the search, otherwise "1.1110 to 1.6440 g";
/// "34 % of 1.1110 to 1.6440 g" if only a part of it has the verdict.
std::string text_of(const VerdictInterval& interval, int decimals, double end_of_search)
{
    constexpr double whole = 0.995; // rounded to per cent
    const auto& [first, last, share] = interval;
    const bool is_whole = share >= whole;
    if (is_whole && last >= end_of_search) {
        return fmt::format("above {:.{}f} g", first, decimals);
    }
    if (first == last) {
        return fmt::format("{:.{}f} g", first, decimals);
    }
    return fmt::format("{}{:.{}f} to {:.{}f} g",
                       is_whole ? "" : fmt::format("{:.0f} % of ", std::max(100 * share, 1.0)),
                       first, decimals, last, decimals);
}

std::string list_of(const std::vector<VerdictInterval>& intervals, int decimals,
                    double end_of_search)
{
    const auto texts = mapped(rounded(intervals, decimals), [&](const VerdictInterval& each) {
        return text_of(each, decimals, end_of_search);
    });
    return fmt::format("{}", fmt::join(texts, ", "));
}

} // namespace

double rounded_down(double value, int decimals)
{
    const auto nearest_to = [&](double number) {
        return parse_number(fmt::format("{:.{}f}", number, decimals)).value;
    };
    const double nearest = nearest_to(value);
    return nearest <= value ? nearest : nearest_to(nearest - std::pow(10, -decimals));
}

Verdict verdict_of(Region region)
{
    return is_safe(region)     ? Verdict::safe
           : is_unsafe(region) ? Verdict::topples
                               : Verdict::undecided;
}

/// Under a pulse, steps of 0.1 times the acceleration that lifts the block find the flips, see
/// docs/boundaries.md, but for narrow strips just above it, which slow pulses cause: there the
/// steps are 200 times smaller.
std::vector<double> scanned_accelerations(const Scene& scene, double first, double last)
{
    const auto values = [](double from, double to, double steps, Spacing spacing) {
        return Axis(AxisRange{from, to, 1 + std::int64_t(std::ceil(steps)), spacing}).values();
    };
    if (scene.is_recorded()) {
        return values(first, last, std::max(std::log(last / first) / toppling_step, 10.0),
                      Spacing::log);
    }
    const double low = std::min(1.3 * first, last);
    std::vector<double> all =
        values(first, low, std::max((low - first) / (0.0005 * first), 10.0), Spacing::linear);
    if (low < last) {
        const std::vector<double> rest = values(
            low, last, std::clamp((last - low) / (0.1 * first), 10.0, 2000.0), Spacing::linear);
        all.insert(all.end(), rest.begin() + 1, rest.end());
    }
    return all;
}

namespace {

/// Also the included acceleration, and under a record those next to it, in small steps: the nearest
/// toppling range may be narrower than the steps of the scan.
std::vector<double> with_neighbours(std::vector<double> scan, double included, const Scene& scene)
{
    constexpr int neighbours = 20; // on each side
    constexpr double step = 0.001; // over the acceleration
    const int most = scene.is_recorded() ? neighbours : 0;
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

} // namespace

VerdictRanges verdict_ranges(const Scene& scene, const BoundaryLine& line, double lifting,
                             double end, double included, const DropRequested& drop_requested)
{
    VerdictRanges ranges;
    ranges.lifting = lifting;
    if (scene.is_recorded()) {
        const double free_fall =
            scene.records[std::size_t(line.point.record)]->free_fall_scale() * std::abs(line.unit);
        // Just below, by more than the roundings of a scale.
        const double last = free_fall * (1 - 4 * std::numeric_limits<double>::epsilon());
        ranges.ends_in_free_fall = last < end;
        end = std::min(end, last);
    }
    if (!(lifting < end)) {
        ranges.all.push_back({0, end, Verdict::safe});
        return ranges;
    }
    const std::vector<double> accelerations =
        with_neighbours(scanned_accelerations(scene, lifting, end), included, scene);
    const Boundary boundary =
        boundary_on(scene, line, accelerations, widest_kernel(), search_in(scene, drop_requested));
    ranges.coarse = boundary.coarse;
    ranges.all.push_back({0, lifting, Verdict::safe});
    const auto end_last_range_at = [&](double last) {
        ranges.all.back().last = last;
        // A single safe acceleration does not separate undecided ones.
        if (ranges.all.back().first == last && ranges.all.back().verdict == Verdict::safe) {
            ranges.all.pop_back();
            ranges.all.back().last = last;
        }
    };
    const auto continue_with = [&](Region region, double from) {
        end_last_range_at(from);
        if (const Verdict verdict = verdict_of(region); ranges.all.back().verdict != verdict) {
            ranges.all.push_back({from, from, verdict});
        }
    };
    continue_with(boundary.region_at_first, lifting);
    for (const Flip& flip : boundary.flips) { // a flip has a width: safe ranges end before it
        continue_with(flip.region_above, is_safe(flip.region_below) ? flip.below : flip.above);
    }
    end_last_range_at(end);
    return ranges;
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
    return undecided > 0 ? undecided / (end_of_search() - lifting) : 0;
}

Verdict VerdictRanges::verdict_at(double pga) const
{
    for (const Verdict verdict : {Verdict::topples, Verdict::undecided}) {
        const bool has_it = std::ranges::any_of(with(verdict), [&](const VerdictRange& range) {
            return range.first <= pga && pga <= range.last;
        });
        if (has_it) {
            return verdict;
        }
    }
    return Verdict::safe;
}

std::optional<double> VerdictRanges::nearest_below(Verdict verdict, double pga) const
{
    std::optional<double> nearest;
    for (const VerdictRange& range : with(verdict)) {
        if (range.first < pga) {
            nearest = std::min(range.last, pga);
        }
    }
    return nearest;
}

std::optional<double> VerdictRanges::nearest_above(Verdict verdict, double pga) const
{
    for (const VerdictRange& range : with(verdict)) {
        if (range.last > pga) {
            return std::max(range.first, pga);
        }
    }
    return std::nullopt;
}

std::vector<VerdictInterval> VerdictRanges::intervals(Verdict verdict, std::size_t most) const
{
    std::vector<VerdictInterval> shown = mapped(with(verdict), [](const VerdictRange& range) {
        return VerdictInterval{range.first, range.last};
    });
    const bool reaches_end = !shown.empty() && shown.back().last == end_of_search();
    const auto gap_after = [&](std::size_t i) { return shown[i + 1].first / shown[i].last; };
    while (shown.size() > most) {
        std::size_t closest = 0;
        for (std::size_t i = 1; i + 1 + std::size_t(reaches_end) < shown.size(); ++i) {
            closest = gap_after(i) < gap_after(closest) ? i : closest;
        }
        shown[closest] = joined(shown[closest], shown[closest + 1]);
        shown.erase(shown.begin() + std::ptrdiff_t(closest) + 1);
    }
    return shown;
}

std::string VerdictRanges::text(int decimals, std::size_t most) const
{
    const double end = end_of_search();
    std::string text = list_of(intervals(Verdict::topples, most), decimals, end);
    const std::string undecided = list_of(intervals(Verdict::undecided, most), decimals, end);
    text = text.empty() ? "none" : text;
    text += undecided.empty() ? "" : "; undecided: " + undecided;
    text += fmt::format(", searched up to {} g", rounded_down(end, 6));
    if (coarse) {
        text += fmt::format(", from {:.{}f} to {:.{}f} g only in steps of up to {:.2g} %",
                            rounded_down(coarse->first, decimals), decimals,
                            rounded_up(coarse->last, decimals), decimals, 100 * coarse->step);
    }
    return text;
}

int VerdictRanges::decimals(double pga) const
{
    constexpr int most_for_ends = 7; // narrow ranges would need more
    std::vector<double> ends;
    for (const Verdict verdict : {Verdict::topples, Verdict::undecided}) {
        for (const VerdictInterval& interval : intervals(verdict, most_shown)) {
            ends.insert(ends.end(), {interval.first, interval.last});
        }
    }
    std::ranges::sort(ends);
    int decimals = 4;
    const auto look_the_same = [&](double a, double b) {
        return a != b && rounded_down(a, decimals) == rounded_down(b, decimals);
    };
    const auto are_unclear = [&] {
        return std::ranges::any_of(ends, [&](double end) { return look_the_same(end, pga); }) ||
               (decimals < most_for_ends &&
                std::ranges::adjacent_find(ends, look_the_same) != ends.end());
    };
    while (decimals < std::numeric_limits<double>::digits10 && are_unclear()) {
        ++decimals;
    }
    return decimals;
}

} // namespace overturn
