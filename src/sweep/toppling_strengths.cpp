#include "toppling_strengths.hpp"

#include "point_run.hpp"

#include "overturn/problem/coordinates.hpp"
#include "overturn/text/mapped.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

namespace overturn {

namespace {

/// Verdicts close to a flip need more digits. Of a block that may slip, of which there are none,
/// only the verdict at the asked strength is confirmed.
Numerics numerics_of_search(const Point& point)
{
    return may_slip(point) ? Numerics{.method = Method::taylor}
                           : Numerics{.method = Method::taylor,
                                      .tolerance = tolerance_to_resolve_from,
                                      .resolve = true};
}

using VerdictsAt = std::function<std::vector<Verdict>(std::span<const double> accelerations)>;

/// The first acceleration of a scan, which ascends or descends, at which the block topples.
struct FirstToppling {
    std::optional<double> pga;       ///< at most `width_of_lowest` before it, the block is safe
    std::optional<double> undecided; ///< the first one before it that could not be settled
};

/// safe: an acceleration before those of the scan.
FirstToppling first_toppling(const VerdictsAt& verdicts_at, std::span<const double> scan,
                             double safe)
{
    FirstToppling first;
    // Of these accelerations, all before the first one that topples. Returns whether any is
    // settled.
    const auto look_at = [&](std::span<const double> all, std::optional<double>& undecided) {
        const std::vector<Verdict> verdicts = verdicts_at(all);
        bool has_settled = false;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (verdicts[i] == Verdict::topples) {
                first.pga = all[i];
                return true;
            }
            if (verdicts[i] == Verdict::safe) {
                safe = all[i];
                has_settled = true;
            } else {
                undecided = undecided.value_or(all[i]);
            }
        }
        return has_settled;
    };
    constexpr std::size_t at_once = 32;
    for (std::size_t begin = 0; begin < scan.size() && !first.pga; begin += at_once) {
        look_at(scan.subspan(begin, std::min(at_once, scan.size() - begin)), first.undecided);
    }
    // In steps of a ninth, as many as a pack has lanes at once.
    while (first.pga &&
           std::abs(*first.pga - safe) > width_of_lowest * std::min(*first.pga, safe)) {
        std::vector<double> between;
        for (int i = 1; i <= 8; ++i) {
            between.push_back(safe + (*first.pga - safe) * i / 9);
        }
        std::optional<double> undecided;
        if (!look_at(between, undecided)) {
            first.undecided = first.undecided ? first.undecided : undecided;
            break;
        }
    }
    return first;
}

/// In steps of at most `toppling_step`.
TopplingStrengths strengths_in_steps(const Scene& scene, const BoundaryLine& line,
                                     const StrengthSearch& search, double end)
{
    const double lifting = search.lifting;
    std::vector<double> scan = scanned_accelerations(scene, lifting, end, search.asked);
    const double steps = std::ceil(std::log(end / lifting) / toppling_step);
    for (double i = 1; i < steps; ++i) {
        scan.push_back(lifting * std::pow(end / lifting, i / steps));
    }
    std::ranges::sort(scan);
    const Numerics numerics = numerics_of_search(line.point);
    const VerdictsAt verdicts_at = [&](std::span<const double> accelerations) {
        const PointRun run(scene, line.points(accelerations), widest_kernel());
        const Outcomes outcomes = outcomes_of(run, numerics, {.region = true}, 0);
        return mapped(run.all(), [&](int i) { return verdict_of(outcomes[i].region); });
    };
    TopplingStrengths strengths{.end = end};
    const FirstToppling lowest = first_toppling(verdicts_at, scan, lifting);
    strengths.lowest = lowest.pga;
    strengths.undecided = lowest.undecided;
    if (search.topples_at_asked || !lowest.pga || *lowest.pga > search.asked) {
        strengths.above = lowest.pga;
        return strengths;
    }
    const std::span<const double> all(scan);
    const auto place = std::size_t(std::ranges::lower_bound(scan, search.asked) - scan.begin());
    std::vector<double> downwards(scan.rend() - std::ptrdiff_t(place), scan.rend());
    strengths.below = first_toppling(verdicts_at, downwards, search.asked).pga;
    strengths.above = first_toppling(verdicts_at, all.subspan(place), search.asked).pga;
    return strengths;
}

} // namespace

TopplingStrengths toppling_strengths(const Scene& scene, const BoundaryLine& line,
                                     const StrengthSearch& search)
{
    const double end = std::min(search.end, last_before_free_fall(scene, line));
    if (!(search.lifting < end)) {
        return {.end = end};
    }
    if (!search.is_fine) {
        return strengths_in_steps(scene, line, search, end);
    }
    const VerdictRanges ranges =
        verdict_ranges(scene, line, search.lifting, search.end, search.asked);
    return {.lowest = ranges.nearest_above(Verdict::topples, 0),
            .undecided = ranges.nearest_above(Verdict::undecided, 0),
            .end = ranges.end_of_search(),
            .below = ranges.nearest_below(Verdict::topples, search.asked),
            .above = ranges.nearest_above(Verdict::topples, search.asked)};
}

} // namespace overturn
