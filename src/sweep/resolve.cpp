#include "tile_run.hpp"

#include "overturn/integrate/fifty_digits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace overturn {

namespace {

/// Fine enough that of a plane's points one in billions is left in doubt, and still doubles.
constexpr Numerics finest_in_doubles{.method = Method::taylor, .tolerance = 1e-13};

void give_up(int point, Ends& ends)
{
    ends.flags[point] |= end_flag::unresolved;
    ends.unresolved.push_back(point);
}

/// Which of these points have a verdict that their error could turn.
std::vector<int> in_doubt(const TileRun& tile, const std::vector<int>& points, Ends& ends)
{
    const std::vector<double> margins = tile.margins(ends);
    std::vector<int> doubtful;
    for (const int point : points) {
        // Not so if a number is not one. More digits do not help where there are too many steps.
        const bool capped = ends.flags[point] & end_flag::capped;
        if (capped) {
            give_up(point, ends);
        } else if (!(ends.error[point] < std::abs(margins[point]))) {
            doubtful.push_back(point);
        }
    }
    return doubtful;
}

void settle_exactly(const TileRun& tile, const std::vector<int>& points, Ends& ends)
{
    for (const int point : points) {
        // Fifty digits need as many steps for a series of bounces as doubles do.
        if (ends.steps[point] > most_exact_steps) {
            give_up(point, ends);
            continue;
        }
        tile.run_exactly(point, ends);
        const ExactPoint& exact = ends.exact.back();
        const bool settled = ends.error[point] < std::abs(exact.margin) &&
                             !(ends.flags[point] & end_flag::undecided);
        if (!settled) {
            give_up(point, ends);
        }
    }
}

} // namespace

Ends integrate(const TileRun& tile, const Numerics& numerics, std::size_t points,
               const Asked& asked)
{
    Asked recorded = asked;
    recorded.error = asked.error || numerics.resolve;
    recorded.steps = asked.steps || numerics.resolve;
    Ends ends(points, recorded);
    tile.run(numerics, ends);
    if (numerics.resolve) {
        std::vector<int> all(points);
        std::iota(all.begin(), all.end(), 0);
        std::vector<int> doubtful = in_doubt(tile, all, ends);
        tile.run(finest_in_doubles, doubtful, ends);
        doubtful = in_doubt(tile, doubtful, ends);
        settle_exactly(tile, doubtful, ends);
    }
    return ends;
}

} // namespace overturn
