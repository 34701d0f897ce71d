#include "tile_access.hpp"

#include <gtest/gtest.h>

namespace overturn {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Shorts = std::vector<std::uint16_t>;

// The published xxHash64 of the empty string and of "abc", seed 0.
TEST(TileChecksum, IsXxHash64)
{
    EXPECT_EQ(tile_checksum({}, 0), 0xef46db3751d8e999u);
    EXPECT_EQ(tile_checksum({Bytes{'a', 'b', 'c'}}, 0), 0x44bc2cf5ad770999u);
    EXPECT_EQ(seed_of_checksums("abc"), 0x44bc2cf5ad770999u);
}

TEST(TileChecksum, IsThatOfOneTileOfOneJob)
{
    const std::uint64_t seed = seed_of_checksums("r = 1"), other = seed_of_checksums("r = 0.9");
    EXPECT_NE(tile_checksum({Bytes{1}}, seed), tile_checksum({Bytes{1}}, seed + 1));
    EXPECT_NE(tile_checksum({Bytes{1}}, seed), tile_checksum({Bytes{1}}, other));
}

TEST(TileChecksum, ContinuesFromFieldToField)
{
    EXPECT_EQ(tile_checksum({Bytes{'a'}, Shorts{'b' + 256 * 'c'}}, 7),
              tile_checksum({Bytes{'a', 'b', 'c'}}, 7));
}

TEST(TileChecksum, DependsOnTheOrderOfTheFields)
{
    EXPECT_NE(tile_checksum({Bytes{1}, Bytes{2}}, 0), tile_checksum({Bytes{2}, Bytes{1}}, 0));
}

} // namespace
} // namespace overturn
