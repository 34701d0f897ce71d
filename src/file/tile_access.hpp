// The values of one tile in a dataset of the result file, and the checksums of all.
#pragma once

#include "hdf5_handles.hpp"

#include "overturn/sweep/fields.hpp"
#include "overturn/sweep/tile.hpp"

#include <cstdint>
#include <vector>

namespace overturn {

/// What stands where nothing is computed yet.
FieldValues not_computed(Field field, std::int64_t points);

/// Writes all of a tile's chunk, for the first time. Not through MPI-IO.
void write_chunk(hid_t dataset, const Tile& tile, const FieldValues& values);

void write_tile(hid_t dataset, const Tile& tile, Field field, const FieldValues& values);
FieldValues read_tile(hid_t dataset, const Tile& tile, Field field);

void write_checksum(hid_t dataset, std::int64_t tile, std::uint64_t checksum);
std::vector<std::uint64_t> read_checksums(hid_t dataset);

} // namespace overturn
