// The checksum that marks a tile as done.
#pragma once

#include "overturn/sweep/fields.hpp"

#include <cstdint>
#include <vector>

namespace overturn {

inline constexpr std::uint64_t not_computed_checksum = 0;

/// xxHash64, seed 0, over the values of the tile as stored (little endian), field by field in the
/// given order. A hash of 0 becomes 1, since 0 means "not computed".
std::uint64_t tile_checksum(const std::vector<FieldValues>& fields);

} // namespace overturn
