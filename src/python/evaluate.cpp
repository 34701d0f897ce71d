#include "evaluate.hpp"

#include "overturn/problem/plausibility.hpp"
#include "overturn/sweep/compute_tile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

namespace overturn {

namespace {

const std::vector<Field> fields{Field::region, Field::status, Field::peak, Field::margin};

template <class Value>
void copy(const FieldValues& from, Value* to)
{
    const auto& values = std::get<std::vector<Value>>(from);
    std::copy(values.begin(), values.end(), to);
}

} // namespace

std::string evaluate(const Scene& scene, const Numerics& numerics, const Columns& columns,
                     const FieldArrays& to, const DropRequested& drop_requested)
{
    const Kernel kernel = widest_kernel();
    std::vector<Given> given;
    for (const auto& [name, values] : columns) {
        const Quantity& quantity = overturn::quantity(name);
        for (std::size_t row = 0; row < values.size(); ++row) {
            if (!quantity.allows(values[row])) {
                throw GivenError(std::int64_t(row), name,
                                 fmt::format(" = {} is outside {}. {}", values[row],
                                             quantity.interval, quantity.reason));
            }
        }
        given.push_back({&quantity, name, Axis(values), GivenAs::column});
    }
    if (scene.is_recorded()) {
        given.push_back({&quantity("motion"), "record", Axis(AxisList{1}), GivenAs::number});
    }
    const Problem problem{scene, grid_of(scene, std::move(given)), numerics, Product::spectrum,
                          fields};
    const Tiling tiling = tiling_of(problem);
    for (std::int64_t number = 0; number < tiling.size(); ++number) {
        const Tile tile = tiling[number];
        const TileFields computed = compute_tile(problem, tile, kernel, drop_requested);
        const std::int64_t first = tile.begin[0];
        copy(computed.values[0], to.region + first);
        copy(computed.values[1], to.status + first);
        copy(computed.values[2], to.peak + first);
        copy(computed.values[3], to.margin + first);
    }
    return implausible_values(scene, problem.grid);
}

} // namespace overturn
