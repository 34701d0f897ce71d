// How the tiles of a result are stored, and how they are added to a file that has none.
#pragma once

#include "tile_access.hpp"

#include "overturn/file/stored_result.hpp"
#include "overturn/problem/job_part.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace overturn {

struct TileLayout {
    std::vector<Field> fields;           ///< in the order of the file
    std::vector<std::string> dimensions; ///< of the points, slowest first
    std::size_t crossing;                ///< of a boundary: the place of this dimension
    Tiling tiling;
    bool is_filled; ///< tiles have counts of an audit

    /// The number of values of a field that belong to a tile; those at the far edges have fewer,
    /// but occupy whole chunks.
    std::int64_t points_of_chunk(Field field) const;
};

TileLayout tile_layout_of(const Problem& problem);
TileLayout tile_layout_of(const TilesSummary& tiles);

/// Upper bound of what the tiles of a part, or all, add to the size of a file [byte].
long double bytes_of_tiles(const TileLayout& tiles, const std::optional<JobPart>& part = {});

/// The values of the chunk of a tile; they are used before the next call.
using ChunkOfTile = std::function<const FieldValues&(const Tile&)>;
using ChunksOfField = std::function<ChunkOfTile(const StoredField&)>;

/// Adds the checksums, which are 0, and the chunks of the tiles of a part, or of all, in the order
/// of fields and tiles. Throws Hdf5Error.
void add_tiles(const std::string& path, const TileLayout& tiles, const std::optional<JobPart>& part,
               const ChunksOfField& chunks_of);

} // namespace overturn
