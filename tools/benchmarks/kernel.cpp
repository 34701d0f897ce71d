// bench_kernel: times one tile for every method, every kernel that this processor supports and
// three tolerances. `tools/bench kernel` builds and runs it, and compares the kernels.
#include "peer.hpp"

#include "overturn/sweep/compute_tile.hpp"

#include <benchmark/benchmark.h>
#include <fmt/core.h>

namespace overturn::benchmarks {

namespace {

constexpr int side = 64; // points of each axis; one tile

void compute_one_tile(benchmark::State& state, const Numerics& numerics, Kernel kernel)
{
    const PeerProblem paper = paper_block_problem(side);
    const Problem problem{
        .scene = paper.scene, .grid = paper.grid, .numerics = numerics, .fields = {Field::region}};
    const Tile tile = tiling_of(problem)[0];
    for ([[maybe_unused]] const auto round : state) {
        benchmark::DoNotOptimize(compute_tile(problem, tile, kernel));
    }
    using benchmark::Counter;
    state.counters["seconds_per_point"] =
        Counter(double(tile.points()), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void register_all()
{
    for (std::size_t method = 0; method < names_of<Method>.size(); ++method) {
        for (const Kernel kernel : {Kernel::one_lane, Kernel::avx2, Kernel::avx512}) {
            if (!runs_here(kernel)) {
                continue;
            }
            for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
                const Numerics numerics{.method = Method(method), .tolerance = tolerance};
                const std::string name = fmt::format("{}/{:.0e}/{}", name_of(numerics.method),
                                                     tolerance, name_of(kernel));
                benchmark::RegisterBenchmark(name.c_str(), compute_one_tile, numerics, kernel)
                    ->Unit(benchmark::kMillisecond);
            }
        }
    }
}

} // namespace

} // namespace overturn::benchmarks

int main(int count, char** words)
{
    overturn::keep_freed_memory(); // as in the program
    overturn::benchmarks::register_all();
    benchmark::Initialize(&count, words);
    if (benchmark::ReportUnrecognizedArguments(count, words)) {
        return 2;
    }
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
