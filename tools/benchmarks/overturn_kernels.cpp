// The methods of overturn, run as in the program: tile by tile on the widest kernel.
#include "peer.hpp"

#include "overturn/sweep/sweep_tile.hpp"

#include <variant>

namespace overturn::benchmarks {

std::vector<PeerEnd<double>> solve_by_overturn(const Problem& problem, const Numerics& numerics)
{
    const Tiling tiling(problem.plane);
    const std::int64_t columns = problem.plane.frequency.size();
    std::vector<PeerEnd<double>> ends(problem.points.size());
    for (std::int64_t number = 0; number < tiling.size(); ++number) {
        const Tile tile = tiling[number];
        const TileFields fields =
            sweep_tile(Scene{}, numerics, problem.plane, tile,
                       {Field::region, Field::angle, Field::velocity}, widest_kernel());
        const auto& region = std::get<std::vector<std::uint8_t>>(fields.values[0]);
        const auto& angle = std::get<std::vector<double>>(fields.values[1]);
        const auto& velocity = std::get<std::vector<double>>(fields.values[2]);
        for (std::int64_t i = 0; i < tile.points(); ++i) {
            const std::int64_t row = tile.row_begin + i / tile.column_count;
            const std::int64_t column = tile.column_begin + i % tile.column_count;
            ends[std::size_t(row * columns + column)] = {
                angle[std::size_t(i)], velocity[std::size_t(i)], Region(region[std::size_t(i)])};
        }
    }
    return ends;
}

std::vector<Solver> overturn_solvers()
{
    std::vector<Solver> solvers;
    for (std::size_t i = 0; i < method_names.size(); ++i) {
        const auto solve = [method = Method(i)](const Problem& problem, double tolerance) {
            return solve_by_overturn(problem, {.method = method, .tolerance = tolerance});
        };
        solvers.push_back({"overturn_" + std::string(method_names[i]), solve});
    }
    return solvers;
}

} // namespace overturn::benchmarks
