#include "resolve.hpp"

#include "overturn/integrate/more_digits.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace overturn {

namespace {

/// Fine enough to settle almost every point that a first pass left in doubt, and still doubles.
constexpr Numerics finest_in_doubles{.method = Method::taylor, .tolerance = 1e-13};

void give_up(int point, Ends& ends)
{
    ends.flags[point] |= end_flag::unresolved;
    ends.unresolved.push_back(point);
}

/// Which of these points have a verdict that their error could turn. More digits do not help where
/// there are too many steps.
std::vector<int> in_doubt(const TileRun& tile, const std::vector<int>& points, Ends& ends)
{
    std::vector<int> doubtful;
    for (const int point : points) {
        if (ends.flags[point] & end_flag::capped) {
            if (!tile.settle_low_bounces(point, ends)) {
                give_up(point, ends);
            }
        } else if (ends.flags[point] & end_flag::in_doubt) {
            doubtful.push_back(point);
        }
    }
    return doubtful;
}

template <class T>
bool settle_in(const TileRun& tile, int point, Ends& ends)
{
    // More digits need as many steps for a series of bounces as doubles do.
    const bool hopeless = std::numeric_limits<T>::digits <= std::numeric_limits<double>::digits ||
                          ends.steps[point] > MoreDigits<T>::most_steps;
    if (hopeless) {
        return false;
    }
    tile.run_exactly<T>(point, ends);
    return !(ends.flags[point] & (end_flag::in_doubt | end_flag::undecided));
}

} // namespace

Ends ends_of(const TileRun& tile, const Numerics& numerics, const Asked& asked)
{
    Asked recorded = asked;
    recorded.error = asked.error || numerics.resolve;
    recorded.peak = asked.peak && !recorded.error;
    Ends ends(std::size_t(tile.points()), recorded);
    tile.run(numerics, ends, numerics.resolve ? InDoubt::ends : InDoubt::goes_on);
    if (numerics.resolve) {
        std::vector<int> all(ends.tilt.size());
        std::iota(all.begin(), all.end(), 0);
        std::vector<int> doubtful = in_doubt(tile, all, ends);
        if (!doubtful.empty()) {
            ends.steps.resize(ends.tilt.size()); // tell whether more digits are worth a try
        }
        tile.run(finest_in_doubles, doubtful, ends);
        doubtful = in_doubt(tile, doubtful, ends);
        for (const int point : doubtful) {
            const bool settled = tile.settle_low_bounces(point, ends) ||
                                 settle_in<long double>(tile, point, ends) ||
                                 settle_in<Digits50>(tile, point, ends);
            if (!settled) {
                give_up(point, ends);
            }
        }
    }
    if (asked.peak && !recorded.peak) {
        Ends with_peaks(ends.tilt.size(), {.peak = true});
        tile.run(numerics, with_peaks);
        ends.peak = std::move(with_peaks.peak);
    }
    return ends;
}

} // namespace overturn
