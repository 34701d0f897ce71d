// From a tile to the values of its fields: the forced stage of each point, then its region.
#pragma once

#include "overturn/sweep/fields.hpp"
#include "overturn/sweep/plane.hpp"
#include "overturn/sweep/scene.hpp"
#include "overturn/sweep/tile.hpp"

#include <string_view>
#include <vector>

namespace overturn {

/// The lane widths in which the forced stage can run. All give the same bits.
enum class Kernel { one_lane, avx2, avx512 };

inline constexpr std::array<std::string_view, 3> kernel_names{"double", "avx2", "avx512"};
constexpr std::string_view name_of(Kernel kernel)
{
    return kernel_names[std::size_t(kernel)];
}

/// Points that the kernel integrates in lockstep.
constexpr int lanes_of(Kernel kernel)
{
    return kernel == Kernel::avx512 ? 8 : kernel == Kernel::avx2 ? 4 : 1;
}

/// Whether this processor can run the kernel.
bool runs_here(Kernel kernel);

/// The widest kernel that this processor can run.
Kernel widest_kernel();

/// The requested fields of one tile, in the order in which they were requested.
struct TileFields {
    std::vector<FieldValues> values;
};

/// Computes every point of a tile. The values of a point depend on the point, the scene and the
/// numerics alone: not on the tile's shape, the other points, or the kernel.
TileFields sweep_tile(const Scene& scene, const Numerics& numerics, const Plane& plane,
                      const Tile& tile, const std::vector<Field>& fields, Kernel kernel);

} // namespace overturn
