#include "overturn/mechanics/block.hpp"
#include "overturn/sweep/boundary.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace overturn {
namespace {

const double paper_alpha = std::atan(1 / 5.67);
const double paper_r_max = largest_restitution(paper_alpha);
const std::vector<double> scan = Axis(AxisRange{0.5, 16, 156}).values();

TEST(BoundaryTile, HasALineInEachColumn)
{
    Plane plane;
    plane.slenderness = Axis(AxisList{0.2, paper_alpha});
    plane.restitution = Axis(AxisList{0.7, 1});
    plane.restitution_of = RestitutionOf::maximum;
    plane.frequency = Axis(AxisList{1, 2, 3, 20});
    plane.amplitude = Axis(AxisRange{0, 7, 8});
    const Tile tile{.begin = {1, 1, 0, 2}, .count = {1, 1, 8, 2}};
    const TileFields fields = boundary_tile({}, plane, scan, tile, widest_kernel());
    const auto& amplitude = std::get<std::vector<double>>(fields.values[0]);
    const auto& below = std::get<std::vector<std::uint8_t>>(fields.values[1]);
    const auto& above = std::get<std::vector<std::uint8_t>>(fields.values[2]);
    const Boundary boundary = boundary_on({}, {paper_alpha, paper_r_max, 3}, scan, widest_kernel());
    ASSERT_EQ(boundary.flips.size(), 3u);
    for (std::size_t row = 0; row < 8; ++row) {
        const std::size_t point = 2 * row; // of the first column; the second has no flip
        EXPECT_TRUE(std::isnan(amplitude[point + 1]));
        // For a line without a flip, the first row contains the region.
        EXPECT_EQ(below[point + 1], row == 0 ? std::uint8_t(Region::S) : no_flip);
        EXPECT_EQ(above[point + 1], no_flip);
        if (row < 3) {
            EXPECT_EQ(amplitude[point], boundary.flips[row].amplitude());
            EXPECT_EQ(Region(below[point]), boundary.flips[row].region_below);
            EXPECT_EQ(Region(above[point]), boundary.flips[row].region_above);
        } else {
            EXPECT_TRUE(std::isnan(amplitude[point]));
            EXPECT_EQ(below[point], no_flip);
            EXPECT_EQ(above[point], no_flip);
        }
    }
}

TEST(BoundaryTile, ReportsWhereThereAreMoreFlipsThanRows)
{
    Plane plane;
    plane.slenderness = Axis(AxisList{paper_alpha});
    plane.restitution = Axis(AxisList{paper_r_max});
    plane.frequency = Axis(AxisList{3});
    plane.amplitude = Axis(AxisRange{0, 1, 2});
    const Tile tile{.begin = {0, 0, 0, 0}, .count = {1, 1, 2, 1}};
    const TileFields fields = boundary_tile({}, plane, scan, tile, widest_kernel());
    EXPECT_NEAR(std::get<std::vector<double>>(fields.values[0])[1], 3.590936, 6e-7);
    EXPECT_EQ(std::get<std::vector<std::uint8_t>>(fields.values[2])[0],
              std::uint8_t(Region::U0_plus));
    EXPECT_EQ(std::get<std::vector<std::uint8_t>>(fields.values[2])[1],
              std::uint8_t(Region::undecided));
}

} // namespace
} // namespace overturn
