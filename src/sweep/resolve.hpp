// From points that are made ready to their ends, with verdicts as sure as the job asks for.
#pragma once

#include "point_run.hpp"

namespace overturn {

/// Where the points end: integrated once; or, if verdicts are to be resolved, those in doubt again,
/// with more and more digits. What stays in doubt gets end_flag::unresolved.
Ends ends_of(const PointRun& points, const Numerics& numerics, const Records& records);

} // namespace overturn
