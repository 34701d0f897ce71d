// How long a job takes, from a short measured sample of its plane.
#pragma once

#include "overturn/job/job.hpp"
#include "overturn/sweep/sweep_tile.hpp"

namespace overturn {

/// Computing time of the whole plane on one rank [s], writing not included. Takes about 0.3 s; the
/// sampled points are the same each time, as many of them as the time allows.
double estimated_seconds(const Job& job, Kernel kernel);

} // namespace overturn
