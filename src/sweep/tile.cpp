#include "overturn/sweep/tile.hpp"

#include <algorithm>
#include <cassert>

namespace overturn {

namespace {

std::int64_t ceiling_of_ratio(std::int64_t a, std::int64_t b)
{
    return (a + b - 1) / b;
}

} // namespace

Shape shape_of(const Plane& plane)
{
    Shape shape{plane.slenderness.size(), plane.restitution.size(), plane.amplitude.size(),
                plane.frequency.size()};
    if (plane.motions > 0) {
        shape.insert(shape.begin(), plane.motions);
    }
    return shape;
}

Tiling::Tiling(Shape shape, std::int64_t rows, std::int64_t columns) : shape_(std::move(shape))
{
    assert(shape_.size() >= 2);
    const std::int64_t all_columns = shape_.back();
    const std::int64_t all_rows = shape_[shape_.size() - 2];
    rows_ = std::min(rows, all_rows);
    columns_ = std::min(columns, all_columns);
    tiles_down_ = ceiling_of_ratio(all_rows, rows_);
    tiles_across_ = ceiling_of_ratio(all_columns, columns_);
}

// 64 x 64 points take a few milliseconds: long compared with a message (microseconds), short
// compared with a run. A spectrum of 100 x 100 points still provides work for a few ranks. Under a
// record, 16 x 16 points take as long.
Tiling::Tiling(const Plane& plane)
    : Tiling(shape_of(plane), plane.motions > 0 ? 16 : 64, plane.motions > 0 ? 16 : 64)
{}

std::int64_t Tiling::size() const
{
    std::int64_t tiles = tiles_down_ * tiles_across_;
    for (std::size_t i = 0; i + 2 < shape_.size(); ++i) {
        tiles *= shape_[i];
    }
    return tiles;
}

Shape Tiling::tile_shape() const
{
    Shape shape(shape_.size() - 2, 1);
    shape.push_back(rows_);
    shape.push_back(columns_);
    return shape;
}

Tile Tiling::operator[](std::int64_t number) const
{
    Tile tile;
    tile.number = number;
    tile.column_begin = number % tiles_across_ * columns_;
    tile.row_begin = number / tiles_across_ % tiles_down_ * rows_;
    tile.column_count = std::min(columns_, shape_.back() - tile.column_begin);
    tile.row_count = std::min(rows_, shape_[shape_.size() - 2] - tile.row_begin);
    std::int64_t place = number / (tiles_across_ * tiles_down_);
    tile.outer.resize(shape_.size() - 2);
    for (std::size_t i = tile.outer.size(); i-- > 0;) {
        tile.outer[i] = place % shape_[i];
        place /= shape_[i];
    }
    return tile;
}

} // namespace overturn
