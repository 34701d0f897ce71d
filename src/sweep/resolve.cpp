#include "point_run.hpp"

#include "overturn/integrate/more_digits.hpp"

#include <limits>
#include <map>

namespace overturn {

namespace {

void give_up(int point, Outcomes& outcomes)
{
    outcomes.flags[std::size_t(point)] |= outcome_flag::unresolved;
    put(outcomes.region, point, std::uint8_t(Region::undecided));
}

/// Settles the points that took too many steps, for which more digits do not help, and returns
/// those whose verdict is in doubt.
std::vector<int> settle_capped(const PointRun& run, const std::vector<int>& points,
                               Outcomes& outcomes)
{
    std::vector<int> in_doubt;
    for (const int point : points) {
        const std::uint8_t flags = outcomes.flags[std::size_t(point)];
        if (flags & outcome_flag::capped) {
            if (!run.settle_low_bounces(point, outcomes)) {
                give_up(point, outcomes);
            }
        } else if (flags & outcome_flag::in_doubt) {
            in_doubt.push_back(point);
        }
    }
    return in_doubt;
}

/// Whether a computation in T may settle a point. With more digits, a series of bounces takes as
/// many steps as in double.
template <class T>
bool may_settle_in(const PointRun& run, int point, const Outcomes& outcomes)
{
    const Accelerogram* record = run.record_of(point);
    const double intervals = record != nullptr ? double(record->samples() - 1) : 0;
    return std::numeric_limits<T>::digits > std::numeric_limits<double>::digits &&
           outcomes.steps[std::size_t(point)] <= MoreDigits<T>::most_steps + intervals;
}

template <class T>
bool settle_in(const PointRun& run, int point, Outcomes& outcomes)
{
    run.run_in_more_digits<T>(point, outcomes);
    return !(outcomes.flags[std::size_t(point)] &
             (outcome_flag::in_doubt | outcome_flag::without_end));
}

/// most_in_50_digits: of the points under one motion.
void resolve(const PointRun& run, int most_in_50_digits, Outcomes& outcomes)
{
    std::vector<int> in_doubt = settle_capped(run, run.all(), outcomes);
    if (!in_doubt.empty()) {
        run.run(most_accurate, outcomes, in_doubt); // settles almost every point, still in double
    }
    std::map<int, int> in_50_digits; // of each motion
    for (const int point : settle_capped(run, in_doubt, outcomes)) {
        bool settled = run.settle_low_bounces(point, outcomes) ||
                       (may_settle_in<long double>(run, point, outcomes) &&
                        settle_in<long double>(run, point, outcomes));
        int& count = in_50_digits[run.point(point).record];
        if (!settled && may_settle_in<Digits50>(run, point, outcomes) &&
            count < most_in_50_digits) {
            ++count;
            ++outcomes.in_50_digits;
            settled = settle_in<Digits50>(run, point, outcomes);
        }
        if (!settled) {
            give_up(point, outcomes);
        }
    }
}

} // namespace

Outcomes outcomes_of(const PointRun& points, const Numerics& numerics, const Outputs& outputs,
                     std::optional<int> most_in_50_digits)
{
    Outputs computed = outputs;
    computed.error = outputs.error || numerics.resolve;
    computed.steps = outputs.steps || numerics.resolve; // see may_settle_in()
    computed.peak = outputs.peak && !computed.error;
    // An integration that is accurate enough for a verdict may be inaccurate for a peak, whose
    // error has no bound. Filling only compares the peaks of nodes.
    const bool needs_peaks = numerics.resolve && outputs.peak && !outputs.grazes;
    const Numerics& first_pass = needs_peaks ? most_accurate : numerics;
    Outcomes outcomes(std::size_t(points.size()), computed);
    points.run(first_pass, outcomes, points.all(),
               numerics.resolve ? UncertainImpact::stop : UncertainImpact::go_on);
    if (numerics.resolve) {
        const int by_default =
            points.scene().is_recorded() ? numerics.most_in_50_digits : points.size();
        resolve(points, most_in_50_digits.value_or(by_default), outcomes);
    }
    if (outputs.peak && !computed.peak) {
        // A kernel computes either errors or peaks.
        Outcomes with_peaks(outcomes.tilt.size(), {.peak = true, .grazes = outputs.grazes});
        points.run(first_pass, with_peaks, points.all());
        outcomes.peak = std::move(with_peaks.peak);
        outcomes.lowest_turn = std::move(with_peaks.lowest_turn);
        outcomes.softest_impact = std::move(with_peaks.softest_impact);
        outcomes.last_impact = std::move(with_peaks.last_impact);
    }
    return outcomes;
}

} // namespace overturn
