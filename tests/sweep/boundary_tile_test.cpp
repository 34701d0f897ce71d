#include "overturn/mechanics/block.hpp"
#include "overturn/sweep/boundary.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "support/given_values.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace overturn {
namespace {

const double paper_alpha = std::atan(1 / 5.67);
const double paper_r_max = largest_restitution(paper_alpha);
const AxisRange scan{0.5, 16, 156};

Problem boundary_of_blocks(std::vector<Given> blocks_and_frequencies)
{
    blocks_and_frequencies.push_back(axis("amplitude", scan));
    return {.grid = grid_of({}, std::move(blocks_and_frequencies)),
            .product = Product::boundary,
            .fields = {Field::flip_amplitude, Field::region_below, Field::region_above}};
}

TEST(BoundaryTile, HasALineInEachColumn)
{
    const Problem problem = boundary_of_blocks({axis("slenderness", {paper_alpha, 0.2}),
                                                axis("restitution_of_maximum", {0.7, 1}),
                                                axis("frequency", {1, 2, 3, 20})});
    const Tile tile{.begin = {0, 1, 0, 2}, .count = {1, 1, 8, 2}};
    const TileFields fields = compute_tile(problem, tile, widest_kernel());
    const auto& amplitude = std::get<std::vector<double>>(fields.values[0]);
    const auto& below = std::get<std::vector<std::uint8_t>>(fields.values[1]);
    const auto& above = std::get<std::vector<std::uint8_t>>(fields.values[2]);
    const Boundary boundary =
        boundary_on({}, {paper_alpha, paper_r_max, 3}, Axis(scan).values(), widest_kernel());
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
    const Problem problem =
        boundary_of_blocks({number("slenderness", paper_alpha), number("restitution", paper_r_max),
                            number("frequency", 3)});
    const Tile tile{.begin = {0}, .count = {2}};
    const TileFields fields = compute_tile(problem, tile, widest_kernel());
    EXPECT_NEAR(std::get<std::vector<double>>(fields.values[0])[1], 3.590936, 6e-7);
    EXPECT_EQ(std::get<std::vector<std::uint8_t>>(fields.values[2])[0],
              std::uint8_t(Region::U0_plus));
    EXPECT_EQ(std::get<std::vector<std::uint8_t>>(fields.values[2])[1],
              std::uint8_t(Region::undecided));
}

} // namespace
} // namespace overturn
