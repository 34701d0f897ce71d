// Access to the values of one tile in a dataset, and to the numbers of all tiles: checksums, which
// mark tiles as done, and counts of the audit of filled tiles.
#pragma once

#include "hdf5_handles.hpp"

#include "overturn/file/stored_result.hpp"
#include "overturn/problem/fields.hpp"
#include "overturn/problem/problem.hpp"
#include "overturn/sweep/compute_tile.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace overturn {

/// The place of the dimension `crossing` of a boundary; any place otherwise.
inline std::size_t place_of_crossing(const Problem& problem)
{
    const Boundaries* boundaries = problem.product.boundaries();
    return boundaries != nullptr ? boundaries->dimension(problem.grid) : 0;
}

/// The same of a file; any place beyond the axes if there is none.
inline std::size_t place_of_crossing(const std::vector<AxisSummary>& axes)
{
    return std::size_t(std::ranges::find(axes, flip_dimension, &AxisSummary::name) - axes.begin());
}

/// The entries of a list, one per dimension of the points, for the dimensions of a field: a field
/// of a line lacks `crossing`, whose place is given.
template <class List>
List stored_dimensions_of(Field field, List of_points, std::size_t crossing)
{
    if (traits_of(field).of == FieldOf::line) {
        of_points.erase(of_points.begin() + std::ptrdiff_t(crossing));
    }
    return of_points;
}

struct StoredField {
    Field field;
    hdf5::Handle dataset;
    std::size_t crossing; ///< of a boundary: the place of this dimension

    /// The part of the field that belongs to a tile of the points.
    Tile part_of(const Tile& tile) const
    {
        return {tile.number, stored_dimensions_of(field, tile.begin, crossing),
                stored_dimensions_of(field, tile.count, crossing)};
    }
};

/// Writes the whole chunk of a tile for the first time. Not available with MPI-IO.
void write_chunk(const StoredField& stored, const Tile& tile, const FieldValues& values);

void write_tile(const StoredField& stored, const Tile& tile, const FieldValues& values);
FieldValues read_tile(const StoredField& stored, const Tile& tile);

/// The values of the whole chunk of a tile: beyond the far edges, those that are not computed.
FieldValues read_chunk(const StoredField& stored, const Tile& tile, const Shape& tile_shape);

inline constexpr std::uint64_t not_computed_checksum = 0;

/// The checksums of the tiles of one job: tiles of another job, or in another place, do not fit.
class TileChecksums {
public:
    /// resolved_job: its text with all defaults.
    explicit TileChecksums(std::string_view resolved_job);

    /// Those of files of the former format, with the same seed for every tile of every job.
    static TileChecksums of_former_format() { return TileChecksums(); }

    /// xxHash64 over the values as stored (little endian), field by field in the given order, and
    /// over the counts of the audit if the tile is filled. The seed is the xxHash64 of the job plus
    /// the number of the tile. A hash of 0 becomes 1, since 0 means "not computed".
    std::uint64_t of(std::int64_t tile, const std::vector<FieldValues>& fields,
                     const std::optional<AuditCount>& audit = std::nullopt) const;

private:
    TileChecksums() = default;

    std::optional<std::uint64_t> seed_of_first_;
};

/// Writes into a dataset of one number per tile, such as the checksums.
void write_number(hid_t dataset, std::int64_t tile, std::uint64_t number);

} // namespace overturn
