#include "overturn/answers/history.hpp"

#include "overturn/sweep/toppling.hpp"
#include "overturn/text/error.hpp"

#include <algorithm>
#include <cmath>

namespace overturn {

namespace {

/// Throws Error if the motion overflows.
void expect_finite(const History& history, const Grid& grid)
{
    const bool finite = std::ranges::all_of(history.samples, [](const HistorySample& sample) {
        return std::isfinite(sample.angle) && std::isfinite(sample.velocity) &&
               std::isfinite(sample.acceleration) && std::isfinite(sample.q);
    });
    if (!finite) {
        const Column& strength = *grid.axis_or_number(Role::strength);
        throw Error(exit_code::job,
                    "plane.{} = {} moves the block beyond the range of double precision. Lower "
                    "it. (In a spectrum such a point is undecided, with the flag not_finite in "
                    "status.)",
                    strength.quantity->name, strength.values.first());
    }
}

} // namespace

History history_of_only_point(const Job& job, HistoryView view)
{
    const Scene& scene = job.problem.scene;
    for (const Record& record : scene.records()) {
        view.samples = int(std::max<std::int64_t>(view.samples, record->samples()));
    }
    History history = history_of(scene, only_point_of(job.problem), view);
    expect_finite(history, job.problem.grid);
    return history;
}

} // namespace overturn
