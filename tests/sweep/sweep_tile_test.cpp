#include "overturn/sweep/sweep_tile.hpp"
#include "support/every_scene.hpp"
#include "support/one_point.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace overturn {
namespace {

const std::vector<Field> all_fields{Field::region, Field::angle,   Field::velocity, Field::margin,
                                    Field::error,  Field::impacts, Field::steps,    Field::status};

Plane small_plane()
{
    Plane plane;
    plane.frequency = Axis(AxisRange{0.3, 9.0, 37, Spacing::linear});
    plane.amplitude = Axis(AxisRange{0.9, 12.0, 29, Spacing::linear});
    plane.restitution = Axis(AxisList{0.6, 1.0});
    plane.restitution_of = RestitutionOf::maximum;
    plane.slenderness = Axis(AxisList{0.12, 0.3});
    return plane;
}

/// Every method, and every order of the Taylor series.
const std::vector<Numerics> all_numerics{{Method::rk45, 1e-9},
                                         {Method::taylor, 1e-6},
                                         {Method::taylor, 1e-9},
                                         {Method::rk45, 1e-4, true},
                                         {Method::taylor, 1e-4, true}};

std::string name_of(const Scene& scene, const Numerics& numerics)
{
    return std::string(name_of(scene.pulse)) + ", " + std::string(name_of(scene.theory)) + ", " +
           std::string(name_of(numerics.method)) + " at " + std::to_string(numerics.tolerance);
}

/// All bytes of the whole plane, field by field, in the order of the plane.
std::vector<std::vector<std::byte>> sweep_plane(const Scene& scene, const Numerics& numerics,
                                                const Plane& plane, const Tiling& tiling,
                                                Kernel kernel)
{
    std::vector<std::vector<std::byte>> bytes(all_fields.size());
    for (std::size_t f = 0; f < all_fields.size(); ++f) {
        bytes[f].resize(std::size_t(plane.points()) * bytes_per_point(all_fields[f]));
    }
    for (std::int64_t n = 0; n < tiling.size(); ++n) {
        const Tile tile = tiling[n];
        const TileFields fields = sweep_tile(scene, numerics, plane, tile, all_fields, kernel);
        for (std::size_t f = 0; f < all_fields.size(); ++f) {
            std::visit(
                [&](const auto& values) {
                    const std::size_t size = sizeof(values[0]);
                    const std::int64_t page =
                        tile.begin[0] * plane.restitution.size() + tile.begin[1];
                    for (std::int64_t i = 0; i < tile.count[2]; ++i) {
                        const std::int64_t row = page * plane.amplitude.size() + tile.begin[2] + i;
                        const std::int64_t to = row * plane.frequency.size() + tile.begin[3];
                        std::memcpy(bytes[f].data() + std::size_t(to) * size,
                                    values.data() + i * tile.columns(),
                                    std::size_t(tile.columns()) * size);
                    }
                },
                fields.values[f]);
        }
    }
    return bytes;
}

TEST(SweepTile, EveryKernelGivesTheSameBits)
{
    if (!is_compiled(Kernel::one_lane)) {
        GTEST_SKIP() << "OVERTURN_KERNELS is native: there is one kernel";
    }
    const Plane plane = small_plane();
    int compared = 0;
    for (const Kernel kernel : {Kernel::avx2, Kernel::avx512}) {
        if (!runs_here(kernel)) {
            continue;
        }
        ++compared;
        for (const Scene& scene : every_scene()) {
            for (const Numerics& numerics : all_numerics) {
                EXPECT_EQ(sweep_plane(scene, numerics, plane, Tiling(plane), kernel),
                          sweep_plane(scene, numerics, plane, Tiling(plane), Kernel::one_lane))
                    << name_of(scene, numerics) << ", " << name_of(kernel);
            }
        }
    }
    EXPECT_GT(compared, 0) << "this processor has neither AVX2 nor AVX-512: nothing was compared";
}

TEST(SweepTile, TileShapeAndLaneNeighboursChangeNoStoredValue)
{
    const Plane plane = small_plane();
    for (const Scene& scene : every_scene()) {
        for (const Numerics& numerics : all_numerics) {
            const auto swept = [&](const Tiling& tiling) {
                return sweep_plane(scene, numerics, plane, tiling, widest_kernel());
            };
            const auto whole = swept(Tiling(plane));
            // Rows of 3, 5 and 37 points put every point into different lanes with different
            // neighbours.
            for (const auto& [rows, columns] : {std::pair{1, 3}, {29, 5}, {7, 37}}) {
                EXPECT_EQ(swept(Tiling(shape_of(plane), {rows, columns})), whole)
                    << name_of(scene, numerics);
            }
        }
    }
}

TEST(SweepTile, AFieldDoesNotDependOnTheOtherRequestedFields)
{
    const Plane plane = small_plane();
    const Tile tile = Tiling(plane)[0];
    const TileFields all = sweep_tile({}, {}, plane, tile, all_fields, widest_kernel());
    for (std::size_t f = 0; f < all_fields.size(); ++f) {
        const TileFields one = sweep_tile({}, {}, plane, tile, {all_fields[f]}, widest_kernel());
        ASSERT_EQ(one.values.size(), 1u);
        EXPECT_EQ(one.values[0], all.values[f]) << name_of(all_fields[f]);
    }
}

int looks = 0; // number of checks whether to abandon the tile

bool never()
{
    ++looks;
    return false;
}

bool from_the_third_look_on()
{
    return ++looks >= 3;
}

TEST(SweepTile, IsUnchangedByChecksForAStop)
{
    const Plane plane = small_plane();
    const Tile tile = Tiling(plane)[0];
    for (const Numerics& numerics : all_numerics) {
        looks = 0;
        EXPECT_EQ(sweep_tile({}, numerics, plane, tile, all_fields, widest_kernel(), never).values,
                  sweep_tile({}, numerics, plane, tile, all_fields, widest_kernel()).values);
        EXPECT_GE(looks, 1);
    }
}

TEST(SweepTile, IsAbandonedOnRequest)
{
    const Plane plane = small_plane();
    const auto at_once = [] { return true; };
    for (const Numerics& numerics : all_numerics) {
        EXPECT_THROW(
            sweep_tile({}, numerics, plane, Tiling(plane)[0], all_fields, widest_kernel(), at_once),
            TileDropped);
    }
}

TEST(SweepTile, IsAbandonedDuringABlockThatBouncesAMillionTimes)
{
    const Plane plane = plane_of(PlanePoint{
        .slenderness = 0.2, .restitution = 1, .amplitude = 1.000002, .frequency = 0.003});
    for (const Numerics& numerics : all_numerics) {
        looks = 0;
        EXPECT_THROW(sweep_tile({}, numerics, plane, Tiling(plane)[0], {Field::region},
                                widest_kernel(), from_the_third_look_on),
                     TileDropped);
        EXPECT_LE(looks, 4); // once more after it has returned
    }
}

TEST(SweepTile, FieldsAreThoseOfTheForcedStageAndItsRegion)
{
    const Plane plane = small_plane();
    const Tile tile = Tiling(plane)[3];
    const TileFields fields = sweep_tile({}, {}, plane, tile, all_fields, widest_kernel());
    const auto& regions = std::get<std::vector<std::uint8_t>>(fields.values[0]);
    const auto& angles = std::get<std::vector<double>>(fields.values[1]);
    const auto& velocities = std::get<std::vector<double>>(fields.values[2]);
    const auto& margins = std::get<std::vector<double>>(fields.values[3]);
    const auto& errors = std::get<std::vector<double>>(fields.values[4]);
    const auto& impacts = std::get<std::vector<std::uint16_t>>(fields.values[5]);
    const auto& steps = std::get<std::vector<std::uint32_t>>(fields.values[6]);
    const auto& status = std::get<std::vector<std::uint8_t>>(fields.values[7]);
    for (std::int64_t i = 0; i < tile.points(); ++i) {
        const Point<double> point{plane.slenderness[tile.begin[0]],
                                  plane.restitution_ratio(tile.begin[0], tile.begin[1]),
                                  plane.frequency[tile.begin[3] + i % tile.columns()],
                                  plane.amplitude[tile.begin[2] + i / tile.columns()]};
        const auto end = forced_end<Theory::nonlinear, RungeKutta, true>(PulseKind::one_sine, point,
                                                                         Numerics{}.tolerance);
        const std::size_t k = std::size_t(i);
        ASSERT_EQ(angles[k], end.state.side * end.state.tilt);
        ASSERT_EQ(velocities[k], end.state.side * end.state.rate);
        ASSERT_EQ(margins[k], margin_of<Theory::nonlinear>(end, point));
        ASSERT_EQ(errors[k], end.error);
        ASSERT_EQ(steps[k], end.steps);
        ASSERT_EQ(impacts[k], end.rested ? 65535 : end.impacts);
        ASSERT_EQ(status[k], end.rested ? 1 : 0);
        const Region region = Region(regions[k]);
        ASSERT_EQ(region == Region::F_plus || region == Region::F_minus, end.fell);
        ASSERT_EQ(is_safe(region), margins[k] >= 0);
    }
}

TEST(SweepTile, MethodsGiveTheSameRegions)
{
    const Plane plane = small_plane();
    for (const Scene& scene : every_scene()) {
        const auto regions = [&](const Numerics& numerics) {
            return sweep_plane(scene, numerics, plane, Tiling(plane), widest_kernel())[0];
        };
        // Errors of 1e-8 shift a boundary across one in a million points; there are 4292 here. A
        // method that missed an impact would change hundreds.
        EXPECT_EQ(regions({Method::taylor, 1e-9}), regions({Method::rk45, 1e-9}))
            << name_of(scene.pulse) << ", " << name_of(scene.theory);
    }
}

TEST(SweepTile, SignsOfRegionsAreThoseOfTheAngleOrTheVelocity)
{
    const Plane plane = small_plane();
    for (const Scene& scene : every_scene()) {
        const TileFields fields =
            sweep_tile(scene, {}, plane, Tiling(plane)[0],
                       {Field::region, Field::angle, Field::velocity}, widest_kernel());
        const auto& regions = std::get<std::vector<std::uint8_t>>(fields.values[0]);
        const auto& angles = std::get<std::vector<double>>(fields.values[1]);
        const auto& velocities = std::get<std::vector<double>>(fields.values[2]);
        for (std::size_t i = 0; i < regions.size(); ++i) {
            switch (Region(regions[i])) {
            case Region::S_plus:
            case Region::U1_plus: EXPECT_GT(velocities[i], 0); break;
            case Region::S_minus:
            case Region::U1_minus: EXPECT_LT(velocities[i], 0); break;
            case Region::F_plus: EXPECT_EQ(angles[i], pi<double>() / 2); break;
            case Region::F_minus: EXPECT_EQ(angles[i], -pi<double>() / 2); break;
            case Region::U0_plus: EXPECT_GE(angles[i], 0); break;
            case Region::U0_minus: EXPECT_LE(angles[i], 0); break;
            default: EXPECT_EQ(Region(regions[i]), Region::S);
            }
        }
    }
}

} // namespace
} // namespace overturn
