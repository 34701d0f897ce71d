#include "overturn/sweep/tile.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <numeric>

namespace overturn {

namespace {

std::int64_t ceiling_of_ratio(std::int64_t a, std::int64_t b)
{
    return (a + b - 1) / b;
}

} // namespace

std::int64_t count_points(const Shape& shape)
{
    return std::accumulate(shape.begin(), shape.end(), std::int64_t(1), std::multiplies());
}

Shape shape_of(const Plane& plane)
{
    if (plane.list && plane.list->has_own_motions) {
        return {plane.list->size};
    }
    Shape shape;
    if (plane.list) {
        shape = {plane.list->size, plane.amplitude.size()};
    } else {
        shape = {plane.slenderness.size(), plane.restitution.size(), plane.amplitude.size()};
    }
    if (!plane.list || plane.motions == 0) { // a list under records has no axis of sizes
        shape.push_back(plane.frequency.size());
    }
    if (plane.motions > 0) {
        shape.insert(shape.begin(), plane.motions);
    }
    return shape;
}

Tiling::Tiling(Shape shape, const Shape& tile)
    : shape_(std::move(shape)), tile_shape_(shape_.size(), 1)
{
    assert(tile.size() <= shape_.size());
    const std::size_t outer = shape_.size() - tile.size();
    for (std::size_t i = 0; i < shape_.size(); ++i) {
        if (i >= outer) {
            tile_shape_[i] = std::min(tile[i - outer], shape_[i]);
        }
        tiles_.push_back(ceiling_of_ratio(shape_[i], tile_shape_[i]));
    }
}

namespace {

// 64 x 64 points take a few milliseconds: long compared with a message (microseconds), short
// compared with a run. A spectrum of 100 x 100 points still provides work for a few ranks. Under a
// record, 16 x 16 points take as long.
Shape tile_of(const Plane& plane)
{
    const std::int64_t side = plane.motions > 0 ? 16 : 64;
    if (!plane.list) {
        return {side, side};
    }
    // A tile of a list has at most as many points, in any shape: the other dimensions first, then
    // as many blocks as possible.
    Shape tile = shape_of(plane);
    if (plane.motions > 0 && !plane.list->has_own_motions) {
        tile.erase(tile.begin());
    }
    std::int64_t left = side * side;
    for (std::size_t i = tile.size(); i-- > 0;) {
        tile[i] = std::min(tile[i], left);
        left /= tile[i];
    }
    return tile;
}

} // namespace

Tiling::Tiling(const Plane& plane) : Tiling(shape_of(plane), tile_of(plane)) {}

// Large cells need large tiles. A tile of 256 x 256 points still takes only a few milliseconds,
// because few of its points are integrated inside the regions of fine spectra.
Tiling filled_tiling(const Plane& plane)
{
    const std::int64_t side =
        std::max(plane.amplitude.size(), plane.frequency.size()) < 1024 ? 128 : 256;
    return Tiling(shape_of(plane), {side, side});
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
