// Lengths of blocks that cannot be in metres, and what they probably are in metres.
#pragma once

#include "overturn/problem/coordinates.hpp"
#include "overturn/problem/grid.hpp"
#include "overturn/problem/scene.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

struct WrongLength {
    std::string_view quantity;           ///< that is refused
    std::vector<std::size_t> dimensions; ///< on which the lengths depend, slowest first
    std::size_t place;                   ///< along these
    std::string message;                 ///< follows the name of the quantity
};

/// The first block of the corners that is so large, or has a length so much larger than the others,
/// that lengths must be in another unit. Nothing is wrong if only the shape of the block matters,
/// or if gravity is not in m/s2: lengths in centimetres agree with gravity in cm/s2.
std::optional<WrongLength> length_not_in_metres(const Scene& scene, const Coordinates& coordinates,
                                                const Grid& corners);

} // namespace overturn
