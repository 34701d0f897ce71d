// Grids with a table of blocks, compared with a grid for each block, by numbers and axes.
#include "overturn/sweep/compute_tile.hpp"
#include "support/given_values.hpp"
#include "support/random_record.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace overturn {
namespace {

const std::vector<Field> some_fields{Field::region,  Field::angle,  Field::margin,
                                     Field::impacts, Field::status, Field::peak};

/// Sizes of blocks that differ in slenderness and size [m], and their shares of r_max.
const std::vector<double> widths{0.4, 0.6, 1.0};
const std::vector<double> heights{2.0, 1.8, 5.0};
const std::vector<double> shares{0.8, 0.9, 1.0};

const Quantities table_of_blocks{column("width", widths), column("height", heights),
                                 column("restitution_of_maximum", shares)};

/// One block of the table, in the same quantities.
Quantities block_of_row(std::size_t row)
{
    return {number("width", widths[row]), number("height", heights[row]),
            number("restitution_of_maximum", shares[row])};
}

Problem problem_of_points(const Scene& scene, const Quantities& given)
{
    return {.scene = scene, .grid = grid_of(scene, given), .fields = some_fields};
}

Shape shape_of(const Scene& scene, const Quantities& given)
{
    return grid_of(scene, given).shape();
}

/// The values of a field at all points, in order, computed in tiles of one point.
std::vector<double> computed(const Scene& scene, const Quantities& given, std::size_t field)
{
    const Problem problem = problem_of_points(scene, given);
    const Shape shape = problem.grid.shape();
    const Tiling tiling(shape, Shape(shape.size(), 1));
    std::vector<double> all;
    for (std::int64_t i = 0; i < tiling.size(); ++i) {
        const TileFields fields = compute_tile(problem, tiling[i], widest_kernel());
        std::visit([&](const auto& values) { all.push_back(double(values[0])); },
                   fields.values[field]);
    }
    return all;
}

/// Expects equal bits; NaN equals NaN.
void expect_same(const std::vector<double>& one, const std::vector<double>& other)
{
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_TRUE(one[i] == other[i] || (std::isnan(one[i]) && std::isnan(other[i])))
            << i << ": " << one[i] << " and " << other[i];
    }
}

TEST(Table, HasTheValuesOfAGridPerBlock)
{
    const Scene scene;
    const Quantities axes{axis("pga", AxisRange{0.2, 2.0, 7}),
                          axis("pulse_period", AxisRange{0.2, 1.5, 5})};
    EXPECT_EQ(shape_of(scene, table_of_blocks + axes), (Shape{3, 7, 5}));
    for (std::size_t f = 0; f < some_fields.size(); ++f) {
        std::vector<double> expected;
        for (std::size_t row = 0; row < 3; ++row) {
            const std::vector<double> part = computed(scene, block_of_row(row) + axes, f);
            expected.insert(expected.end(), part.begin(), part.end());
        }
        expect_same(computed(scene, table_of_blocks + axes, f), expected);
    }
}

Scene scene_of_two_records()
{
    std::mt19937_64 generator(7);
    Suite suite;
    for (int i = 0; i < 2; ++i) {
        std::vector<double> samples = random_samples(generator, 400);
        for (double& sample : samples) {
            sample *= 2;
        }
        suite.records.push_back(
            std::make_shared<Accelerogram>(samples, std::vector<double>(), i == 0 ? 0.01 : 0.02));
    }
    return {.motion = suite};
}

TEST(Table, HasTheValuesOfAGridPerBlockUnderEveryRecord)
{
    const Scene scene = scene_of_two_records();
    const Quantities axes{axis("motion", {1, 2}), axis("scale", AxisRange{0.2, 2.0, 7})};
    EXPECT_EQ(shape_of(scene, table_of_blocks + axes), (Shape{2, 3, 7}));
    for (std::size_t f = 0; f < some_fields.size(); ++f) {
        std::vector<std::vector<double>> of_block;
        for (std::size_t row = 0; row < 3; ++row) {
            of_block.push_back(computed(scene, block_of_row(row) + axes, f));
        }
        std::vector<double> expected;
        for (std::size_t motion = 0; motion < 2; ++motion) {
            for (std::size_t block = 0; block < 3; ++block) {
                const auto begin = of_block[block].begin() + std::ptrdiff_t(7 * motion);
                expected.insert(expected.end(), begin, begin + 7);
            }
        }
        expect_same(computed(scene, table_of_blocks + axes, f), expected);
    }
}

TEST(Table, WithMotionsOfItsOwnHasOnePointPerBlock)
{
    const std::vector<double> pga{0.9, 0.5, 0.4};
    const std::vector<double> period{0.5, 0.8, 1.1};
    const Scene scene;
    const Quantities table =
        table_of_blocks + Quantities{column("pga", pga), column("pulse_period", period)};
    EXPECT_EQ(shape_of(scene, table), (Shape{3}));
    for (std::size_t f = 0; f < some_fields.size(); ++f) {
        std::vector<double> expected;
        for (std::size_t row = 0; row < 3; ++row) {
            const Quantities pulse{number("pga", pga[row]), number("pulse_period", period[row])};
            expected.push_back(computed(scene, block_of_row(row) + pulse, f)[0]);
        }
        expect_same(computed(scene, table, f), expected);
    }
}

TEST(Table, OfSomeQuantitiesIsCompletedByNumbersAndAxes)
{
    const std::vector<double> pga{0.9, 0.5, 0.4};
    const Scene scene;
    const Quantities table{column("pga", pga), column("width", widths)};
    const Quantities others{number("height", 2), number("restitution_of_maximum", 0.9)};
    const std::vector<double> periods{0.5, 0.8};
    const Quantities all = table + others + Quantities{axis("pulse_period", periods)};
    EXPECT_EQ(shape_of(scene, all), (Shape{3, 2}));
    for (std::size_t f = 0; f < some_fields.size(); ++f) {
        std::vector<double> expected;
        for (std::size_t row = 0; row < 3; ++row) {
            for (const double period : periods) {
                const Quantities point{number("pga", pga[row]), number("width", widths[row]),
                                       number("pulse_period", period)};
                expected.push_back(computed(scene, others + point, f)[0]);
            }
        }
        expect_same(computed(scene, all, f), expected);
    }
}

TEST(Table, WithRecordsOfItsOwnHasTheSameValuesInAnyTile)
{
    const Scene scene = scene_of_two_records();
    const std::vector<double> scale{0.8, 1.2, 1.7};
    const std::vector<double> motion{2, 1, 2};
    const Quantities table =
        table_of_blocks + Quantities{column("scale", scale), column("motion", motion)};
    EXPECT_EQ(shape_of(scene, table), (Shape{3}));
    const Problem problem = problem_of_points(scene, table);
    const TileFields whole = compute_tile(problem, tiling_of(problem)[0], widest_kernel());
    for (std::size_t f = 0; f < some_fields.size(); ++f) {
        std::vector<double> expected;
        for (std::size_t row = 0; row < 3; ++row) {
            const Quantities record{number("scale", scale[row]), number("motion", motion[row])};
            expected.push_back(computed(scene, block_of_row(row) + record, f)[0]);
        }
        expect_same(computed(scene, table, f), expected);
        const auto in_doubles = [](const auto& values) {
            return std::vector<double>(values.begin(), values.end());
        };
        expect_same(std::visit(in_doubles, whole.values[f]), expected);
    }
}

} // namespace
} // namespace overturn
