#include "tile_access.hpp"

#include <gtest/gtest.h>

#include <xxhash.h>

namespace overturn {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Shorts = std::vector<std::uint16_t>;

const TileChecksums checksums("r = 1");

// The published xxHash64 of the empty string and of "abc", seed 0.
TEST(TileChecksum, IsXxHash64InFilesOfTheFormerFormat)
{
    const TileChecksums former = TileChecksums::of_former_format();
    EXPECT_EQ(former.of(0, {}), 0xef46db3751d8e999u);
    EXPECT_EQ(former.of(7, {Bytes{'a', 'b', 'c'}}), 0x44bc2cf5ad770999u);
}

TEST(TileChecksum, HasTheSeedOfItsJobAndItsTile)
{
    const std::uint64_t seed = 0x44bc2cf5ad770999u; // the xxHash64 of "abc"
    EXPECT_EQ(TileChecksums("abc").of(7, {Bytes{1, 2}}), XXH64("\x01\x02", 2, seed + 7));
}

TEST(TileChecksum, IsThatOfOneTileOfOneJob)
{
    EXPECT_NE(checksums.of(0, {Bytes{1}}), checksums.of(1, {Bytes{1}}));
    EXPECT_NE(checksums.of(0, {Bytes{1}}), TileChecksums("r = 0.9").of(0, {Bytes{1}}));
}

TEST(TileChecksum, ContinuesFromFieldToField)
{
    EXPECT_EQ(checksums.of(7, {Bytes{'a'}, Shorts{'b' + 256 * 'c'}}),
              checksums.of(7, {Bytes{'a', 'b', 'c'}}));
}

TEST(TileChecksum, DependsOnTheOrderOfTheFields)
{
    EXPECT_NE(checksums.of(0, {Bytes{1}, Bytes{2}}), checksums.of(0, {Bytes{2}, Bytes{1}}));
}

} // namespace
} // namespace overturn
