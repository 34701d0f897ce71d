// All ranks of a farm but the first: they request ranges of tiles and compute them.
#pragma once

#include "overturn/farm/farm.hpp"

namespace overturn {

/// Returns when rank 0 has sent `end_of_work`. Throws SilentRank.
RankShare work(const MpiSession& session, const TileWork& tile_work, const StopRequest& stop,
               std::chrono::seconds patience);

} // namespace overturn
