// Event-based simulation of a farm. Nodes are given as many tiles as in a run; the rest is a model:
//   - ranks take tiles from the pool of their node, one after the other;
//   - a leader requests tiles up to 0.1 ms late, and rank 0 looks for requests up to 1 ms late:
//   both
//     compute tiles meanwhile; a message takes 2 us;
//   - rank 0 answers requests one by one;
//   - the times of tiles are independent, with a gamma distribution.
#pragma once

#include "overturn/farm/tile_dispatcher.hpp"

#include <cstdint>

namespace overturn {

struct FarmCosts {
    double answer; ///< of rank 0 to a request [s]
    double take;   ///< of a tile from the pool [s]
    double tile;   ///< mean time to compute and write a tile [s]
    double spread; ///< standard deviation of the time of a tile over its mean [1]
};

struct SimulatedFarm {
    double seconds;    ///< from the first request to the end of the last tile
    double efficiency; ///< share of the time of all ranks that is spent on tiles [1]
    double answering;  ///< share of the time of rank 0 that is spent on answers [1]
};

/// ranks, ranks_per_node, tiles: at least 1. The result is reproducible.
SimulatedFarm simulate_farm(const FarmCosts& costs, int ranks, int ranks_per_node,
                            std::int64_t tiles, const TileLimits& limits);

/// The same with the limits of a run. Above some millions of tiles, several are simulated as one.
SimulatedFarm simulate_farm(const FarmCosts& costs, int ranks, int ranks_per_node,
                            std::int64_t tiles);

} // namespace overturn
