// Selects a representative sample of the points of a large plane.
#pragma once

#include "overturn/sweep/plane.hpp"
#include "overturn/sweep/tile.hpp"

#include <cstdint>
#include <vector>

namespace overturn {

/// A plane of at most `points` points, spread evenly over this one, including the ends of each
/// axis, with at most three slendernesses and three restitutions; one point for each of these and
/// each motion if that is more. points: at least 9.
Plane sample_of(const Plane& plane, std::int64_t points);

/// About `wanted` points, spread over all rows and columns of a plane: for each tile, their numbers
/// row by row, in ascending order. All points if there are fewer than twice as many.
std::vector<std::vector<int>> evenly_chosen(const Tiling& tiling, std::int64_t wanted);

} // namespace overturn
