#include "overturn/sweep/fill.hpp"
#include "overturn/sweep/sweep_tile.hpp"
#include "support/every_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace overturn {
namespace {

Plane some_plane(std::int64_t rows, std::int64_t columns)
{
    Plane plane;
    plane.frequency = Axis(AxisRange{.first = 0.3, .last = 9, .count = columns});
    plane.amplitude = Axis(AxisRange{.first = 0.9, .last = 12, .count = rows});
    plane.restitution = Axis(AxisList{0.9});
    plane.restitution_of = RestitutionOf::maximum;
    plane.slenderness = Axis(AxisList{0.2});
    return plane;
}

struct Problem {
    Scene scene;
    Numerics numerics;
    Plane plane;
};

FilledTile filled(const Scene& scene, const Numerics& numerics, const Plane& plane,
                  bool with_impacts = false, const FillRule& rule = {},
                  Kernel kernel = widest_kernel())
{
    return fill_tile(scene, numerics, plane, filled_tiling(plane)[0], with_impacts, kernel, nullptr,
                     rule);
}

TileFields integrated(const Scene& scene, const Numerics& numerics, const Plane& plane)
{
    return sweep_tile(scene, numerics, plane, filled_tiling(plane)[0],
                      {Field::region, Field::impacts}, widest_kernel());
}

const auto& regions_of(const TileFields& fields)
{
    return std::get<std::vector<std::uint8_t>>(fields.values[0]);
}

const Numerics without_audit{.audit = 0};

std::int64_t count(const std::vector<std::uint8_t>& values, std::uint8_t value)
{
    return std::count(values.begin(), values.end(), value);
}

TEST(Fill, EveryPointHasTheRegionOfADirectSpectrum)
{
    const Plane plane = some_plane(128, 128);
    for (const Scene& scene : every_scene()) {
        for (const Numerics& numerics :
             {without_audit, Numerics{.method = Method::taylor, .audit = 0},
              Numerics{.tolerance = 1e-4, .resolve = true, .audit = 0}}) {
            const FilledTile tile = filled(scene, numerics, plane);
            EXPECT_EQ(tile.region, regions_of(integrated(scene, numerics, plane)))
                << name_of(scene.pulse) << ", " << name_of(scene.theory) << ", "
                << name_of(numerics.method);
            // If nothing were filled, this test would compare nothing.
            EXPECT_GT(count(tile.evaluated, point_origin::filled), 128 * 128 / 3)
                << name_of(scene.pulse);
        }
    }
}

TEST(Fill, EveryPointHasTheImpactsOfADirectSpectrum)
{
    const Plane plane = some_plane(128, 128);
    for (const Scene& scene : every_scene()) {
        const FilledTile tile = filled(scene, without_audit, plane, true);
        const TileFields direct = integrated(scene, without_audit, plane);
        EXPECT_EQ(tile.region, regions_of(direct)) << name_of(scene.pulse);
        EXPECT_EQ(tile.impacts, std::get<std::vector<std::uint16_t>>(direct.values[1]))
            << name_of(scene.pulse);
        EXPECT_GT(count(tile.evaluated, point_origin::filled), 128 * 128 / 5)
            << name_of(scene.pulse);
    }
}

TEST(Fill, EveryKernelFillsTheSamePoints)
{
    const Plane plane = some_plane(120, 100);
    for (const Kernel kernel : {Kernel::one_lane, Kernel::avx2, Kernel::avx512}) {
        if (!runs_here(kernel)) {
            continue;
        }
        for (const Scene& scene : every_scene()) {
            const Numerics numerics{.audit = 0.01};
            const FilledTile one = filled(scene, numerics, plane, true, {}, kernel);
            const FilledTile other = filled(scene, numerics, plane, true);
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
        const Plane plane = some_plane(rows, columns);
        const FilledTile tile = filled({}, without_audit, plane);
        EXPECT_EQ(tile.region, regions_of(integrated({}, without_audit, plane)))
            << rows << " x " << columns;
    }
}

/// Many low bounces precede a large motion: a strip of one row passes between nodes that agree.
Problem hard_problem()
{
    Problem problem{.scene = {.pulse = PulseKind::cosine, .shape = {.cycles = 2}},
                    .numerics = {.method = Method::taylor, .audit = 0},
                    .plane = some_plane(128, 128)};
    problem.plane.frequency = Axis(AxisRange{.first = 1.053725, .last = 2, .count = 128});
    problem.plane.amplitude = Axis(AxisRange{.first = 1.01, .last = 1.50306, .count = 128});
    problem.plane.restitution = Axis(AxisList{1});
    problem.plane.slenderness = Axis(AxisList{0.1});
    return problem;
}

constexpr FillRule nodes_alone{.kappa = 0, .grazes = false};

TEST(Fill, NodesThatAgreeAreNotEnough)
{
    const auto [scene, numerics, plane] = hard_problem();
    const auto expected = regions_of(integrated(scene, numerics, plane));
    EXPECT_EQ(filled(scene, numerics, plane).region, expected);
    EXPECT_NE(filled(scene, numerics, plane, false, nodes_alone).region, expected);
}

TEST(Fill, AuditOfAShareChecksThatShare)
{
    Plane plane = some_plane(128, 128);
    plane.frequency = Axis(AxisRange{.first = 8, .last = 9, .count = 128}); // S everywhere
    plane.amplitude = Axis(AxisRange{.first = 0.1, .last = 0.9, .count = 128});
    for (const double share : {1e-3, 0.01, 0.3, 1.0}) {
        const FilledTile tile = filled({}, {.audit = share}, plane);
        const FilledTile unchecked = filled({}, without_audit, plane);
        const double expected = share * double(count(unchecked.evaluated, point_origin::filled));
        // At most one point in a block is chosen: the variance is at most the Poisson one. A wrong
        // share would be off by a factor of two.
        EXPECT_NEAR(double(tile.audit.checked), expected, 5 * std::sqrt(expected)) << share;
        EXPECT_EQ(tile.audit.wrong, 0);
        EXPECT_EQ(count(tile.evaluated, point_origin::integrated),
                  count(unchecked.evaluated, point_origin::integrated) + tile.audit.checked);
    }
    EXPECT_EQ(filled({}, without_audit, plane).audit.checked, 0);
}

TEST(Fill, EveryPointIsIntegratedIfTheAuditFindsAWrongOne)
{
    auto [scene, numerics, plane] = hard_problem();
    numerics.audit = 1;
    const FilledTile tile = filled(scene, numerics, plane, false, nodes_alone);
    EXPECT_GT(tile.audit.wrong, 0);
    EXPECT_EQ(tile.region, regions_of(integrated(scene, numerics, plane)));
    EXPECT_EQ(count(tile.evaluated, point_origin::filled), 0);
}

TEST(Fill, SweepsStoreWhichPointsWereIntegrated)
{
    const Plane plane = some_plane(128, 128);
    const Numerics numerics{.fill = true};
    const TileFields fields =
        sweep_tile({}, numerics, plane, filled_tiling(plane)[0],
                   {Field::evaluated, Field::impacts, Field::region}, widest_kernel());
    const FilledTile tile = filled({}, numerics, plane, true);
    EXPECT_EQ(std::get<std::vector<std::uint8_t>>(fields.values[0]), tile.evaluated);
    EXPECT_EQ(std::get<std::vector<std::uint16_t>>(fields.values[1]), tile.impacts);
    EXPECT_EQ(std::get<std::vector<std::uint8_t>>(fields.values[2]), tile.region);
    EXPECT_EQ(fields.audit.checked, tile.audit.checked);
    EXPECT_GT(fields.audit.checked, 0);
}

} // namespace
} // namespace overturn
