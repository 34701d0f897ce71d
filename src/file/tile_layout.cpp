#include "tile_layout.hpp"

#include "layout.hpp"
#include "netcdf.hpp"
#include "own_dataset.hpp"
#include "working_file.hpp"

#include "overturn/text/mapped.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>

namespace overturn {

using hdf5::Handle;
using hdf5::write_attribute;
using layout::in_run_group;
using namespace netcdf;

namespace {

void add_checksums(hid_t file, const TileLayout& tiles)
{
    const StoredDimension along{in_run_group("tile"), tiles.tiling.size()};
    add_bare_dimension(file, along);
    const Handle dataset =
        add_numbers(file, layout::checksum, {along}, "checksum of the tile, 0 if not computed");
    write_attribute(dataset, "algorithm",
                    fmt::format("xxHash64 over the stored values of the tile, field by field in "
                                "the order of the variables{}; its seed is the xxHash64, seed 0, "
                                "of job_resolved, plus the number of the tile; a hash of 0 is "
                                "stored as 1",
                                tiles.is_filled ? ", audit_checked and audit_wrong" : ""));
    write_attribute(dataset, "numbering",
                    "tiles are boxes of tile_shape, smaller at the far edges, in the order of "
                    "`dimensions`; the last varies fastest");
    if (!tiles.dimensions.empty()) {
        write_attribute(dataset, layout::dimensions,
                        fmt::format("{}", fmt::join(tiles.dimensions, " ")));
        write_attribute(dataset, layout::tile_shape, tiles.tiling.tile_shape());
    }
    if (tiles.is_filled) {
        add_numbers(file, layout::audit_checked, {along},
                    "number of filled points of the tile that were integrated as well");
        add_numbers(file, layout::audit_wrong, {along},
                    "number of checked points whose integrated value differs from the filled one; "
                    "if there is one, all points of the tile were integrated");
    }
}

/// Writes a chunk for each tile of the part.
void write_chunks(const StoredField& stored, const std::string& path, const TileLayout& tiles,
                  const TilesOfPart& own, const ChunkOfTile& chunk_of)
{
    // Syncing regularly keeps the amount of unsynced data, and thus each wait for the disk, small.
    const std::int64_t bytes =
        tiles.points_of_chunk(stored.field) * std::int64_t(bytes_per_point(stored.field));
    const std::int64_t tiles_between_syncs = std::max<std::int64_t>(1, most_unsynced_bytes / bytes);
    std::int64_t written = 0;
    for (std::int64_t number = 0; number < tiles.tiling.size(); ++number) {
        if (!own.contains(number)) {
            continue;
        }
        const Tile tile = tiles.tiling[number];
        write_chunk(stored, tile, chunk_of(tile));
        if (++written % tiles_between_syncs == 0 && !sync(path)) {
            throw hdf5::Hdf5Error(system_reason(errno));
        }
    }
}

} // namespace

std::int64_t TileLayout::points_of_chunk(Field field) const
{
    return count_points(stored_dimensions_of(field, tiling.tile_shape(), crossing));
}

TileLayout tile_layout_of(const Problem& problem)
{
    return {problem.fields, mapped(stored_dimensions(problem), &StoredDimension::name),
            place_of_crossing(problem), tiling_of(problem), problem.product.audit().has_value()};
}

TileLayout tile_layout_of(const TilesSummary& tiles)
{
    return {tiles.fields, mapped(tiles.axes, &AxisSummary::name), place_of_crossing(tiles.axes),
            Tiling(mapped(tiles.axes, &AxisSummary::size), tiles.tile_shape),
            tiles.audit.has_value()};
}

void add_tiles(const std::string& path, const TileLayout& tiles, const std::optional<JobPart>& part,
               const ChunksOfField& chunks_of)
{
    Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, hdf5::file_access()), H5Fclose);
    open_own_dataset(file, in_run_group(layout::run_token)); // throws if it or the group is a link
    add_checksums(file, tiles);
    const TilesOfPart own(tiles.tiling.size(), part);
    for (const Field field : tiles.fields) {
        const StoredField stored{field, open_own_dataset(file, std::string(name_of(field))),
                                 tiles.crossing};
        write_chunks(stored, path, tiles, own, chunks_of(stored));
    }
    file.close();
}

// The chunk index of a field has one node per 56 tiles (rounded up here), measured on files of 1 to
// 390625 tiles. A node is a B-tree of 64 children: a header of 24 bytes, 64 addresses, and 65 keys
// with a size, a mask and a number per dimension and one more, which are 3656 bytes for four
// dimensions.
long double bytes_of_tiles(const TileLayout& tiles, const std::optional<JobPart>& part)
{
    using Count = long double;
    const auto all = Count(tiles.tiling.size());
    Count bytes = (tiles.is_filled ? 3 * all : all) * sizeof(double);
    if (tiles.is_filled) {
        bytes += 1200;
    }
    const std::int64_t own = TilesOfPart(tiles.tiling.size(), part).size();
    const auto nodes = own / 55 + 2;
    const auto rank = Count(tiles.dimensions.size());
    const Count node = 24 + 64 * 8 + 65 * (8 + 8 * (rank + 1));
    // Tiles at the far edges occupy whole chunks.
    const Count points = Count(own) * Count(tiles.tiling.points_of_tile());
    for (const Field field : tiles.fields) {
        bytes += node * Count(nodes) + points * Count(bytes_per_point(field));
    }
    return bytes;
}

} // namespace overturn
