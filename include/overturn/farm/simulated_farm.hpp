// Event-based simulation of a farm. Tiles are dispatched by TileDispatcher, as in a run; the rest
// is a model:
//   - a worker requests one range ahead, and a message takes 2 us;
//   - the times of tiles are independent, with a gamma distribution, so that the time of a range is
//     a gamma variate, too;
//   - rank 0 answers requests one by one, and computes a tile when there are none.
#pragma once

#include "overturn/farm/tile_dispatcher.hpp"

#include <cstdint>

namespace overturn {

struct FarmCosts {
    double answer; ///< of rank 0 to a request [s]
    double tile;   ///< mean time to compute and write a tile [s]
    double spread; ///< standard deviation of the time of a tile over its mean [1]
};

struct SimulatedFarm {
    double seconds;    ///< from the first request to the end of the last tile
    double efficiency; ///< share of the time of all ranks that is spent on tiles [1]
    double answering;  ///< share of the time of rank 0 that is spent on answers [1]
};

/// ranks, tiles: at least 1. The result is reproducible. Memory: 8 bytes per tile, 50 per rank.
SimulatedFarm simulate_farm(const FarmCosts& costs, int ranks, std::int64_t tiles,
                            const RangeLimits& limits);

/// The same with the limits of a run. Above some millions of tiles, several are simulated as one.
SimulatedFarm simulate_farm(const FarmCosts& costs, int ranks, std::int64_t tiles);

} // namespace overturn
