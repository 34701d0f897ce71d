// bench_scale ANSWER TILE MOST_RANKS: simulated runs on up to MOST_RANKS ranks, see
// simulated_farm.hpp. ANSWER and TILE: seconds that rank 0 takes to answer a request, and a rank
// for a tile, of which half is the standard deviation. Prints, as JSON, the share of the time of
// all ranks that is spent on tiles, and the share of rank 0 on answers, for range lengths from
// range_limits(), and for ranges of 1 to 16 tiles.
#include "overturn/farm/simulated_farm.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace overturn {
namespace {

void print(const FarmCosts& costs, int ranks, std::int64_t tiles_per_rank, bool last)
{
    const auto outcome = [&](const RangeLimits& limits) {
        return simulate_farm(costs, ranks, ranks * tiles_per_rank, limits);
    };
    const SimulatedFarm now = outcome(range_limits(ranks, costs.answer, costs.tile));
    const SimulatedFarm fixed = outcome({});
    fmt::print("{{\"ranks\": {}, \"tiles_per_rank\": {}, \"efficiency\": {}, \"answering\": {}, "
               "\"seconds\": {}, \"fixed_efficiency\": {}, \"fixed_answering\": {}}}{}\n",
               ranks, tiles_per_rank, now.efficiency, now.answering, now.seconds, fixed.efficiency,
               fixed.answering, last ? "" : ",");
}

} // namespace
} // namespace overturn

int main(int argc, char** argv)
{
    if (argc != 4) {
        fmt::print(stderr, "usage: bench_scale ANSWER TILE MOST_RANKS\n");
        return 2;
    }
    const overturn::FarmCosts costs{std::atof(argv[1]), std::atof(argv[2]), 0.5};
    const int most_ranks = std::atoi(argv[3]);
    fmt::print("[\n");
    for (int ranks = 10; ranks <= most_ranks; ranks *= 10) {
        for (const std::int64_t tiles_per_rank : {100, 1000}) {
            const bool last = ranks > most_ranks / 10 && tiles_per_rank == 1000;
            overturn::print(costs, ranks, tiles_per_rank, last);
        }
    }
    fmt::print("]\n");
}
