// All ranks of a farm but the first: they ask for ranges of tiles, and compute them.
#pragma once

#include "overturn/farm/farm.hpp"

namespace overturn {

/// Until rank 0 dismisses it. Throws SilentRank.
RankShare work(const MpiSession& session, const TileWork& tile_work, const StopRequest& stop,
               std::chrono::seconds patience);

} // namespace overturn
