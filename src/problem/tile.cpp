#include "overturn/problem/tile.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

namespace overturn {

std::int64_t count_points(const Shape& shape)
{
    std::int64_t points = 1;
    for (const std::int64_t count : shape) {
        if (__builtin_mul_overflow(points, count, &points)) {
            return std::numeric_limits<std::int64_t>::max(); // a job that is refused
        }
    }
    return points;
}

Tiling::Tiling(Shape shape, const Shape& tile) : shape_(std::move(shape))
{
    assert(tile.size() == shape_.size());
    for (std::size_t i = 0; i < shape_.size(); ++i) {
        tile_shape_.push_back(std::min(tile[i], shape_[i]));
        tiles_.push_back((shape_[i] + tile_shape_[i] - 1) / tile_shape_[i]); // rounded up
    }
}

Tile Tiling::operator[](std::int64_t number) const
{
    Tile tile{number, Shape(shape_.size()), Shape(shape_.size())};
    std::int64_t place = number;
    for (std::size_t i = shape_.size(); i-- > 0;) {
        tile.begin[i] = place % tiles_[i] * tile_shape_[i];
        tile.count[i] = std::min(tile_shape_[i], shape_[i] - tile.begin[i]);
        place /= tiles_[i];
    }
    return tile;
}

} // namespace overturn
