// The outcome of a job with a single point, as computed for a spectrum.
#pragma once

#include "job_lines.hpp"

#include "overturn/job/job.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "overturn/sweep/history.hpp"
#include "overturn/text/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace overturn {

inline Point only_point_of(const Problem& problem)
{
    return Coordinates(problem.scene, problem.grid).points().front();
}

/// alpha of the only block of a job; nullopt if it has two sides [rad].
inline std::optional<double> slenderness_of_only_block(const Job& job)
{
    return job.problem.grid.has_two_sides()
               ? std::nullopt
               : std::optional(only_point_of(job.problem).block.slenderness);
}

/// Throws Error if the motion overflows; a spectrum flags such a point instead.
inline void expect_finite(const History& history, const Grid& grid)
{
    const bool finite = std::all_of(
        history.samples.begin(), history.samples.end(), [](const HistorySample& sample) {
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

/// With at least as many samples as the record. Throws Error if the motion overflows.
inline History history_of_only_point(const Job& job, HistoryView view = {})
{
    const Scene& scene = job.problem.scene;
    if (scene.is_recorded()) {
        view.samples = int(std::max<std::int64_t>(view.samples, scene.records.front()->samples()));
    }
    History history = history_of(scene, only_point_of(job.problem), view);
    expect_finite(history, job.problem.grid);
    return history;
}

/// The values of a field of type double, as accurate as possible, tile by tile.
inline std::vector<double> accurate_values(Problem problem, Field field)
{
    problem.numerics = most_accurate;
    problem.fields = {field};
    const Tiling tiling = tiling_of(problem);
    std::vector<double> all;
    for (std::int64_t tile = 0; tile < tiling.size(); ++tile) {
        const TileFields fields = compute_tile(problem, tiling[tile], widest_kernel());
        const auto& values = std::get<std::vector<double>>(fields.values[0]);
        all.insert(all.end(), values.begin(), values.end());
    }
    return all;
}

/// peak: |theta| / alpha; infinite if the block overturns, NaN if that is undecided.
/// slenderness: nullopt if the block has two of them.
inline std::string peak_text(double peak, const std::optional<double>& slenderness)
{
    return std::isnan(peak)   ? "undecided"
           : std::isinf(peak) ? "the block overturns"
           : peak == 0        ? "0: the block is not lifted and stays at rest"
           : slenderness      ? fmt::format("{:.4g} degrees, {:.3g} % of alpha",
                                            in_degrees(peak * *slenderness), 100 * peak)
                              : fmt::format("{:.3g} % of alpha of its side", 100 * peak);
}

} // namespace overturn
