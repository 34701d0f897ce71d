#include "point_run.hpp"

#include "overturn/integrate/more_digits.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace overturn {

namespace {

void give_up(int point, Ends& ends)
{
    ends.flags[std::size_t(point)] |= end_flag::unresolved;
    if (ends.records.region) {
        ends.region[std::size_t(point)] = std::uint8_t(Region::undecided);
    }
}

/// Settles the points that took too many steps, for which more digits do not help, and returns
/// those whose verdict is in doubt.
std::vector<int> settle_capped(const PointRun& run, const std::vector<int>& points, Ends& ends)
{
    std::vector<int> in_doubt;
    for (const int point : points) {
        const std::uint8_t flags = ends.flags[std::size_t(point)];
        if (flags & end_flag::capped) {
            if (!run.settle_low_bounces(point, ends)) {
                give_up(point, ends);
            }
        } else if (flags & end_flag::in_doubt) {
            in_doubt.push_back(point);
        }
    }
    return in_doubt;
}

/// Whether a computation in T may settle a point. With more digits, a series of bounces takes as
/// many steps as in double.
template <class T>
bool may_settle_in(const PointRun& run, int point, const Ends& ends)
{
    return std::numeric_limits<T>::digits > std::numeric_limits<double>::digits &&
           ends.steps[std::size_t(point)] <= MoreDigits<T>::most_steps + double(run.intervals());
}

template <class T>
bool settle_in(const PointRun& run, int point, Ends& ends)
{
    if (!may_settle_in<T>(run, point, ends)) {
        return false;
    }
    run.run_exactly<T>(point, ends);
    return !(ends.flags[std::size_t(point)] & (end_flag::in_doubt | end_flag::undecided));
}

void resolve(const PointRun& run, int most_in_50_digits, Ends& ends)
{
    std::vector<int> all(ends.tilt.size());
    std::iota(all.begin(), all.end(), 0);
    std::vector<int> in_doubt = settle_capped(run, all, ends);
    if (!in_doubt.empty()) {
        // Settles almost every point, still in double.
        run.run(most_accurate, ends, OnUnknownError::go_on, &in_doubt);
    }
    in_doubt = settle_capped(run, in_doubt, ends);
    for (const int point : in_doubt) {
        const bool settled =
            run.settle_low_bounces(point, ends) || settle_in<long double>(run, point, ends) ||
            (may_settle_in<Digits50>(run, point, ends) && ends.in_50_digits < most_in_50_digits &&
             ++ends.in_50_digits && settle_in<Digits50>(run, point, ends));
        if (!settled) {
            give_up(point, ends);
        }
    }
}

} // namespace

Ends ends_of(const PointRun& points, const Numerics& numerics, const Records& records,
             std::optional<int> most_in_50_digits)
{
    Records recorded = records;
    recorded.error = records.error || numerics.resolve;
    recorded.steps = records.steps || numerics.resolve; // see settle_in()
    recorded.peak = records.peak && !recorded.error;
    Ends ends(std::size_t(points.size()), recorded);
    points.run(numerics, ends, numerics.resolve ? OnUnknownError::stop : OnUnknownError::go_on);
    if (numerics.resolve) {
        const int by_default = points.intervals() > 0 ? numerics.most_in_50_digits : points.size();
        resolve(points, most_in_50_digits.value_or(by_default), ends);
    }
    if (records.peak && !recorded.peak) {
        Ends with_peaks(ends.tilt.size(), {.peak = true, .grazes = records.grazes});
        points.run(numerics, with_peaks);
        ends.peak = std::move(with_peaks.peak);
        ends.lowest_turn = std::move(with_peaks.lowest_turn);
        ends.softest_impact = std::move(with_peaks.softest_impact);
        ends.last_impact = std::move(with_peaks.last_impact);
    }
    return ends;
}

} // namespace overturn
