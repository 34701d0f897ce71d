#include "overturn/problem/coordinates.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "support/every_kernel.hpp"
#include "support/every_scene.hpp"
#include "support/given_values.hpp"
#include "support/one_point.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace overturn {
namespace {

const std::vector<Field> all_fields{Field::region, Field::angle,   Field::velocity, Field::margin,
                                    Field::error,  Field::impacts, Field::steps,    Field::status};

/// All fields of a theory.
std::vector<Field> fields_of(const Scene& scene)
{
    std::vector<Field> fields = all_fields;
    fields.push_back(Field::peak);
    if (has_contact_forces(scene.theory)) {
        fields.insert(fields.end(), {Field::friction_demand, Field::normal});
    }
    return fields;
}

Problem small_problem(const Scene& scene = {}, const Numerics& numerics = {},
                      const std::vector<Field>& fields = all_fields)
{
    return {.scene = scene,
            .grid = grid_of(scene, {axis("slenderness", {0.12, 0.3}),
                                    axis("restitution_of_maximum", {0.6, 1.0}),
                                    axis("amplitude", AxisRange{0.9, 12.0, 13}),
                                    axis("frequency", AxisRange{0.3, 9.0, 21})}),
            .numerics = numerics,
            .fields = fields};
}

/// Every method, and every order of the Taylor series.
const std::vector<Numerics> all_numerics{{Method::rk45, 1e-9},
                                         {Method::taylor, 1e-6},
                                         {Method::taylor, 1e-9},
                                         {Method::rk45, 1e-4, true},
                                         {Method::taylor, 1e-4, true}};

std::string name_of(const Scene& scene, const Numerics& numerics)
{
    return std::string(name_of(scene.pulse()->kind)) + ", " + std::string(name_of(scene.theory)) +
           ", " + std::string(name_of(numerics.method)) + " at " +
           std::to_string(numerics.tolerance);
}

/// The place of point i of a tile among all points of a shape.
std::size_t place_of(std::int64_t i, const Tile& tile, const Shape& shape)
{
    std::int64_t place = 0;
    std::int64_t stride = 1;
    for (std::size_t d = shape.size(); d-- > 0;) {
        place += (tile.begin[d] + i % tile.count[d]) * stride;
        i /= tile.count[d];
        stride *= shape[d];
    }
    return std::size_t(place);
}

/// All bytes of all points, field by field, in the order of the points.
std::vector<std::vector<std::byte>> compute_all(const Problem& problem, const Tiling& tiling,
                                                Kernel kernel)
{
    std::vector<std::vector<std::byte>> bytes(problem.fields.size());
    for (std::size_t f = 0; f < bytes.size(); ++f) {
        bytes[f].resize(std::size_t(problem.grid.points()) * bytes_per_point(problem.fields[f]));
    }
    for (std::int64_t n = 0; n < tiling.size(); ++n) {
        const Tile tile = tiling[n];
        const TileFields fields = compute_tile(problem, tile, kernel);
        for (std::size_t f = 0; f < bytes.size(); ++f) {
            std::visit(
                [&](const auto& values) {
                    const std::size_t size = sizeof(values[0]);
                    for (std::int64_t i = 0; i < tile.points(); ++i) {
                        std::memcpy(bytes[f].data() + place_of(i, tile, tiling.shape()) * size,
                                    &values[std::size_t(i)], size);
                    }
                },
                fields.values[f]);
        }
    }
    return bytes;
}

TEST(ComputeTile, EveryKernelGivesTheSameBits)
{
    if (!is_compiled(Kernel::one_lane)) {
        GTEST_SKIP() << "OVERTURN_KERNELS is native: there is one kernel";
    }
    const std::vector<Kernel> kernels = every_kernel();
    EXPECT_GT(kernels.size(), 1u) << "this processor runs one kernel: nothing was compared";
    for (const Scene& scene : every_scene()) {
        for (const Numerics& numerics : all_numerics) {
            const Problem problem = small_problem(scene, numerics, fields_of(scene));
            const auto expected = compute_all(problem, tiling_of(problem), Kernel::one_lane);
            for (const Kernel kernel : kernels) {
                EXPECT_EQ(compute_all(problem, tiling_of(problem), kernel), expected)
                    << name_of(scene, numerics) << ", " << name_of(kernel);
            }
        }
    }
}

TEST(ComputeTile, TileShapeAndLaneNeighboursChangeNoStoredValue)
{
    for (const Scene& scene : every_scene()) {
        for (const Numerics& numerics : all_numerics) {
            const Problem problem = small_problem(scene, numerics);
            const auto computed = [&](const Tiling& tiling) {
                return compute_all(problem, tiling, widest_kernel());
            };
            const auto whole = computed(tiling_of(problem));
            // Rows of 3, 5 and 21 points put every point into different lanes with different
            // neighbours.
            for (const Shape& tile :
                 {Shape{1, 1, 1, 3}, {1, 1, 13, 5}, {1, 1, 7, 21}, {2, 2, 4, 8}}) {
                EXPECT_EQ(computed(Tiling(problem.grid.shape(), tile)), whole)
                    << name_of(scene, numerics);
            }
        }
    }
}

TEST(ComputeTile, AFieldDoesNotDependOnTheOtherRequestedFields)
{
    const Problem problem = small_problem();
    const Tile tile = tiling_of(problem)[0];
    const TileFields all = compute_tile(problem, tile, widest_kernel());
    for (std::size_t f = 0; f < all_fields.size(); ++f) {
        const TileFields one =
            compute_tile(small_problem({}, {}, {all_fields[f]}), tile, widest_kernel());
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

TEST(ComputeTile, IsUnchangedByChecksForAStop)
{
    for (const Numerics& numerics : all_numerics) {
        const Problem problem = small_problem({}, numerics);
        const Tile tile = tiling_of(problem)[0];
        looks = 0;
        EXPECT_EQ(compute_tile(problem, tile, widest_kernel(), never).values,
                  compute_tile(problem, tile, widest_kernel()).values);
        EXPECT_GE(looks, 1);
    }
}

TEST(ComputeTile, IsAbandonedOnRequest)
{
    const auto at_once = [] { return true; };
    for (const Numerics& numerics : all_numerics) {
        const Problem problem = small_problem({}, numerics);
        EXPECT_THROW(compute_tile(problem, tiling_of(problem)[0], widest_kernel(), at_once),
                     TileDropped);
    }
}

TEST(ComputeTile, IsAbandonedDuringABlockThatBouncesAMillionTimes)
{
    const Point point{.block = {0.2, 1}, .amplitude = 1.000002, .frequency = 0.003};
    for (const Numerics& numerics : all_numerics) {
        const Problem problem{
            .grid = grid_of_point(point), .numerics = numerics, .fields = {Field::region}};
        looks = 0;
        EXPECT_THROW(
            compute_tile(problem, tiling_of(problem)[0], widest_kernel(), from_the_third_look_on),
            TileDropped);
        EXPECT_LE(looks, 4); // once more after it has returned
    }
}

TEST(ComputeTile, FieldsAreThoseOfTheForcedStageAndItsRegion)
{
    const Problem problem = small_problem();
    const Tile tile = Tiling(problem.grid.shape(), {1, 1, 13, 21})[3];
    const std::vector<Point> points = Coordinates(problem.scene, problem.grid, tile).points();
    const TileFields fields = compute_tile(problem, tile, widest_kernel());
    const auto& regions = std::get<std::vector<std::uint8_t>>(fields.values[0]);
    const auto& angles = std::get<std::vector<double>>(fields.values[1]);
    const auto& velocities = std::get<std::vector<double>>(fields.values[2]);
    const auto& margins = std::get<std::vector<double>>(fields.values[3]);
    const auto& errors = std::get<std::vector<double>>(fields.values[4]);
    const auto& impacts = std::get<std::vector<std::uint16_t>>(fields.values[5]);
    const auto& steps = std::get<std::vector<std::uint32_t>>(fields.values[6]);
    const auto& status = std::get<std::vector<std::uint8_t>>(fields.values[7]);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const PulsePoint<double> point{points[k].block.slenderness, points[k].block.restitution,
                                       points[k].frequency, points[k].amplitude};
        const auto end = forced_end<Theory::nonlinear, RungeKutta, true>(PulseKind::one_sine, point,
                                                                         Numerics{}.tolerance);
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

TEST(ComputeTile, MethodsGiveTheSameRegions)
{
    for (const Scene& scene : every_scene()) {
        const auto regions = [&](const Numerics& numerics) {
            const Problem problem = small_problem(scene, numerics, {Field::region});
            return compute_all(problem, tiling_of(problem), widest_kernel())[0];
        };
        // Errors of 1e-8 shift a boundary across one in a million points; there are 1092 here. A
        // method that missed an impact would change dozens.
        EXPECT_EQ(regions({Method::taylor, 1e-9}), regions({Method::rk45, 1e-9}))
            << name_of(scene.pulse()->kind) << ", " << name_of(scene.theory);
    }
}

TEST(ComputeTile, SignsOfRegionsAreThoseOfTheAngleOrTheVelocity)
{
    for (const Scene& scene : every_scene()) {
        const Problem problem =
            small_problem(scene, {}, {Field::region, Field::angle, Field::velocity});
        const TileFields fields = compute_tile(problem, tiling_of(problem)[0], widest_kernel());
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
