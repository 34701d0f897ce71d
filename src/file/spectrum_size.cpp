#include "overturn/file/spectrum_file.hpp"

namespace overturn {

// Values, coordinates, checksums and texts are exact. What HDF5 adds was measured on files of 1 to
// 390625 tiles: 18 KB for the file, 1 KB for each field, and for its index of chunks nodes of 3656
// bytes, one for 56 tiles (rounded up here).
std::uint64_t spectrum_file_bytes(const Job& job, const Tiling& tiling)
{
    const Plane& plane = job.plane;
    const auto tiles = std::uint64_t(tiling.size());
    // Tiles at the far edges take the space of whole ones.
    const auto points =
        tiles * std::uint64_t(tiling.amplitude_extent() * tiling.frequency_extent());
    const auto numbers = std::uint64_t(plane.frequency.size() + plane.amplitude.size() +
                                       plane.restitution.size() + plane.slenderness.size() +
                                       plane.slenderness.size() * plane.restitution.size()) +
                         tiles;

    std::uint64_t bytes = 20480 + numbers * sizeof(double);
    if (plane.block) {
        bytes +=
            2400 + std::uint64_t(plane.frequency.size() + plane.amplitude.size()) * sizeof(double);
    }
    if (job.product == Product::boundary) {
        bytes += 1200 + std::uint64_t(job.scan.size()) * sizeof(double);
    }
    for (const Field field : job.fields) {
        bytes += 1200 + 3656 * (tiles / 55 + 2) + points * bytes_per_point(field);
    }
    for (const std::string& setting : job.overrides) {
        bytes += setting.size() + 1;
    }
    return bytes + 2 * job.title.size() + job.given.size() + job.resolved.size();
}

} // namespace overturn
