// The methods of overturn, run as in the program: tile by tile on the widest kernel.
#include "peer.hpp"

#include "overturn/sweep/compute_tile.hpp"

#include <variant>

namespace overturn::benchmarks {

namespace {

/// One end per point of the problem; end_of(values, i) is the end of point i of a tile.
template <class End, class EndOf>
std::vector<End> ends_of_tiles(const Problem& problem, const EndOf& end_of)
{
    const Tiling tiling = tiling_of(problem);
    const std::int64_t columns = tiling.shape().back();
    std::vector<End> ends(std::size_t(problem.grid.points()));
    for (std::int64_t number = 0; number < tiling.size(); ++number) {
        const Tile tile = tiling[number];
        const TileFields found = compute_tile(problem, tile, widest_kernel());
        for (std::int64_t i = 0; i < tile.points(); ++i) {
            const std::int64_t row = tile.begin[0] + i / tile.count[1];
            const std::int64_t column = tile.begin[1] + i % tile.count[1];
            ends[std::size_t(row * columns + column)] = end_of(found.values, std::size_t(i));
        }
    }
    return ends;
}

std::vector<PeerEnd<double>> solve_by_overturn(const PeerProblem& problem, const Numerics& numerics)
{
    return ends_of_tiles<PeerEnd<double>>(
        {.scene = problem.scene,
         .grid = problem.grid,
         .numerics = numerics,
         .fields = {Field::region, Field::angle, Field::velocity}},
        [](const auto& values, std::size_t i) -> PeerEnd<double> {
            return {std::get<std::vector<double>>(values[1])[i],
                    std::get<std::vector<double>>(values[2])[i],
                    Region(std::get<std::vector<std::uint8_t>>(values[0])[i])};
        });
}

} // namespace

std::vector<PointEffort> efforts_of_overturn(const PeerProblem& problem, const Numerics& numerics)
{
    return ends_of_tiles<PointEffort>(
        {.scene = problem.scene,
         .grid = problem.grid,
         .numerics = numerics,
         .fields = {Field::error, Field::steps}},
        [](const auto& values, std::size_t i) -> PointEffort {
            return {std::get<std::vector<double>>(values[0])[i],
                    double(std::get<std::vector<std::uint32_t>>(values[1])[i])};
        });
}

std::vector<Solver> overturn_solvers(bool recorded)
{
    std::vector<Solver> solvers;
    for (std::size_t i = 0; i < names_of<Method>.size(); ++i) {
        const auto solve = [method = Method(i)](const PeerProblem& problem, double tolerance) {
            return solve_by_overturn(problem, {.method = method, .tolerance = tolerance});
        };
        if (!recorded || Method(i) == Method::taylor) {
            solvers.push_back({"overturn_" + std::string(name_of(Method(i))), solve});
        }
    }
    return solvers;
}

} // namespace overturn::benchmarks
