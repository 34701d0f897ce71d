#include "overturn/mechanics/region.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "overturn/sweep/fill.hpp"
#include "support/every_kernel.hpp"
#include "support/every_scene.hpp"
#include "support/given_values.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace overturn {
namespace {

Grid grid_of_block(double slenderness, double share_of_maximum, const AxisRange& amplitude,
                   const AxisRange& frequency)
{
    return grid_of({}, {number("slenderness", slenderness),
                        number("restitution_of_maximum", share_of_maximum),
                        axis("amplitude", amplitude), axis("frequency", frequency)});
}

Grid some_grid(std::int64_t rows, std::int64_t columns)
{
    return grid_of_block(0.2, 0.9, {.first = 0.9, .last = 12, .count = rows},
                         {.first = 0.3, .last = 9, .count = columns});
}

/// A leaning box, whose sides are different.
Grid leaning_grid(double direction)
{
    return grid_of({}, {number("width", 0.5), number("height", 2), number("incline", 0.07),
                        number("restitution_of_maximum", 0.95), number("direction", direction),
                        axis("pga", AxisRange{0.1, 2, 128}),
                        axis("pulse_period", AxisRange{0.2, 1.5, 128})});
}

const std::vector<Field> region_alone{Field::region, Field::evaluated};
const std::vector<Field> region_and_impacts{Field::region, Field::impacts, Field::evaluated};

/// A filled spectrum, of one tile, without an audit.
Problem filled_problem(const Scene& scene, const Numerics& numerics, const Grid& grid,
                       std::vector<Field> fields = region_alone, double audit = 0)
{
    return {.scene = scene,
            .grid = grid,
            .numerics = numerics,
            .product = FilledSpectrum{{}, audit},
            .fields = std::move(fields)};
}

FilledTile filled(const Problem& problem, const FillRule& rule = {},
                  Kernel kernel = widest_kernel())
{
    EXPECT_EQ(tiling_of(problem).size(), 1);
    return fill_tile(problem, tiling_of(problem)[0], kernel, nullptr, rule);
}

/// The region and the impacts of every point.
TileFields integrated(Problem problem)
{
    const Tile tile = tiling_of(problem)[0];
    problem.product = Spectrum();
    problem.fields = {Field::region, Field::impacts};
    return compute_tile(problem, tile, widest_kernel());
}

const auto& regions_of(const TileFields& fields)
{
    return std::get<std::vector<std::uint8_t>>(fields.values[0]);
}

std::int64_t count(const std::vector<std::uint8_t>& values, std::uint8_t value)
{
    return std::count(values.begin(), values.end(), value);
}

TEST(Fill, EveryPointHasTheRegionOfADirectSpectrum)
{
    const Grid grid = some_grid(128, 128);
    for (const Scene& scene : every_scene()) {
        for (const Numerics& numerics : {Numerics(), Numerics{.method = Method::taylor},
                                         Numerics{.tolerance = 1e-4, .resolve = true}}) {
            const Problem problem = filled_problem(scene, numerics, grid);
            const FilledTile tile = filled(problem);
            EXPECT_EQ(tile.region, regions_of(integrated(problem)))
                << name_of(scene.pulse()->kind) << ", " << name_of(scene.theory) << ", "
                << name_of(numerics.method);
            // If nothing were filled, this test would compare nothing.
            EXPECT_GT(count(tile.evaluated, point_origin::filled), 128 * 128 / 3)
                << name_of(scene.pulse()->kind);
        }
    }
}

TEST(Fill, EveryPointHasTheRegionOfADirectSpectrumIfTheSidesOfTheBlockDiffer)
{
    std::int64_t after_two = 0;
    for (const Scene& scene : every_scene()) {
        for (const double direction : {0.0, 180.0}) {
            for (const auto& fields : {region_alone, region_and_impacts}) {
                const Problem problem = filled_problem(scene, {}, leaning_grid(direction), fields);
                const FilledTile tile = filled(problem);
                const TileFields direct = integrated(problem);
                EXPECT_EQ(tile.region, regions_of(direct)) << name_of(scene.pulse()->kind);
                if (fields == region_and_impacts) {
                    EXPECT_EQ(tile.impacts, std::get<std::vector<std::uint16_t>>(direct.values[1]));
                }
                EXPECT_GT(count(tile.evaluated, point_origin::filled), 128 * 128 / 5)
                    << name_of(scene.pulse()->kind);
                after_two += count(tile.region, std::uint8_t(Region::U2_plus));
            }
        }
    }
    EXPECT_GT(after_two, 128 * 128 / 10);
}

TEST(Fill, EveryPointHasTheImpactsOfADirectSpectrum)
{
    const Grid grid = some_grid(128, 128);
    for (const Scene& scene : every_scene()) {
        const Problem problem = filled_problem(scene, {}, grid, region_and_impacts);
        const FilledTile tile = filled(problem);
        const TileFields direct = integrated(problem);
        EXPECT_EQ(tile.region, regions_of(direct)) << name_of(scene.pulse()->kind);
        EXPECT_EQ(tile.impacts, std::get<std::vector<std::uint16_t>>(direct.values[1]))
            << name_of(scene.pulse()->kind);
        EXPECT_GT(count(tile.evaluated, point_origin::filled), 128 * 128 / 5)
            << name_of(scene.pulse()->kind);
    }
}

TEST(Fill, EveryKernelFillsTheSamePoints)
{
    const Grid grid = some_grid(120, 100);
    for (const Kernel kernel : every_kernel()) {
        for (const Scene& scene : every_scene()) {
            const Problem problem = filled_problem(scene, {}, grid, region_and_impacts, 0.01);
            const FilledTile one = filled(problem, {}, kernel);
            const FilledTile other = filled(problem);
            EXPECT_EQ(one.region, other.region) << name_of(kernel);
            EXPECT_EQ(one.impacts, other.impacts) << name_of(kernel);
            EXPECT_EQ(one.evaluated, other.evaluated) << name_of(kernel);
            EXPECT_EQ(one.audit.checked, other.audit.checked) << name_of(kernel);
        }
    }
}

TEST(Fill, WorksOnTilesOfAnyShape)
{
    for (const auto& [rows, columns] : {std::pair{1, 1}, {1, 100}, {100, 1}, {2, 3}, {37, 5}}) {
        const Problem problem = filled_problem({}, {}, some_grid(rows, columns));
        EXPECT_EQ(filled(problem).region, regions_of(integrated(problem)))
            << rows << " x " << columns;
    }
}

TEST(Fill, EverySpectrumOfAGridIsFilledByItself)
{
    const std::vector<Given> plane{axis("amplitude", AxisRange{0.9, 12, 100}),
                                   axis("frequency", AxisRange{0.3, 9, 60})};
    const auto filled_regions = [&](const Given& slenderness, std::int64_t tile) {
        std::vector<Given> given = plane;
        given.push_back(slenderness);
        given.push_back(number("restitution", 0.8));
        const Problem problem = filled_problem({}, {}, grid_of({}, given));
        return fill_tile(problem, tiling_of(problem)[tile], widest_kernel()).region;
    };
    EXPECT_EQ(filled_regions(axis("slenderness", {0.1, 0.3}), 0),
              filled_regions(number("slenderness", 0.1), 0));
    EXPECT_EQ(filled_regions(axis("slenderness", {0.1, 0.3}), 1),
              filled_regions(number("slenderness", 0.3), 0));
}

/// Many low bounces precede a large motion: a strip of one row passes between nodes that agree.
Problem hard_problem()
{
    return filled_problem({.motion = Pulse{PulseKind::cosine, {.cycles = 2}}},
                          {.method = Method::taylor},
                          grid_of_block(0.1, 1, {.first = 1.01, .last = 1.50306, .count = 128},
                                        {.first = 1.053725, .last = 2, .count = 128}));
}

constexpr FillRule nodes_alone{.kappa = 0, .grazes = false};

TEST(Fill, NodesThatAgreeAreNotEnough)
{
    const Problem problem = hard_problem();
    const auto expected = regions_of(integrated(problem));
    EXPECT_EQ(filled(problem).region, expected);
    EXPECT_NE(filled(problem, nodes_alone).region, expected);
}

TEST(Fill, AuditOfAShareChecksThatShare)
{
    const Grid grid = grid_of_block(0.2, 0.9, {.first = 0.1, .last = 0.9, .count = 128},
                                    {.first = 8, .last = 9, .count = 128}); // S everywhere
    const FilledTile unchecked = filled(filled_problem({}, {}, grid));
    for (const double share : {1e-3, 0.01, 0.3, 1.0}) {
        const FilledTile tile = filled(filled_problem({}, {}, grid, region_alone, share));
        const double expected = share * double(count(unchecked.evaluated, point_origin::filled));
        // At most one point in a block is chosen: the variance is at most the Poisson one. A wrong
        // share would be off by a factor of two.
        EXPECT_NEAR(double(tile.audit.checked), expected, 5 * std::sqrt(expected)) << share;
        EXPECT_EQ(tile.audit.wrong, 0);
        EXPECT_EQ(count(tile.evaluated, point_origin::integrated),
                  count(unchecked.evaluated, point_origin::integrated) + tile.audit.checked);
    }
    EXPECT_EQ(unchecked.audit.checked, 0);
}

TEST(Fill, EveryPointIsIntegratedIfTheAuditFindsAWrongOne)
{
    Problem problem = hard_problem();
    problem.product = FilledSpectrum{{}, 1};
    const FilledTile tile = filled(problem, nodes_alone);
    EXPECT_GT(tile.audit.wrong, 0);
    EXPECT_EQ(tile.region, regions_of(integrated(problem)));
    EXPECT_EQ(count(tile.evaluated, point_origin::filled), 0);
}

TEST(Fill, TilesStoreWhichPointsWereIntegrated)
{
    const Problem problem = filled_problem({}, {}, some_grid(128, 128),
                                           {Field::impacts, Field::region, Field::evaluated}, 1e-3);
    const TileFields fields = compute_tile(problem, tiling_of(problem)[0], widest_kernel());
    const FilledTile tile = filled(problem);
    EXPECT_EQ(std::get<std::vector<std::uint16_t>>(fields.values[0]), tile.impacts);
    EXPECT_EQ(std::get<std::vector<std::uint8_t>>(fields.values[1]), tile.region);
    EXPECT_EQ(std::get<std::vector<std::uint8_t>>(fields.values[2]), tile.evaluated);
    EXPECT_EQ(fields.audit.checked, tile.audit.checked);
    EXPECT_GT(fields.audit.checked, 0);
}

} // namespace
} // namespace overturn
