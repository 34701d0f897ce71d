#include "overturn/file/spectrum_file.hpp"

namespace overturn {

// Values, coordinates, checksums and texts are exact. What HDF5 adds was measured on files of 1 to
// 390625 tiles: 18 KB for the file, 1 KB for each field, and for its index of chunks nodes of 3656
// bytes, one for 56 tiles (rounded up here).
long double spectrum_file_bytes(const Job& job, const Tiling& tiling)
{
    const Plane& plane = job.plane;
    using Count = long double;
    const auto tiles = Count(tiling.size());
    // Tiles at the far edges take the space of whole ones.
    const Count points = tiles * Count(tiling.points_of_tile());
    Count numbers = Count(plane.slenderness.size() * plane.restitution.size()) + tiles;
    for (const std::int64_t size : tiling.shape()) {
        numbers += Count(size);
    }

    Count bytes = 20480 + numbers * sizeof(double);
    if (plane.block) {
        bytes +=
            2400 + (Count(plane.frequency.size()) + Count(plane.amplitude.size())) * sizeof(double);
    }
    if (job.product == Product::boundary) {
        bytes += 1200 + Count(job.scan.size()) * sizeof(double);
    }
    for (const Field field : job.fields) {
        bytes +=
            1200 + 3656 * Count(tiling.size() / 55 + 2) + points * Count(bytes_per_point(field));
    }
    for (const std::string& setting : job.overrides) {
        bytes += Count(setting.size() + 1);
    }
    return bytes + Count(2 * job.title.size() + job.given.size() + job.resolved.size());
}

} // namespace overturn
