// The methods of overturn, run as in the program: tile by tile on the widest kernel.
#include "peer.hpp"

#include "overturn/sweep/sweep_tile.hpp"

#include <variant>

namespace overturn::benchmarks {

namespace {

/// One end per point of the problem; end_of(values, i) is the end of point i of a tile.
template <class End, class EndOf>
std::vector<End> ends_of_tiles(const Problem& problem, const Numerics& numerics,
                               const std::vector<Field>& fields, const EndOf& end_of)
{
    const Tiling tiling(problem.plane);
    const std::int64_t columns = problem.plane.frequency.size();
    std::vector<End> ends(problem.points.size());
    for (std::int64_t number = 0; number < tiling.size(); ++number) {
        const Tile tile = tiling[number];
        const TileFields found =
            sweep_tile(problem.scene, numerics, problem.plane, tile, fields, widest_kernel());
        for (std::int64_t i = 0; i < tile.points(); ++i) {
            const std::int64_t row = tile.begin.end()[-2] + i / tile.columns();
            const std::int64_t column = tile.begin.back() + i % tile.columns();
            ends[std::size_t(row * columns + column)] = end_of(found.values, std::size_t(i));
        }
    }
    return ends;
}

} // namespace

std::vector<PeerEnd<double>> solve_by_overturn(const Problem& problem, const Numerics& numerics)
{
    return ends_of_tiles<PeerEnd<double>>(
        problem, numerics, {Field::region, Field::angle, Field::velocity},
        [](const auto& values, std::size_t i) -> PeerEnd<double> {
            return {std::get<std::vector<double>>(values[1])[i],
                    std::get<std::vector<double>>(values[2])[i],
                    Region(std::get<std::vector<std::uint8_t>>(values[0])[i])};
        });
}

std::vector<PointEffort> efforts_of_overturn(const Problem& problem, const Numerics& numerics)
{
    return ends_of_tiles<PointEffort>(
        problem, numerics, {Field::error, Field::steps},
        [](const auto& values, std::size_t i) -> PointEffort {
            return {std::get<std::vector<double>>(values[0])[i],
                    double(std::get<std::vector<std::uint32_t>>(values[1])[i])};
        });
}

std::vector<Solver> overturn_solvers(bool recorded)
{
    std::vector<Solver> solvers;
    for (std::size_t i = 0; i < method_names.size(); ++i) {
        const auto solve = [method = Method(i)](const Problem& problem, double tolerance) {
            return solve_by_overturn(problem, {.method = method, .tolerance = tolerance});
        };
        if (!recorded || Method(i) == Method::taylor) {
            solvers.push_back({"overturn_" + std::string(method_names[i]), solve});
        }
    }
    return solvers;
}

} // namespace overturn::benchmarks
