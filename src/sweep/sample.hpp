// Which points of a large plane stand for all of them.
#pragma once

#include "overturn/sweep/plane.hpp"
#include "overturn/sweep/tile.hpp"

#include <cstdint>
#include <vector>

namespace overturn {

/// A plane of at most `points` points, spread evenly over this one, the ends of each axis among
/// them; of slendernesses and restitutions at most three each. points: at least 9.
Plane sample_of(const Plane& plane, std::int64_t points);

/// By tile, in ascending order, the points (counted row by row) of about `wanted` that are spread
/// over all rows and columns of a plane. All of them if there are less than twice as many.
std::vector<std::vector<int>> evenly_chosen(const Tiling& tiling, std::int64_t wanted);

} // namespace overturn
