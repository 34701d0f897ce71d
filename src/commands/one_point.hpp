// The outcome of a job with a single point, as computed for a spectrum.
#pragma once

#include "dimension_lines.hpp"

#include "overturn/job/job.hpp"
#include "overturn/sweep/history.hpp"
#include "overturn/sweep/sweep_tile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace overturn {

inline PlanePoint only_point_of(const Job& job)
{
    const Plane& plane = job.plane;
    const double slenderness = plane.slenderness.first();
    return {.slenderness = slenderness,
            .restitution = plane.restitution_ratio(0, 0),
            .amplitude = plane.amplitude.first() / amplitude_unit(job.scene, plane, 0, slenderness),
            .frequency = frequency_of_point(job.scene, plane, 0, plane.frequency.first())};
}

/// With at least as many samples as the record.
inline History history_of_only_point(const Job& job, HistoryView view = {})
{
    if (!job.motions.empty()) {
        view.samples = int(std::max<std::int64_t>(view.samples, job.motions.front().samples));
    }
    return history_of(job.scene, only_point_of(job), view);
}

/// The largest |theta| / alpha; infinite if the block overturns, NaN if that is undecided.
inline double peak_of_only_point(const Job& job)
{
    const TileFields fields = sweep_tile(job.scene, most_accurate, job.plane, Tiling(job.plane)[0],
                                         {Field::peak}, widest_kernel());
    return std::get<std::vector<double>>(fields.values[0])[0];
}

inline std::string peak_text(double peak, double slenderness)
{
    return std::isnan(peak)   ? "undecided"
           : std::isinf(peak) ? "the block overturns"
           : peak == 0        ? "0: the block is not lifted and stays at rest"
                              : fmt::format("{:.4g} degrees, {:.3g} % of alpha",
                                            in_degrees(peak * slenderness), 100 * peak);
}

} // namespace overturn
