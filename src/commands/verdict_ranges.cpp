#include "verdict_ranges.hpp"

#include "overturn/problem/axis.hpp"

#include <fmt/format.h>

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

/// Rounded outwards; ranges that touch or overlap then are one.
std::vector<VerdictRange> rounded(const std::vector<VerdictRange>& ranges, int decimals)
{
    std::vector<VerdictRange> all;
    for (VerdictRange range : ranges) {
        range.first = rounded_down(range.first, decimals);
        range.last = rounded_up(range.last, decimals);
        if (!all.empty() && range.first <= all.back().last) {
            all.back().last = range.last;
        } else {
            all.push_back(range);
        }
    }
    return all;
}

/// "1.1110 to 1.6440 g" for each range, and "above 2.1300 g" if the last one reaches the end of the
/// search; at most this many, including the last.
std::string list_of(const std::vector<VerdictRange>& ranges, int decimals, std::size_t most,
                    double end_of_search)
{
    std::string list;
    const std::vector<VerdictRange> shown = rounded(ranges, decimals);
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const bool is_last = i + 1 == shown.size();
        if (i + 1 >= most && !is_last) {
            continue;
        }
        list += list.empty() ? "" : ", ";
        if (is_last && i >= most) {
            list += fmt::format("{} more (see --json), ", shown.size() - most);
        }
        const auto& [first, last, verdict] = shown[i];
        list += last >= end_of_search ? fmt::format("above {:.{}f} g", first, decimals)
                : first == last
                    ? fmt::format("{:.{}f} g", first, decimals)
                    : fmt::format("{:.{}f} to {:.{}f} g", first, decimals, last, decimals);
    }
    return list;
}

} // namespace

double rounded_down(double value, int decimals)
{
    const auto nearest_to = [&](double number) {
        return std::stod(fmt::format("{:.{}f}", number, decimals));
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
    std::vector<double> accelerations = scanned_accelerations(scene, lifting, end);
    const auto place = std::lower_bound(accelerations.begin(), accelerations.end(), included);
    if (lifting < included && included < end && *place != included) {
        accelerations.insert(place, included);
    }
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

std::string VerdictRanges::text(int decimals, std::size_t most) const
{
    const double end = end_of_search();
    std::string text = list_of(with(Verdict::topples), decimals, most, end);
    const std::string undecided = list_of(with(Verdict::undecided), decimals, most, end);
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
    constexpr int most_for_ends = 7; // hundreds of ranges under a slow pulse would need more
    int decimals = 4;
    const auto look_the_same = [&](double a, double b) {
        return a != b && rounded_down(a, decimals) == rounded_down(b, decimals);
    };
    const auto is_unclear = [&](const VerdictRange& range) {
        return (decimals < most_for_ends && look_the_same(range.first, range.last)) ||
               look_the_same(range.last, pga);
    };
    while (decimals < std::numeric_limits<double>::digits10 &&
           std::any_of(all.begin(), all.end(), is_unclear)) {
        ++decimals;
    }
    return decimals;
}

} // namespace overturn
