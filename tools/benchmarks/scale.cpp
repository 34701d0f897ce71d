// bench_scale ANSWER TILE MOST_RANKS: simulated runs on up to MOST_RANKS ranks, see
// simulated_farm.hpp. ANSWER and TILE: seconds that rank 0 takes to answer a request, and a rank
// for a tile, of which half is the standard deviation. Prints, as JSON, the seconds that taking a
// tile from a pool takes, while all cores of this host do so; for each run, the share of the time
// of all ranks that is spent on tiles, and the share of rank 0 on answers.
#include "overturn/farm/simulated_farm.hpp"
#include "overturn/farm/tile_pool.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace overturn {
namespace {

double seconds_of_take()
{
    constexpr std::int64_t tiles = 10'000'000;
    const auto pool = std::make_unique<TilePool>();
    pool->put({0, tiles});
    const auto start = std::chrono::steady_clock::now();
    {
        std::vector<std::jthread> ranks(std::max(2U, std::thread::hardware_concurrency()));
        for (std::jthread& rank : ranks) {
            rank = std::jthread([&pool] {
                while (pool->take()) {
                }
            });
        }
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    return seconds.count() / double(tiles);
}

std::string simulated(const FarmCosts& costs, int ranks, int ranks_per_node,
                      std::int64_t tiles_per_rank)
{
    const TileLimits limits =
        tile_limits((ranks + ranks_per_node - 1) / ranks_per_node, costs.answer, costs.tile);
    const SimulatedFarm found =
        simulate_farm(costs, ranks, ranks_per_node, ranks * tiles_per_rank, limits);
    return fmt::format("{{\"ranks\": {}, \"ranks_per_node\": {}, \"tiles_per_rank\": {}, "
                       "\"efficiency\": {}, \"answering\": {}, \"seconds\": {}}}",
                       ranks, ranks_per_node, tiles_per_rank, found.efficiency, found.answering,
                       found.seconds);
}

} // namespace
} // namespace overturn

int main(int argc, char** argv)
{
    using namespace overturn;
    if (argc != 4) {
        fmt::print(stderr, "usage: bench_scale ANSWER TILE MOST_RANKS\n");
        return 2;
    }
    const FarmCosts costs{.answer = std::atof(argv[1]),
                          .take = seconds_of_take(),
                          .tile = std::atof(argv[2]),
                          .spread = 0.5};
    std::vector<std::string> runs;
    for (int ranks = 1000; ranks <= std::atoi(argv[3]); ranks *= 10) {
        for (const int ranks_per_node : {1, 64, 128}) {
            for (const std::int64_t tiles_per_rank : {100, 1000}) {
                runs.push_back(simulated(costs, ranks, ranks_per_node, tiles_per_rank));
            }
        }
    }
    fmt::print("{{\"take\": {}, \"runs\": [\n{}\n]}}\n", costs.take, fmt::join(runs, ",\n"));
}
