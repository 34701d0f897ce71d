#include "overturn/sweep/boundary.hpp"

#include "point_run.hpp"

#include "overturn/mechanics/energy_criteria.hpp"
#include "overturn/text/mapped.hpp"

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace overturn {

namespace {

/// The strength from which on the vertical motion cancels gravity; infinite if there is none.
double free_fall_strength(const Scene& scene, const BoundaryLine& line)
{
    return free_fall_amplitude(scene, line.point) * std::abs(line.unit);
}

/// Verdicts must be right. The scan uses a loose tolerance and resolves verdicts in doubt.
constexpr Numerics scanning{.method = Method::taylor, .tolerance = 1e-6, .resolve = true};

/// Steps of the scan under a pulse, over the upper amplitude. With two amplitudes far apart, the
/// criteria for halving, which compare three neighbours, missed ranges in one line of seven; with
/// five, in none of 1104.
constexpr double widest_step = 0.125;

/// An undecided verdict may take a second. After this many, the scan is not refined further.
constexpr std::size_t most_undecided = 16;

/// The outcome of a block at one amplitude.
struct Probe {
    double amplitude;
    Region region;
    double margin;
    double impacts;
    int halving = 0; ///< the halving of the scan that added it
};

double middle_of(const Probe& below, const Probe& above)
{
    return below.amplitude + (above.amplitude - below.amplitude) / 2;
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
    const double share = (middle.amplitude - left.amplitude) / (right.amplitude - left.amplitude);
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

/// Adds probes to others and sorts all by amplitude; of equal ones, the added are the last.
void add(const std::vector<Probe>& added, std::vector<Probe>& probes)
{
    probes.insert(probes.end(), added.begin(), added.end());
    std::ranges::stable_sort(probes, {}, &Probe::amplitude);
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

/// The probes of a line and the effort spent on them.
class Line {
public:
    Line(const Scene& scene, const BoundaryLine& line, Kernel kernel, const FlipSearch& wanted)
        : search(wanted), scene_(scene), line_(line), kernel_(kernel)
    {}

    const FlipSearch search;
    std::vector<Probe> undecided; ///< whose verdict could not be settled, in this order
    std::optional<CoarseSearch> coarse;

    /// Whether the two amplitudes are within the flip width, or adjacent doubles.
    bool is_narrow(double below, double above) const
    {
        return above - below <= search.flip_width * above || std::nextafter(below, above) >= above;
    }

    std::vector<Probe> at(const std::vector<double>& amplitudes, const Numerics& numerics)
    {
        std::vector<Point> points(amplitudes.size(), line_.point);
        for (std::size_t i = 0; i < points.size(); ++i) {
            points[i].amplitude = amplitudes[i] / line_.unit;
        }
        computed_ += amplitudes.size();
        const PointRun run(scene_, std::move(points), kernel_, search.drop_requested,
                           line_.point.block.is_symmetric());
        const Outcomes outcomes = outcomes_of(
            run, numerics, {.impacts = true, .region = true, .margin = true}, left_in_50_digits_);
        left_in_50_digits_ -= outcomes.in_50_digits;
        std::vector<Probe> probes;
        for (std::size_t i = 0; i < amplitudes.size(); ++i) {
            // Without a margin, as of a block that still slips, flips are bisected.
            const auto& outcome = outcomes[i];
            const double signed_one = is_safe(outcome.region) ? 1 : -1;
            probes.push_back({amplitudes[i], outcome.region,
                              std::isnan(outcome.margin) ? signed_one : outcome.margin,
                              outcome.impacts});
            if (!is_decided(probes.back().region)) {
                undecided.push_back(probes.back());
            }
        }
        return probes;
    }

    Probe at(double amplitude) { return at(std::vector{amplitude}, most_accurate)[0]; }

    /// The amplitude above which the motion lifts the block.
    double lifting() const
    {
        Point point = line_.point;
        point.amplitude = std::copysign(1.0, line_.unit);
        return lifting_pga(scene_, point) / pga_of_unit(scene_, point) * std::abs(line_.unit);
    }

    bool may_slip() const { return std::isfinite(line_.point.friction); }

    /// Whether there is a safe strip, however narrow, between two amplitudes at which the block
    /// overturns to different sides: a block that just does not overturn on one side must not
    /// overturn on the other after the next impact, which reduces its energy by r.
    bool has_safe_strips() const
    {
        if (may_slip()) {
            return false;
        }
        const Block<double>& block = line_.point.block;
        const double ratio = with_theory(scene_.theory, [&]<Theory theory>() {
            return barrier_ratio<theory>(Equations<theory>::separatrix_rate(block, 0.0), block);
        });
        return block.restitution * std::max(ratio, 1 / ratio) <= 1;
    }

    /// Whether no further flips are searched for, by halving steps or between neighbours.
    bool is_exhausted() const { return computed_ > search.most_amplitudes; }
    void renew_effort() { computed_ = 0; }

    /// Records that the step between these two is not searched although it should be.
    void leave_coarse(const Probe& below, const Probe& above)
    {
        const double step = (above.amplitude - below.amplitude) / above.amplitude;
        coarse = coarse ? CoarseSearch{std::min(coarse->first, below.amplitude),
                                       std::max(coarse->last, above.amplitude),
                                       std::max(coarse->step, step)}
                        : CoarseSearch{below.amplitude, above.amplitude, step};
    }

    /// The amplitudes below that at which the vertical motion cancels gravity; all others are
    /// undecided.
    std::vector<double> without_free_fall(std::vector<double> amplitudes)
    {
        const double free_fall = free_fall_strength(scene_, line_);
        const auto first = std::lower_bound(amplitudes.begin(), amplitudes.end(), free_fall);
        if (first != amplitudes.end()) {
            add_undecided(*first);
            add_undecided(amplitudes.back());
            amplitudes.erase(first, amplitudes.end());
            const double last = last_before_free_fall(scene_, line_);
            if (!amplitudes.empty() && amplitudes.back() < last) {
                amplitudes.push_back(last);
            }
        }
        return amplitudes;
    }

    void add_undecided(double amplitude)
    {
        undecided.push_back({amplitude, Region::undecided, 0, 0});
    }

private:
    Scene scene_;
    BoundaryLine line_;
    Kernel kernel_;
    std::size_t computed_ = 0;
    int left_in_50_digits_ = search.most_in_50_digits;
};

/// The bracket of a flip, and the amplitude at which a probe is missing to narrow it further.
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
    const auto known_at = [&](double amplitude) -> const Probe* {
        const auto found = std::ranges::find(known, amplitude, &Probe::amplitude);
        missing = found == known.end() ? std::optional(amplitude) : std::nullopt;
        return missing ? nullptr : &*found;
    };
    const auto margin = [&](double amplitude) {
        const Probe* const probe = known_at(amplitude);
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
    boost::math::tools::toms748_solve(margin, low.amplitude, high.amplitude, low.margin,
                                      high.margin, is_narrow, most_evaluations);
    while (!missing && unsettled == nullptr &&
           !line.is_narrow(low.amplitude, high.amplitude)) { // if a margin of 0 ended it early
        margin(middle_of(low, high));
    }
    if (unsettled != nullptr && line.may_slip()) { // the ends of the range that cannot be settled
        double first = unsettled->amplitude;
        double last = first;
        const auto close = [&](Probe& settled_end, double& end) {
            constexpr double enough = 1e-9; // of the amplitude
            while (!missing && std::abs(end - settled_end.amplitude) > enough * high.amplitude) {
                const Probe* const probe = known_at((end + settled_end.amplitude) / 2);
                if (missing) {
                    return;
                }
                if (!is_decided(probe->region)) {
                    end = probe->amplitude;
                } else if (is_safe(probe->region) == is_safe(settled_end.region)) {
                    settled_end = *probe;
                } else {
                    return; // another flip
                }
            }
        };
        close(low, first);
        close(high, last);
        if (!missing && line.is_narrow(low.amplitude, high.amplitude)) {
            std::erase_if(line.undecided, [&](const Probe& probe) {
                return low.amplitude < probe.amplitude && probe.amplitude < high.amplitude;
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

/// Bisects between two amplitudes at which the block overturns to different sides. Returns a safe
/// amplitude, or the two closest ones if a verdict cannot be settled or the safe strip is narrower
/// than the flip width.
std::vector<Probe> between_sides(Line& line, Probe below, Probe above)
{
    while (!line.is_narrow(below.amplitude, above.amplitude)) {
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

/// Searches for an amplitude with the other verdict near `nearest`, the one of three whose margin
/// is nearest to 0, by Brent's method.
std::optional<Probe> other_verdict_near(Line& line, const Probe& before, const Probe& nearest,
                                        const Probe& after)
{
    std::optional<Probe> found;
    const bool safe = is_safe(nearest.region);
    const auto distance = [&](double amplitude) {
        if (found) {
            return 0.0;
        }
        const Probe probe = line.at(amplitude);
        if (is_decided(probe.region) && is_safe(probe.region) != safe) {
            found = probe;
        }
        return is_decided(probe.region) ? std::abs(probe.margin) : 1.0;
    };
    std::uintmax_t most_evaluations = 60;
    constexpr int bits = 26; // half of those of a double, the accuracy of a minimum
    boost::math::tools::brent_find_minima(distance, before.amplitude, after.amplitude, bits,
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
                above.amplitude - below.amplitude > line.search.finest_step * above.amplitude;
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

/// These amplitudes, with steps that are wider than `widest`, over their upper amplitude, divided:
/// first at halves of the upper amplitude, then evenly. Below `lifting`, nothing moves.
std::vector<double> divided(const std::vector<double>& amplitudes, double widest, double lifting)
{
    std::vector<double> halved;
    for (const double amplitude : amplitudes) {
        const double below = halved.empty() ? amplitude : halved.back();
        std::vector<double> between;
        for (double half = amplitude / 2; half > std::max(below, lifting); half /= 2) {
            between.push_back(half);
        }
        halved.insert(halved.end(), between.rbegin(), between.rend());
        halved.push_back(amplitude);
    }
    std::vector<double> all;
    for (std::size_t i = 0; i < halved.size(); ++i) {
        const double below = i > 0 ? halved[i - 1] : halved[i];
        const double step = halved[i] - below;
        if (step > 0 && halved[i] > lifting) {
            // Of even steps, the lowest is the widest over its upper amplitude. Steps that are as
            // wide as allowed, but for rounding, are not divided.
            const double lowest = widest / (1 - widest) * std::max(below, lifting);
            const double parts = std::ceil(step / lowest - 1e-9);
            for (double part = 1; part < parts; ++part) {
                all.push_back(below + step * (part / parts));
            }
        }
        all.push_back(halved[i]);
    }
    return all;
}

/// Adds amplitudes with another verdict between two neighbours with the same verdict.
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
        const bool changes_side = line.has_safe_strips() && is_unsafe(now.region) &&
                                  falls_to_plus(now.region) != falls_to_plus(next.region);
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

/// Adds the shares of the interval between the first and the last of these ascending amplitudes.
void add_shares(const std::vector<Probe>& probes, Boundary& boundary)
{
    const double interval = probes.back().amplitude - probes.front().amplitude;
    for (std::size_t i = 1; i < probes.size(); ++i) {
        const Probe& below = probes[i - 1];
        const Probe& above = probes[i];
        const double share = (above.amplitude - below.amplitude) / interval;
        if (!is_decided(below.region) || !is_decided(above.region)) {
            boundary.undecided_share += share;
        } else { // the flip is taken to be halfway between them
            boundary.unsafe_share +=
                share * (is_unsafe(below.region) + is_unsafe(above.region)) / 2;
        }
    }
}

} // namespace

double last_before_free_fall(const Scene& scene, const BoundaryLine& line)
{
    return free_fall_strength(scene, line) * (1 - 4 * std::numeric_limits<double>::epsilon());
}

Boundary boundary_on(const Scene& scene, const BoundaryLine& where,
                     const std::vector<double>& amplitudes, Kernel kernel,
                     const std::optional<FlipSearch>& search)
{
    Line line(scene, where, kernel,
              search.value_or(flip_search(scene, std::isfinite(where.point.friction))));
    const std::size_t most_flips = line.search.most_flips;
    std::vector<Probe> probes;
    const bool is_sensitive = scene.motion_traits().is_sensitive;
    if (is_sensitive) {
        // A margin says nothing about the verdicts next to it: the block has often come to rest
        // long before the end.
        const std::vector<double> scanned = line.without_free_fall(amplitudes);
        probes = line.at(divided(scanned, line.search.finest_step, line.lifting()), scanning);
        forget_the_useless(probes, std::numeric_limits<std::size_t>::max());
    } else {
        probes = refined(line, line.at(divided(amplitudes, widest_step, line.lifting()), scanning));
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
    // Of undecided amplitudes that were settled later, the settled ones remain.
    const auto repeated = std::ranges::unique(probes, {}, &Probe::amplitude);
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
            // An undecided range extends to the settled amplitudes on both sides.
            boundary.flips.push_back({is_decided(below.region) ? below.amplitude : above.amplitude,
                                      is_decided(above.region) ? above.amplitude : below.amplitude,
                                      below.region, above.region});
        }
    }
    return boundary;
}

} // namespace overturn
