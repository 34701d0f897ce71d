// What becomes of single blocks: the fields of a list of blocks with motions of their own.
#pragma once

#include "overturn/sweep/block_list.hpp"
#include "overturn/sweep/scene.hpp"
#include "overturn/sweep/tile.hpp"

#include <cstdint>
#include <string>

namespace overturn {

/// Where the fields are written, one value per block.
struct FieldArrays {
    std::uint8_t* region;
    std::uint8_t* status;
    double* peak;
    double* margin;
};

/// Computes the fields of every block, with the widest kernel and in the tiles of `overturn run`,
/// so that the bits are those of a list job. Returns implausible_values(). Throws ListError,
/// ProcessorError or TileDropped.
std::string evaluate(const Scene& scene, const Numerics& numerics, const Columns& columns,
                     const FieldArrays& to, const DropRequested& drop_requested);

} // namespace overturn
