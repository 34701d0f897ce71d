// The partition of the points of a result into tiles: rectangles in its last two dimensions, at one
// index of each other dimension. A tile is the unit of work of a rank and a chunk of the file.
#pragma once

#include "overturn/sweep/plane.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace overturn {

/// Number of points along each dimension, slowest first; at least two dimensions.
using Shape = std::vector<std::int64_t>;

/// ([motion,] slenderness, restitution, amplitude, frequency); motion only if there are records.
Shape shape_of(const Plane& plane);

/// The points of one tile: an index into each outer dimension, and the index ranges [begin, begin +
/// count) of the last two.
struct Tile {
    std::int64_t number = 0;
    std::vector<std::int64_t> outer;
    std::int64_t row_begin = 0;
    std::int64_t row_count = 0;
    std::int64_t column_begin = 0;
    std::int64_t column_count = 0;

    std::int64_t points() const { return row_count * column_count; }
};

/// Called at least once a second by the thread that computes a tile. Once it returns true, it must
/// remain true, and the computation throws TileDropped.
using DropRequested = std::function<bool()>;
class TileDropped {};

/// Partitions a shape into equal tiles; those at the far edges may be smaller. Tiles are numbered
/// from 0 in the order of the dimensions, columns fastest.
class Tiling {
public:
    /// rows, columns: of a tile [points]; both are limited to those of the shape. Does not throw.
    Tiling(Shape shape, std::int64_t rows, std::int64_t columns);

    /// The tiling that `overturn run` uses for a plane.
    explicit Tiling(const Plane& plane);

    std::int64_t size() const;
    Tile operator[](std::int64_t number) const;

    /// The shape of all points, and that of one tile, which is 1 in each outer dimension.
    const Shape& shape() const { return shape_; }
    Shape tile_shape() const;
    std::int64_t points_of_tile() const { return rows_ * columns_; }

private:
    Shape shape_;
    std::int64_t rows_, columns_;            ///< of a tile
    std::int64_t tiles_down_, tiles_across_; ///< at one index of each outer dimension
};

} // namespace overturn
