// bench_blocks COUNT: reads five columns of COUNT doubles from stdin (width, height,
// restitution_of_maximum, pga, pulse_period) and prints the seconds that all blocks take under
// one-sine pulses, with the method taylor at 1e-9: in the kernel, and in compute_tile().
// `tools/bench python` compares them with overturn.evaluate().
#include "point_run.hpp"

#include "overturn/problem/coordinates.hpp"
#include "overturn/problem/given.hpp"
#include "overturn/sweep/compute_tile.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace overturn;
using Clock = std::chrono::steady_clock;

constexpr int rounds = 5;

std::vector<Given> read_columns(std::size_t count)
{
    std::vector<Given> columns;
    for (const char* name : {"width", "height", "restitution_of_maximum", "pga", "pulse_period"}) {
        AxisList values(count);
        if (std::fread(values.data(), sizeof(double), count, stdin) != count) {
            std::fputs("bench_blocks: stdin ended too early\n", stderr);
            std::exit(2);
        }
        columns.push_back({&quantity(name), name, Axis(std::move(values)), GivenAs::column});
    }
    return columns;
}

/// The shortest of several rounds over all tiles [s]; seconds_of(tile): what counts.
template <class SecondsOf>
double shortest(const Tiling& tiling, const SecondsOf& seconds_of)
{
    double least = 1e300;
    for (int round = 0; round < rounds; ++round) {
        double seconds = 0;
        for (std::int64_t number = 0; number < tiling.size(); ++number) {
            seconds += seconds_of(tiling[number]);
        }
        least = std::min(least, seconds);
    }
    return least;
}

} // namespace

int main(int count, char** words)
{
    const Problem problem{
        .grid = grid_of({}, read_columns(std::size_t(count > 1 ? std::atoll(words[1]) : 0))),
        .numerics = {.method = Method::taylor},
        .fields = {Field::region, Field::status, Field::peak, Field::margin}};
    const Kernel kernel = widest_kernel();
    const Tiling tiling = tiling_of(problem);
    const auto since = [](Clock::time_point start) {
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    const double in_kernel = shortest(tiling, [&](const Tile& tile) {
        const PointRun points(problem.scene,
                              Coordinates(problem.scene, problem.grid, tile).points(), kernel);
        Outcomes outcomes(std::size_t(tile.points()),
                          {.peak = true, .region = true, .margin = true});
        const auto start = Clock::now();
        points.run(problem.numerics, outcomes, points.all());
        return since(start);
    });
    const double in_tiles = shortest(tiling, [&](const Tile& tile) {
        const auto start = Clock::now();
        compute_tile(problem, tile, kernel);
        return since(start);
    });
    std::printf("%.6f %.6f\n", in_kernel, in_tiles);
}
