// From a tile that is made ready to the ends of its points, with verdicts as sure as the job wants.
#pragma once

#include "tile_run.hpp"

namespace overturn {

/// Where the points of a tile end: integrated once; or, if verdicts are to be resolved, those in
/// doubt again, with more and more digits. What stays in doubt gets end_flag::unresolved.
Ends ends_of(const TileRun& tile, const Numerics& numerics, const Asked& asked);

} // namespace overturn
