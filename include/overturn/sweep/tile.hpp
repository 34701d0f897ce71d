// How a plane is cut into tiles: rectangles of frequency and amplitude at one slenderness and one
// restitution. A tile is what a rank computes in one go, and a chunk of the result file.
#pragma once

#include "overturn/sweep/plane.hpp"

#include <cstdint>

namespace overturn {

/// The points of one tile: the index ranges [begin, begin + count) of the plane's axes.
struct Tile {
    std::int64_t number = 0;
    std::int64_t slenderness = 0;
    std::int64_t restitution = 0;
    std::int64_t amplitude_begin = 0;
    std::int64_t amplitude_count = 0;
    std::int64_t frequency_begin = 0;
    std::int64_t frequency_count = 0;

    std::int64_t points() const { return amplitude_count * frequency_count; }
};

/// Cuts a plane into equal tiles; those at the far edges may be smaller. Tiles are numbered from 0,
/// frequency fastest, then amplitude, restitution and slenderness.
class Tiling {
public:
    /// Extents in points; both are cut down to the plane's own. Throws nothing.
    Tiling(const Plane& plane, std::int64_t amplitude_extent, std::int64_t frequency_extent);

    /// The tiling that `overturn run` uses.
    explicit Tiling(const Plane& plane);

    std::int64_t size() const;
    Tile operator[](std::int64_t number) const;

    std::int64_t amplitude_extent() const { return amplitude_extent_; }
    std::int64_t frequency_extent() const { return frequency_extent_; }

private:
    std::int64_t slendernesses_, restitutions_, amplitudes_, frequencies_;
    std::int64_t amplitude_extent_, frequency_extent_;
    std::int64_t tile_rows_, tile_columns_;
};

} // namespace overturn
