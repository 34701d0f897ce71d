// What becomes of single blocks: the fields of a list of blocks with motions of their own.
#pragma once

#include "overturn/problem/given.hpp"
#include "overturn/problem/scene.hpp"
#include "overturn/problem/tile.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace overturn {

/// Named columns of equal length: quantities of the blocks and their motions.
using Columns = std::map<std::string, std::vector<double>>;

/// Where the fields are written, one value per block.
struct FieldArrays {
    std::uint8_t* region;
    std::uint8_t* status;
    double* peak;
    double* margin;
};

/// Computes the fields of every block, with the widest kernel and in the tiles of `overturn run`,
/// so that the bits are those of a list job. Returns implausible_values(). Throws GivenError,
/// Error or TileDropped.
std::string evaluate(const Scene& scene, const Numerics& numerics, const Columns& columns,
                     const FieldArrays& to, const DropRequested& drop_requested);

} // namespace overturn
