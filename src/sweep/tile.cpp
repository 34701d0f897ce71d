#include "overturn/sweep/tile.hpp"

#include <algorithm>

namespace overturn {

namespace {

std::int64_t ceiling_of_ratio(std::int64_t a, std::int64_t b)
{
    return (a + b - 1) / b;
}

} // namespace

Tiling::Tiling(const Plane& plane, std::int64_t amplitude_extent, std::int64_t frequency_extent)
    : slendernesses_(plane.slenderness.size()), restitutions_(plane.restitution.size()),
      amplitudes_(plane.amplitude.size()), frequencies_(plane.frequency.size()),
      amplitude_extent_(std::min(amplitude_extent, amplitudes_)),
      frequency_extent_(std::min(frequency_extent, frequencies_)),
      tile_rows_(ceiling_of_ratio(amplitudes_, amplitude_extent_)),
      tile_columns_(ceiling_of_ratio(frequencies_, frequency_extent_))
{}

// 64 x 64 points take some milliseconds: long beside a message between ranks (microseconds), short
// beside a run. A spectrum of 100 x 100 still has work for a few ranks.
Tiling::Tiling(const Plane& plane) : Tiling(plane, 64, 64) {}

std::int64_t Tiling::size() const
{
    return slendernesses_ * restitutions_ * tile_rows_ * tile_columns_;
}

Tile Tiling::operator[](std::int64_t number) const
{
    const std::int64_t column = number % tile_columns_;
    const std::int64_t row = number / tile_columns_ % tile_rows_;
    const std::int64_t plane = number / (tile_columns_ * tile_rows_);
    Tile tile;
    tile.number = number;
    tile.slenderness = plane / restitutions_;
    tile.restitution = plane % restitutions_;
    tile.amplitude_begin = row * amplitude_extent_;
    tile.amplitude_count = std::min(amplitude_extent_, amplitudes_ - tile.amplitude_begin);
    tile.frequency_begin = column * frequency_extent_;
    tile.frequency_count = std::min(frequency_extent_, frequencies_ - tile.frequency_begin);
    return tile;
}

} // namespace overturn
