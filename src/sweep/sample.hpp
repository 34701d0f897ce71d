// Selects a representative sample of the points of a large grid.
#pragma once

#include "overturn/problem/grid.hpp"
#include "overturn/problem/tile.hpp"

#include <cstdint>
#include <vector>

namespace overturn {

/// A grid of at most `points` points, spread evenly over this one, which has no table, including
/// the ends of each axis, with at most three values of each quantity other than the strength and
/// the fastest one; one point for each of these and each motion if that is more. points: at
/// least 9.
Grid sample_of(const Grid& grid, std::int64_t points);

/// About `wanted` points, spread over all rows and columns of a grid: for each tile, their numbers
/// row by row, in ascending order. All points if there are fewer than twice as many.
std::vector<std::vector<int>> evenly_chosen(const Tiling& tiling, std::int64_t wanted);

} // namespace overturn
