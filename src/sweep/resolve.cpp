#include "point_run.hpp"

#include "overturn/integrate/more_digits.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace overturn {

namespace {

/// The bounds of errors are of first order: at a loose tolerance, the error of one point in a
/// million exceeds its bound, by a factor of up to 13 among 10^8 random points.
constexpr double safety_of_first_pass = 16;

/// Settles the points that took too many steps, for which more digits do not help, and returns
/// those whose verdict is in doubt: |margin| is not larger than the bound of its error, times
/// `safety`.
std::vector<int> settle_capped(const PointRun& run, const std::vector<int>& points, double safety,
                               Outcomes& outcomes)
{
    std::vector<int> in_doubt;
    for (const int point : points) {
        Outcome& outcome = outcomes[point];
        if (outcome.has(status::cap_was_hit)) {
            if (!run.settle_low_bounces(point, outcome)) {
                give_up(outcome);
            }
        } else if (!outcome.has(status::free_fall) &&
                   !(safety * outcome.error < std::abs(outcome.margin))) {
            in_doubt.push_back(point);
        }
    }
    return in_doubt;
}

/// Whether a point took at most this number of steps, in addition to one per interval of a record.
bool is_short(const PointRun& run, int point, int most_steps, const Outcomes& outcomes)
{
    const Accelerogram* record = run.record_of(point);
    const double intervals = record != nullptr ? double(record->samples() - 1) : 0;
    return outcomes[point].steps <= most_steps + intervals;
}

bool is_settled(const Outcome& outcome)
{
    return !outcome.has(outcome_flag::in_doubt | outcome_flag::without_end);
}

} // namespace

void resolve(const PointRun& run, int most_in_50_digits, Outcomes& outcomes)
{
    std::vector<int> in_doubt = settle_capped(run, run.all(), safety_of_first_pass, outcomes);
    if (in_doubt.empty()) {
        return;
    }
    // Settles almost every point, still in double; if the first pass was as accurate, it still
    // completes the runs that were stopped.
    run.run(most_accurate, outcomes, in_doubt);
    in_doubt = settle_capped(run, in_doubt, 1, outcomes);
    std::erase_if(in_doubt,
                  [&](int point) { return run.settle_low_bounces(point, outcomes[point]); });
    // With more digits, a series of bounces takes as many steps as in double.
    std::vector<int> chosen;
    std::ranges::copy_if(in_doubt, std::back_inserter(chosen), [&](int point) {
        return is_short(run, point, MoreDigits<Digits31>::most_steps, outcomes);
    });
    run.run_in_31_digits(outcomes, chosen);
    std::erase_if(in_doubt, [&](int point) { return is_settled(outcomes[point]); });
    for (const int point : in_doubt) {
        if (outcomes.in_50_digits < most_in_50_digits &&
            is_short(run, point, MoreDigits<Digits50>::most_steps, outcomes)) {
            ++outcomes.in_50_digits;
            run.run_in_more_digits<Digits50>(point, outcomes);
        }
        if (!is_settled(outcomes[point])) {
            give_up(outcomes[point]);
        }
    }
}

} // namespace overturn
