#include "support/scratch_folder.hpp"

#include "overturn/file/disk_space.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

namespace overturn {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

TEST(DiskSpace, IsThatOfTheQuotaThatLeavesLess)
{
    DiskSpace space{.free = 1000, .of_user = Quota{600, 100}, .of_group = Quota{900, 700}};
    EXPECT_EQ(space.quota()->limit, 900);
    EXPECT_EQ(space.available(), 200);
    space.of_group = Quota{5000, 0};
    EXPECT_EQ(space.quota()->limit, 600);
    EXPECT_EQ(space.available(), 500);
    space.free = 30;
    EXPECT_EQ(space.available(), 30);
}

TEST(DiskSpace, IsNoneBeyondAQuota)
{
    EXPECT_EQ((DiskSpace{.free = 1000, .of_user = Quota{600, 601}, .of_group = {}}).available(), 0);
}

TEST(DiskSpace, IsUnknownOnlyIfNeitherIsKnown)
{
    EXPECT_EQ((DiskSpace{}).available(), std::nullopt);
    EXPECT_EQ((DiskSpace{.free = {}, .of_user = Quota{600, 100}, .of_group = {}}).available(), 500);
    EXPECT_EQ((DiskSpace{.free = {}, .of_user = Quota{no_limit, 100}, .of_group = {}}).available(),
              std::nullopt);
    EXPECT_EQ((DiskSpace{.free = 7, .of_user = Quota{no_limit, 100}, .of_group = {}}).available(),
              7);
}

TEST(DiskSpace, IsUnknownInAMissingFolder)
{
    const ScratchFolder folder;
    EXPECT_EQ(space_in(folder / "missing").free, std::nullopt);
    EXPECT_EQ(speed_of_creation_in(folder / "missing", 1000), std::nullopt);
}

TEST(SpeedOfCreation, LeavesNothing)
{
    const ScratchFolder folder;
    const auto speed = speed_of_creation_in(folder / "", 1000);
    EXPECT_TRUE(!speed || *speed > 0); // not every file system has files without a name
    EXPECT_TRUE(std::filesystem::is_empty(std::filesystem::path(folder / "")));
}

} // namespace
} // namespace overturn
