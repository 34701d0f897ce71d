#include "evaluate.hpp"

#include "overturn/sweep/plausibility.hpp"
#include "overturn/sweep/sweep_tile.hpp"

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
    Plane plane;
    plane.motions = std::int64_t(scene.records.size());
    plane.list = std::make_shared<const BlockList>(block_list(scene, columns));
    const Tiling tiling(plane);
    for (std::int64_t number = 0; number < tiling.size(); ++number) {
        const Tile tile = tiling[number];
        const TileFields computed =
            sweep_tile(scene, numerics, plane, tile, fields, kernel, drop_requested);
        const std::int64_t first = tile.begin[0];
        copy(computed.values[0], to.region + first);
        copy(computed.values[1], to.status + first);
        copy(computed.values[2], to.peak + first);
        copy(computed.values[3], to.margin + first);
    }
    return implausible_values(scene, plane);
}

} // namespace overturn
