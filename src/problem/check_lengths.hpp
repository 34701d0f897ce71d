// Lengths of blocks that cannot be in metres, and what they probably are in metres.
#pragma once

#include "overturn/problem/coordinates.hpp"
#include "overturn/problem/grid.hpp"
#include "overturn/problem/scene.hpp"

namespace overturn {

/// Throws GivenError for the first block of the corners that is so large, or has a length so much
/// larger than the others, that lengths must be in another unit: computed as that of a tower,
/// hardly anything would topple it. Nothing is wrong if only the shape of the block matters, or if
/// gravity is not in m/s2: lengths in centimetres agree with gravity in cm/s2.
void expect_metres(const Scene& scene, const Coordinates& coordinates, const Grid& corners);

} // namespace overturn
