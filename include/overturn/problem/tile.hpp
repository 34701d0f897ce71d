// The partition of the points of a result into tiles: equal boxes. A tile is the unit of work of a
// rank and a chunk of the file.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace overturn {

/// Number of points, or an index, along each dimension, slowest first.
using Shape = std::vector<std::int64_t>;

/// The number of points of a shape, or the largest integer if there are more.
std::int64_t count_points(const Shape& shape);

/// The points of one tile: the index range [begin, begin + count) of each dimension.
struct Tile {
    std::int64_t number = 0;
    Shape begin;
    Shape count;

    std::int64_t points() const { return count_points(count); }
};

/// Called at least once a second by the thread that computes a tile. Once it returns true, it must
/// remain true, and the computation throws TileDropped. The farm also handles messages in it.
using DropRequested = std::function<bool()>;
class TileDropped {};

/// Partitions a shape into equal tiles; those at the far edges may be smaller. Tiles are numbered
/// from 0 in the order of the dimensions, the last dimension fastest.
class Tiling {
public:
    /// tile: its extents [points], as many as those of the shape, to which they are limited.
    Tiling(Shape shape, const Shape& tile);

    std::int64_t size() const { return count_points(tiles_); }
    Tile operator[](std::int64_t number) const;

    /// The shape of all points, and that of one tile.
    const Shape& shape() const { return shape_; }
    const Shape& tile_shape() const { return tile_shape_; }
    std::int64_t points_of_tile() const { return count_points(tile_shape_); }

private:
    Shape shape_;
    Shape tile_shape_;
    Shape tiles_; ///< along each dimension
};

} // namespace overturn
