#include "flip_search.hpp"

#include "point_run.hpp"

#include "overturn/mechanics/energy_criteria.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/text/mapped.hpp"

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace overturn {

namespace {

/// Verdicts must be right. The scan uses a loose tolerance and resolves verdicts in doubt.
constexpr Numerics scanning{.method = Method::taylor, .tolerance = 1e-6, .resolve = true};

/// An undecided verdict may take a second. After this many, the scan is not refined further.
constexpr std::size_t most_undecided = 16;

/// The outcome of a block at one value.
struct Probe {
    double value;
    Region region;
    double margin;
    double impacts;
    int halving = 0; ///< the halving of the scan that added it
};

double middle_of(const Probe& below, const Probe& above)
{
    return below.value + (above.value - below.value) / 2;
}

/// Whether the verdict changes between neighbours.
bool is_flip(const Probe& below, const Probe& above)
{
    return is_safe(below.region) != is_safe(above.region);
}

/// Whether the margin may turn back towards 0 between three neighbours: it is far from linear, or
/// the numbers of impacts differ and it changes by more than 1/64. For a thousand flips at low
/// frequencies, 1/16 instead of 1/64 loses two in a hundred. Without this limit, the same flips are
/// found in three times the time, because all steps of a block that bounces to rest are halved.
bool is_rough(const Probe& left, const Probe& middle, const Probe& right)
{
    const auto [nearest, farthest] =
        std::minmax({std::abs(left.margin), std::abs(middle.margin), std::abs(right.margin)});
    const bool differ = left.impacts != middle.impacts || middle.impacts != right.impacts;
    if (differ && farthest - nearest > nearest / 64) {
        return true;
    }
    const double share = (middle.value - left.value) / (right.value - left.value);
    const double straight = left.margin + share * (right.margin - left.margin);
    return std::abs(middle.margin - straight) > nearest / 4;
}

/// Whether the margin is nearest to 0 in the middle, and so near that it may reach 0 between its
/// neighbours. A parabola falls below the lowest of three values by at most an eighth of their
/// differences. Next to a strip, the margin bends more sharply: a limit of 4 instead of 32 loses
/// six of a thousand flips.
bool may_reach_zero(const Probe& left, const Probe& middle, const Probe& right)
{
    const double nearest = std::abs(middle.margin);
    const double before = std::abs(left.margin) - nearest;
    const double after = std::abs(right.margin) - nearest;
    return before >= 0 && after >= 0 && nearest < 32 * std::max(before, after);
}

/// Adds probes to others and sorts all by value; of equal ones, the added are the last.
void add(const std::vector<Probe>& added, std::vector<Probe>& probes)
{
    probes.insert(probes.end(), added.begin(), added.end());
    std::ranges::stable_sort(probes, {}, &Probe::value);
}

/// Removes probes that are not settled, and those above the first flip that exceeds most_flips.
void forget_the_useless(std::vector<Probe>& probes, std::size_t most_flips)
{
    std::erase_if(probes, [](const Probe& probe) { return !is_decided(probe.region); });
    std::size_t flips = 0;
    for (std::size_t i = 1; i < probes.size(); ++i) {
        flips += is_flip(probes[i - 1], probes[i]);
        if (flips > most_flips) {
            probes.resize(i + 1);
        }
    }
}

/// Whether a block that just does not overturn on one side does not overturn on the other after the
/// next impact, which reduces its energy by r.
bool is_safe_next_to_a_flip(const Scene& scene, const Point& point)
{
    const Block<double>& block = point.block;
    const double ratio = with_theory(scene.theory, [&]<Theory theory>() {
        return barrier_ratio<theory>(Equations<theory>::separatrix_rate(block, 0.0), block);
    });
    return !may_slip(point) && block.restitution * std::max(ratio, 1 / ratio) <= 1;
}

/// The probes of a line and the effort spent on them.
class Line {
public:
    Line(const Scene& scene, const Path& path, const FlipSearch& wanted, Kernel kernel)
        : search(wanted), scene_(scene), path_(path), kernel_(kernel)
    {}

    const FlipSearch search;
    std::vector<Probe> undecided; ///< whose verdict could not be settled, in this order
    std::optional<CoarseSearch> coarse;

    double scale(double value) const { return path_.scale(value); }

    /// Whether the two values are within the flip width, or adjacent doubles.
    bool is_narrow(double below, double above) const
    {
        return above - below <= search.flip_width * scale(above) ||
               std::nextafter(below, above) >= above;
    }

    std::vector<Probe> at(const std::vector<double>& values, const Numerics& numerics)
    {
        std::vector<Point> points = path_.at(values);
        const bool are_symmetric = std::ranges::all_of(
            points, [](const Point& point) { return point.block.is_symmetric(); });
        computed_ += values.size();
        const PointRun run(scene_, std::move(points), kernel_, search.drop_requested,
                           are_symmetric);
        const Outcomes outcomes = outcomes_of(
            run, numerics, {.impacts = true, .region = true, .margin = true}, left_in_50_digits_);
        left_in_50_digits_ -= outcomes.in_50_digits;
        std::vector<Probe> probes;
        for (std::size_t i = 0; i < values.size(); ++i) {
            // Without a margin, as of a block that still slips, flips are bisected.
            const auto& outcome = outcomes[i];
            const double signed_one = is_safe(outcome.region) ? 1 : -1;
            probes.push_back({values[i], outcome.region,
                              std::isnan(outcome.margin) ? signed_one : outcome.margin,
                              outcome.impacts});
            if (!is_decided(probes.back().region)) {
                undecided.push_back(probes.back());
            }
        }
        return probes;
    }

    Probe at(double value) { return at(std::vector{value}, most_accurate)[0]; }

    bool may_slip_at(double value) const { return may_slip(path_.at({value}).front()); }

    /// Whether there is a safe strip, however narrow, between two values at which the block
    /// overturns to different sides: where it changes the side, it just does not overturn.
    bool has_safe_strip(const Probe& below, const Probe& above) const
    {
        return std::ranges::all_of(path_.at({below.value, above.value}), [&](const Point& point) {
            return is_safe_next_to_a_flip(scene_, point);
        });
    }

    /// Whether no further flips are searched for, by halving steps or between neighbours.
    bool is_exhausted() const { return computed_ > search.most_points; }
    void renew_effort() { computed_ = 0; }

    /// Records that the step between these two is not searched although it should be.
    void leave_coarse(const Probe& below, const Probe& above)
    {
        const double step = (above.value - below.value) / scale(above.value);
        coarse =
            coarse ? CoarseSearch{std::min(coarse->first, below.value),
                                  std::max(coarse->last, above.value), std::max(coarse->step, step)}
                   : CoarseSearch{below.value, above.value, step};
    }

    void add_undecided(double value) { undecided.push_back({value, Region::undecided, 0, 0}); }

private:
    Scene scene_;
    Path path_;
    Kernel kernel_;
    std::size_t computed_ = 0;
    int left_in_50_digits_ = search.most_in_50_digits;
};

/// The bracket of a flip, and the value at which a probe is missing to narrow it further.
struct Bracket {
    Probe low;
    Probe high;
    std::optional<double> missing{};
};

/// Narrows the bracket of a flip to the flip width, or until a verdict within it cannot be settled,
/// as far as the probes within it are known. The margin changes its sign at the flip but may jump.
Bracket narrowed(Line& line, const Bracket& given, const std::vector<Probe>& known)
{
    auto [low, high, missing] = given;
    const Probe* unsettled = nullptr;
    const auto known_at = [&](double value) -> const Probe* {
        const auto found = std::ranges::find(known, value, &Probe::value);
        missing = found == known.end() ? std::optional(value) : std::nullopt;
        return missing ? nullptr : &*found;
    };
    const auto margin = [&](double value) {
        const Probe* const probe = known_at(value);
        if (missing) {
            return 0.0; // ends the search
        }
        if (!is_decided(probe->region)) {
            unsettled = probe;
            return 0.0;
        }
        (is_safe(probe->region) == is_safe(given.low.region) ? low : high) = *probe;
        return probe->margin;
    };
    std::uintmax_t most_evaluations = 100;
    const auto is_narrow = [&](double one, double other) { return line.is_narrow(one, other); };
    boost::math::tools::toms748_solve(margin, low.value, high.value, low.margin, high.margin,
                                      is_narrow, most_evaluations);
    while (!missing && unsettled == nullptr &&
           !line.is_narrow(low.value, high.value)) { // if a margin of 0 ended it early
        margin(middle_of(low, high));
    }
    if (unsettled != nullptr &&
        line.may_slip_at(low.value)) { // the ends of the range that cannot be settled
        double first = unsettled->value;
        double last = first;
        const auto close = [&](Probe& settled_end, double& end) {
            constexpr double enough = 1e-9; // of the scale
            while (!missing &&
                   std::abs(end - settled_end.value) > enough * line.scale(high.value)) {
                const Probe* const probe = known_at((end + settled_end.value) / 2);
                if (missing) {
                    return;
                }
                if (!is_decided(probe->region)) {
                    end = probe->value;
                } else if (is_safe(probe->region) == is_safe(settled_end.region)) {
                    settled_end = *probe;
                } else {
                    return; // another flip
                }
            }
        };
        close(low, first);
        close(high, last);
        if (!missing && line.is_narrow(low.value, high.value)) {
            std::erase_if(line.undecided, [&](const Probe& probe) {
                return low.value < probe.value && probe.value < high.value;
            });
        }
    }
    return {low, high, missing};
}

/// The probes at the ends of these brackets, narrowed. A search starts anew with each probe, so
/// that the next ones of all are computed together, in the lanes of packs.
std::vector<Probe> ends_of_narrowed(Line& line, const std::vector<Bracket>& brackets)
{
    std::vector<std::vector<Probe>> known(brackets.size());
    std::vector<Bracket> narrow(brackets.size());
    std::vector<std::size_t> open(brackets.size());
    std::iota(open.begin(), open.end(), std::size_t(0));
    while (true) {
        for (const std::size_t i : open) {
            narrow[i] = narrowed(line, brackets[i], known[i]);
        }
        std::erase_if(open, [&](std::size_t i) { return !narrow[i].missing; });
        if (open.empty()) {
            break;
        }
        const std::vector<Probe> next =
            line.at(mapped(open, [&](std::size_t i) { return *narrow[i].missing; }), most_accurate);
        for (std::size_t i = 0; i < open.size(); ++i) {
            known[open[i]].push_back(next[i]);
        }
    }
    std::vector<Probe> ends;
    for (const Bracket& bracket : narrow) {
        ends.insert(ends.end(), {bracket.low, bracket.high});
    }
    return ends;
}

/// Bisects between two values at which the block overturns to different sides. Returns a safe
/// value, or the two closest ones if a verdict cannot be settled or the safe strip is narrower
/// than the flip width.
std::vector<Probe> between_sides(Line& line, Probe below, Probe above)
{
    while (!line.is_narrow(below.value, above.value)) {
        const Probe middle = line.at(middle_of(below, above));
        if (is_safe(middle.region)) {
            return {middle};
        }
        if (!is_decided(middle.region)) {
            return {below, above};
        }
        (falls_to_plus(middle.region) == falls_to_plus(below.region) ? below : above) = middle;
    }
    line.add_undecided(middle_of(below, above));
    return {below, above};
}

/// Searches for a value with the other verdict near `nearest`, the one of three whose margin
/// is nearest to 0, by Brent's method.
std::optional<Probe> other_verdict_near(Line& line, const Probe& before, const Probe& nearest,
                                        const Probe& after)
{
    std::optional<Probe> found;
    const bool safe = is_safe(nearest.region);
    const auto distance = [&](double value) {
        if (found) {
            return 0.0;
        }
        const Probe probe = line.at(value);
        if (is_decided(probe.region) && is_safe(probe.region) != safe) {
            found = probe;
        }
        return is_decided(probe.region) ? std::abs(probe.margin) : 1.0;
    };
    std::uintmax_t most_evaluations = 60;
    constexpr int bits = 26; // half of those of a double, the accuracy of a minimum
    boost::math::tools::brent_find_minima(distance, before.value, after.value, bits,
                                          most_evaluations);
    return found;
}

/// The steps of the scan that are rough and wider than the finest step, each given by its upper
/// probe. time: the number of halvings so far; steps without a probe of the last one were checked
/// before.
std::vector<std::size_t> steps_to_halve(const Line& line, const std::vector<Probe>& probes,
                                        int time)
{
    std::vector<std::size_t> steps;
    for (std::size_t i = 1; i + 1 < probes.size(); ++i) {
        if (!is_rough(probes[i - 1], probes[i], probes[i + 1])) {
            continue;
        }
        for (const std::size_t end : {i, i + 1}) {
            const Probe& below = probes[end - 1];
            const Probe& above = probes[end];
            const bool is_new = below.halving == time || above.halving == time;
            const bool is_wide =
                above.value - below.value > line.search.finest_step * line.scale(above.value);
            if ((steps.empty() || end > steps.back()) && is_new && is_wide) {
                steps.push_back(end);
            }
        }
    }
    return steps;
}

/// Halves the steps of the scan repeatedly where it is rough, down to the finest step.
std::vector<Probe> refined(Line& line, std::vector<Probe> probes)
{
    forget_the_useless(probes, line.search.most_flips);
    for (int time = 0;; ++time) {
        std::vector<double> middles;
        for (const std::size_t end : steps_to_halve(line, probes, time)) {
            if (line.is_exhausted() || line.undecided.size() > most_undecided) {
                line.leave_coarse(probes[end - 1], probes[end]);
            } else {
                middles.push_back(middle_of(probes[end - 1], probes[end]));
            }
        }
        if (middles.empty()) {
            return probes;
        }
        std::vector<Probe> added = line.at(middles, scanning);
        for (Probe& probe : added) {
            probe.halving = time + 1;
        }
        add(added, probes);
        forget_the_useless(probes, line.search.most_flips);
    }
}

/// Adds values with another verdict between two neighbours with the same verdict.
void add_hidden_verdicts(Line& line, std::vector<Probe>& probes)
{
    line.renew_effort();
    std::vector<Probe> found;
    for (std::size_t i = 0; i + 1 < probes.size(); ++i) {
        const Probe& now = probes[i];
        const Probe& next = probes[i + 1];
        if (is_flip(now, next)) {
            continue;
        }
        const bool changes_side = is_unsafe(now.region) &&
                                  falls_to_plus(now.region) != falls_to_plus(next.region) &&
                                  line.has_safe_strip(now, next);
        const bool has_minimum = !changes_side && i > 0 && !is_flip(probes[i - 1], now) &&
                                 may_reach_zero(probes[i - 1], now, next);
        if ((changes_side || has_minimum) && line.is_exhausted()) {
            line.leave_coarse(now, next);
        } else if (changes_side) {
            const std::vector<Probe> between = between_sides(line, now, next);
            found.insert(found.end(), between.begin(), between.end());
        } else if (has_minimum) {
            if (const auto other = other_verdict_near(line, probes[i - 1], now, next)) {
                found.push_back(*other);
            }
        }
    }
    add(found, probes);
}

/// Adds the shares of the interval between the first and the last of these ascending values.
void add_shares(const std::vector<Probe>& probes, Boundary& boundary)
{
    const double interval = probes.back().value - probes.front().value;
    for (std::size_t i = 1; i < probes.size(); ++i) {
        const Probe& below = probes[i - 1];
        const Probe& above = probes[i];
        const double share = (above.value - below.value) / interval;
        if (!is_decided(below.region) || !is_decided(above.region)) {
            boundary.undecided_share += share;
        } else { // the flip is taken to be halfway between them
            boundary.unsafe_share +=
                share * (is_unsafe(below.region) + is_unsafe(above.region)) / 2;
        }
    }
}

} // namespace

Boundary flips_along(const Path& path, const Scene& scene, const FlipScan& scan,
                     const FlipSearch& search, Kernel kernel)
{
    Line line(scene, path, search, kernel);
    for (const double value : scan.undecided) {
        line.add_undecided(value);
    }
    const std::size_t most_flips = search.most_flips;
    const bool is_sensitive = scene.motion_traits().is_sensitive;
    std::vector<Probe> probes = line.at(scan.values, scanning);
    if (is_sensitive) {
        // A margin says nothing about the verdicts next to it: the block has often come to rest
        // long before the end.
        forget_the_useless(probes, std::numeric_limits<std::size_t>::max());
    } else {
        probes = refined(line, std::move(probes));
        add_hidden_verdicts(line, probes);
    }
    std::vector<Bracket> brackets;
    for (std::size_t i = 1; i < probes.size() && brackets.size() < most_flips; ++i) {
        if (is_flip(probes[i - 1], probes[i])) {
            brackets.push_back({probes[i - 1], probes[i]});
        }
    }
    add(ends_of_narrowed(line, brackets), probes);
    add(line.undecided, probes);
    // Of undecided values that were settled later, the settled ones remain.
    const auto repeated = std::ranges::unique(probes, {}, &Probe::value);
    probes.erase(repeated.begin(), repeated.end());

    Boundary boundary;
    boundary.region_at_first = probes.front().region;
    boundary.complete = line.undecided.empty();
    boundary.coarse = line.coarse;
    if (is_sensitive) {
        add_shares(probes, boundary);
    }
    for (std::size_t i = 1; i < probes.size() && !boundary.has_more; ++i) {
        const Probe& below = probes[i - 1];
        const Probe& above = probes[i];
        if (!is_flip(below, above) && is_decided(below.region) == is_decided(above.region)) {
            continue;
        }
        boundary.has_more = boundary.flips.size() == most_flips;
        if (!boundary.has_more) {
            // An undecided range extends to the settled values on both sides.
            boundary.flips.push_back({is_decided(below.region) ? below.value : above.value,
                                      is_decided(above.region) ? above.value : below.value,
                                      below.region, above.region});
        }
    }
    return boundary;
}

} // namespace overturn
