// How the points of a result are cut into tiles: rectangles of its last two dimensions at one place
// of all others. A tile is what a rank computes in one go, and a chunk of the result file.
#pragma once

#include "overturn/sweep/plane.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace overturn {

/// Number of points along each dimension, slowest first; two dimensions at least.
using Shape = std::vector<std::int64_t>;

/// (slenderness, restitution, amplitude, frequency).
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

/// Asked every second or more often while a tile is computed, by its own thread. Once it is true it
/// stays so, and TileDropped leaves whatever computes the tile.
using DropRequested = std::function<bool()>;
class TileDropped {};

/// Cuts a shape into equal tiles; those at the far edges may be smaller. Tiles are numbered from 0
/// in the order of the dimensions, columns fastest.
class Tiling {
public:
    /// rows, columns: of a tile [points]; both are cut down to the shape's own. Throws nothing.
    Tiling(Shape shape, std::int64_t rows, std::int64_t columns);

    /// The tiling that `overturn run` uses for a plane.
    explicit Tiling(const Plane& plane);

    std::int64_t size() const;
    Tile operator[](std::int64_t number) const;

    /// Of all points, and of one tile: 1 in each outer dimension.
    const Shape& shape() const { return shape_; }
    Shape tile_shape() const;
    std::int64_t points_of_tile() const { return rows_ * columns_; }

private:
    Shape shape_;
    std::int64_t rows_, columns_;            ///< of a tile
    std::int64_t tiles_down_, tiles_across_; ///< at one place of the outer dimensions
};

} // namespace overturn
