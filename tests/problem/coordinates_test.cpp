// Derived coordinates against closed forms, and against those of the same block and motion in other
// quantities.
#include "overturn/problem/coordinates.hpp"

#include "overturn/mechanics/block.hpp"
#include "support/given_values.hpp"
#include "support/short_records.hpp"
#include "support/two_sides.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace overturn {
namespace {

constexpr double pi = std::numbers::pi;

/// A block of 0.6 m x 1.8 m, and its shape and size in the other quantities.
constexpr double width = 0.6;
constexpr double height = 1.8;
const double alpha = std::atan(width / height);
const double size = std::hypot(width / 2, height / 2);
const double p = std::sqrt(3 * 9.81 / (4 * size));

double value_of(const Scene& scene, const Grid& grid, std::string_view name)
{
    const Coordinates coordinates(scene, grid);
    EXPECT_TRUE(coordinates.has(name)) << name;
    EXPECT_TRUE(coordinates.dimensions_of(name).empty()) << name;
    return coordinates.of(name).values.at(0);
}

TEST(Coordinates, OfABlockFollowFromEveryDescriptionOfIt)
{
    const std::vector<std::vector<Given>> descriptions{
        {number("width", width), number("height", height)},
        {number("half_width", width / 2), number("height", height)},
        {number("width", width), number("half_height", height / 2)},
        {number("half_width", width / 2), number("half_height", height / 2)},
        {number("slenderness", alpha), number("size", size)},
        {number("slenderness", alpha), number("frequency_parameter", p)}};
    for (std::vector<Given> given : descriptions) {
        given.push_back(number("restitution_of_maximum", 0.8));
        given.push_back(number("pga", 0.5));
        given.push_back(number("pulse_period", 0.7));
        const Grid grid = grid_of({}, given);
        EXPECT_DOUBLE_EQ(value_of({}, grid, "slenderness"), alpha);
        EXPECT_DOUBLE_EQ(value_of({}, grid, "size"), size);
        EXPECT_DOUBLE_EQ(value_of({}, grid, "frequency_parameter"), p);
        EXPECT_DOUBLE_EQ(value_of({}, grid, "restitution"), 0.8 * largest_restitution(alpha));
        EXPECT_DOUBLE_EQ(value_of({}, grid, "amplitude"), 0.5 / (width / height));
        EXPECT_DOUBLE_EQ(value_of({}, grid, "frequency"), 2 * pi / (0.7 * p));
    }
}

TEST(Coordinates, OfABlockOfAnySizeScaleExactly)
{
    const auto size_of = [](double scale) {
        const Grid grid = grid_of({}, {number("width", width * scale),
                                       number("height", height * scale), number("restitution", 0.8),
                                       number("amplitude", 2), number("frequency", 3)});
        return value_of({}, grid, "size");
    };
    for (const double scale :
         {0x1p-560, 0x1p-3, 0x1p+560}) { // squares are beyond the range of doubles
        EXPECT_EQ(size_of(scale), scale * size_of(1));
    }
}

TEST(Coordinates, OfAPulseFollowFromEveryDescriptionOfIt)
{
    const double frequency = 2 * pi / (0.7 * p);
    const double amplitude = 0.5 / std::tan(alpha);
    for (const Given& rate : {number("frequency", frequency), number("pulse_period", 0.7),
                              number("pulse_frequency", 1 / 0.7)}) {
        for (const Given& strength : {number("amplitude", amplitude), number("pga", 0.5)}) {
            const Grid grid = grid_of({}, {number("slenderness", alpha), number("size", size),
                                           number("restitution", 0.7), strength, rate});
            EXPECT_DOUBLE_EQ(value_of({}, grid, "frequency"), frequency);
            EXPECT_DOUBLE_EQ(value_of({}, grid, "amplitude"), amplitude);
            EXPECT_DOUBLE_EQ(value_of({}, grid, "pga"), 0.5);
            if (rate.quantity->name != "pulse_frequency") {
                EXPECT_DOUBLE_EQ(value_of({}, grid, "pulse_period"), 0.7);
            }
            EXPECT_EQ(value_of({}, grid, "restitution"), 0.7);
        }
    }
}

TEST(Coordinates, OfTheLinearTheoryHaveTheUpliftOfSmallAngles)
{
    const Scene scene{.theory = Theory::linear};
    const Grid grid = grid_of(scene, {number("slenderness", 0.2), number("restitution", 0.7),
                                      number("pga", 0.5), number("frequency", 3)});
    EXPECT_DOUBLE_EQ(value_of(scene, grid, "amplitude"), 0.5 / 0.2);
}

TEST(Coordinates, OfOtherGravityHaveAnotherFrequencyParameter)
{
    const Scene moon{.gravity = 1.62};
    const Grid grid =
        grid_of(moon, {number("slenderness", 0.2), number("size", 2), number("restitution", 0.7),
                       number("amplitude", 2), number("pulse_period", 1.5)});
    const double slow = std::sqrt(3 * 1.62 / 8);
    EXPECT_DOUBLE_EQ(value_of(moon, grid, "frequency_parameter"), slow);
    EXPECT_DOUBLE_EQ(value_of(moon, grid, "frequency"), 2 * pi / (1.5 * slow));
    // A block and a pulse without units do not depend on gravity.
    const Grid dimensionless =
        grid_of(moon, {number("slenderness", 0.2), number("restitution", 0.7), number("pga", 0.5),
                       number("frequency", 3)});
    EXPECT_DOUBLE_EQ(value_of(moon, dimensionless, "amplitude"), 0.5 / std::tan(0.2));
}

TEST(Coordinates, OfARecordFollowFromItsPeakAndTimeStep)
{
    const Scene scene = scene_of_three_records();
    const std::vector<Given> block{number("slenderness", alpha), number("size", size),
                                   number("restitution", 0.7), number("motion", 2)};
    std::vector<Given> given = block;
    given.push_back(number("pga", 0.75));
    EXPECT_EQ(value_of(scene, grid_of(scene, given), "record_pga"), 0.25);
    EXPECT_DOUBLE_EQ(value_of(scene, grid_of(scene, given), "scale"), 3);
    EXPECT_DOUBLE_EQ(value_of(scene, grid_of(scene, given), "samples_per_unit"), 1 / (0.02 * p));
    given.back() = number("scale", 3);
    EXPECT_DOUBLE_EQ(value_of(scene, grid_of(scene, given), "pga"), 0.75);
}

TEST(Coordinates, WithoutASizeHaveNoUnits)
{
    const Grid grid = grid_of({}, {number("slenderness", 0.2), number("restitution", 0.7),
                                   number("amplitude", 2), number("frequency", 3)});
    const Scene scene;
    const Coordinates coordinates(scene, grid);
    for (const char* name : {"size", "frequency_parameter", "pulse_period", "record_pga", "scale",
                             "width", "samples_per_unit", "motion"}) {
        EXPECT_FALSE(coordinates.has(name)) << name;
    }
    EXPECT_TRUE(coordinates.has("pga"));
}

using Dimensions = std::vector<std::size_t>;

TEST(Coordinates, VaryAlongTheirOwnDimensionsOnly)
{
    const Grid grid = grid_of({}, {axis("size", {1, 2}), axis("slenderness", {0.1, 0.2, 0.3}),
                                   axis("restitution_of_maximum", {0.5, 1}),
                                   axis("pga", {0.2, 0.4, 0.6, 0.8}), number("pulse_period", 1)});
    ASSERT_EQ(grid.shape(), (Shape{3, 2, 2, 4})); // slenderness, size, restitution, pga
    const Scene scene;
    const Coordinates coordinates(scene, grid);
    EXPECT_EQ(coordinates.dimensions_of("slenderness"), (Dimensions{0}));
    EXPECT_EQ(coordinates.dimensions_of("frequency_parameter"), (Dimensions{1}));
    EXPECT_EQ(coordinates.dimensions_of("frequency"), (Dimensions{1}));
    EXPECT_EQ(coordinates.dimensions_of("restitution"), (Dimensions{0, 2}));
    EXPECT_EQ(coordinates.dimensions_of("amplitude"), (Dimensions{0, 3}));
    EXPECT_EQ(coordinates.dimensions_of("pulse_period"), Dimensions());
    const CoordinateValues& restitution = coordinates.of("restitution");
    EXPECT_EQ(restitution.dimensions, (Dimensions{0, 2}));
    ASSERT_EQ(restitution.values.size(), 6u);
    for (std::size_t i = 0; i < 3; ++i) {
        const double largest = largest_restitution(0.1 * double(i + 1));
        EXPECT_DOUBLE_EQ(restitution.values[2 * i], 0.5 * largest);
        EXPECT_DOUBLE_EQ(restitution.values[2 * i + 1], largest);
    }
    EXPECT_EQ(coordinates.along({1, 3}, "size"), (std::vector<double>{1, 1, 1, 1, 2, 2, 2, 2}));
}

TEST(Coordinates, OfHeightBesideWidthGiveEveryShape)
{
    const Grid grid =
        grid_of({}, {axis("width", {0.5, 1}), axis("height", {2, 3, 4}), number("restitution", 0.7),
                     number("pga", 0.5), number("pulse_period", 1)});
    ASSERT_EQ(grid.shape(), (Shape{2, 3}));
    const Scene scene;
    const Coordinates coordinates(scene, grid);
    const std::vector<double>& alphas = coordinates.of("slenderness").values;
    const std::vector<double>& sizes = coordinates.of("size").values;
    for (std::size_t i = 0; i < 6; ++i) {
        const double b = i < 3 ? 0.25 : 0.5;
        const double h = 0.5 * double(2 + i % 3);
        EXPECT_DOUBLE_EQ(alphas[i], std::atan(b / h));
        EXPECT_DOUBLE_EQ(sizes[i], std::hypot(b, h));
    }
}

TEST(Coordinates, OfAFrequencyParameterUnderAPulseGiveTheFrequency)
{
    const Grid grid =
        grid_of({}, {number("slenderness", 0.2), number("restitution", 0.7), number("amplitude", 2),
                     axis("frequency_parameter", {1, 2, 4}), axis("pulse_frequency", {0.5, 1})});
    ASSERT_EQ(grid.shape(), (Shape{3, 2}));
    const Scene scene;
    const std::vector<double> frequencies = Coordinates(scene, grid).along({0, 1}, "frequency");
    const std::vector<double> expected{pi, 2 * pi, pi / 2, pi, pi / 4, pi / 2};
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_DOUBLE_EQ(frequencies[i], expected[i]);
    }
}

void expect_equal(const Point& one, const Point& other)
{
    EXPECT_EQ(one.block.slenderness, other.block.slenderness);
    EXPECT_EQ(one.block.restitution, other.block.restitution);
    EXPECT_EQ(one.amplitude, other.amplitude);
    EXPECT_EQ(one.frequency, other.frequency);
    EXPECT_EQ(one.record, other.record);
}

TEST(Coordinates, OfATileAreThoseOfTheWholeGrid)
{
    for (const bool is_recorded : {false, true}) {
        const Scene scene = is_recorded ? scene_of_three_records() : Scene();
        std::vector<Given> given{axis("slenderness", {0.1, 0.2, 0.3}),
                                 axis("restitution_of_maximum", {0.5, 1}),
                                 axis("pga", AxisRange{0.2, 2, 7}), axis("size", {1, 2, 4, 8})};
        if (is_recorded) {
            given.push_back(axis("motion", {1, 2, 3}));
        } else {
            given.push_back(axis("pulse_period", AxisRange{0.2, 2, 5}));
        }
        const Grid grid = grid_of(scene, given);
        const Shape shape = grid.shape();
        const std::vector<Point> all = Coordinates(scene, grid).points();
        ASSERT_EQ(std::int64_t(all.size()), grid.points());
        EXPECT_EQ(all.back().record, is_recorded ? 2 : 0);
        Shape extents(shape.size(), 2);
        extents.back() = 3;
        const Tiling tiling(shape, extents);
        for (std::int64_t n = 0; n < tiling.size(); ++n) {
            const Tile tile = tiling[n];
            const Coordinates coordinates(scene, grid, tile);
            const std::vector<Point> points = coordinates.points();
            for (std::int64_t i = 0; i < tile.points(); ++i) {
                std::int64_t place = 0;
                std::int64_t stride = 1;
                for (std::size_t d = shape.size(), left = std::size_t(i); d-- > 0;) {
                    const auto count = std::size_t(tile.count[d]);
                    place += (tile.begin[d] + std::int64_t(left % count)) * stride;
                    left /= count;
                    stride *= shape[d];
                }
                expect_equal(points[std::size_t(i)], all[std::size_t(place)]);
            }
        }
    }
}

TEST(Coordinates, OfAScalarGridAreOnePoint)
{
    const Grid grid =
        grid_of({}, {number("width", width), number("height", height), number("restitution", 0.7),
                     number("pga", 0.5), number("pulse_period", 0.7)});
    EXPECT_EQ(grid.points(), 1);
    const Scene scene;
    const std::vector<Point> points = Coordinates(scene, grid).points();
    ASSERT_EQ(points.size(), 1u);
    expect_equal(points[0], {.block = {std::atan((width / 2) / (height / 2)), 0.7},
                             .amplitude = points[0].amplitude,
                             .frequency = points[0].frequency});
}

/// The block of the only point under a pulse of 0.5 s and 0.6 g.
Point point_of(std::vector<Given> given)
{
    given.push_back(number("pulse_period", 0.5));
    given.push_back(number("pga", 0.6));
    const Grid grid = grid_of({}, given);
    return Coordinates({}, grid).points().at(0);
}

void expect_block(const Block<double>& found, const Block<double>& expected)
{
    // Some roundings each.
    EXPECT_NEAR(found.slenderness, expected.slenderness, 1e-15);
    EXPECT_NEAR(found.restitution, expected.restitution, 4e-15);
    EXPECT_NEAR(found.size, expected.size, 1e-15);
    EXPECT_NEAR(found.frequency_parameter, expected.frequency_parameter, 4e-15);
    EXPECT_NEAR(found.other.slenderness, expected.other.slenderness, 1e-15);
    EXPECT_NEAR(found.other.size, expected.other.size, 1e-15);
    EXPECT_NEAR(found.other.frequency_parameter, expected.other.frequency_parameter, 4e-15);
}

TEST(TwoSides, LoseTheSameEnergyWithTheMeanRatioOfTheVelocities)
{
    std::mt19937_64 generator(62);
    for (int i = 0; i < 50; ++i) {
        const Body body = random_body(generator);
        const double ratio = 0.5 + 0.01 * i;
        const Block<double> block =
            point_of({number("width", body.plus + body.minus), number("height", 2.0),
                      number("center_offset", (body.minus - body.plus) / 2),
                      number("center_height", body.height),
                      number("radius_of_gyration", body.gyration), number("incline", body.incline),
                      number("velocity_restitution", ratio)})
                .block;
        // Each is in units of the p of its side; in the product they cancel.
        EXPECT_DOUBLE_EQ(block.rate_ratio() * block.turned().rate_ratio(), ratio * ratio);
    }
}

TEST(TwoSides, AreThoseOfTheShapeAndTheMassOfTheBlock)
{
    std::mt19937_64 generator(61);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 200; ++i) {
        const Body body = random_body(generator);
        const double share = 0.5 + 0.5 * uniform(generator);
        const Block<double> expected = body.block(share * body.largest_restitution());
        const Point as_shape = point_of(
            {number("width", body.plus + body.minus), number("height", 2.0),
             number("center_offset", (body.minus - body.plus) / 2),
             number("center_height", body.height), number("radius_of_gyration", body.gyration),
             number("incline", body.incline), number("restitution_of_maximum", share)});
        expect_block(as_shape.block, expected);
        EXPECT_DOUBLE_EQ(as_shape.frequency, 4 * std::numbers::pi);
        const double least = std::min(expected.slenderness, expected.other.slenderness);
        EXPECT_NEAR(as_shape.amplitude, 0.6 / std::tan(least), 1e-13 * as_shape.amplitude);
        const Point as_surveyed = point_of(
            {number("slenderness_plus", expected.slenderness),
             number("slenderness_minus", expected.other.slenderness),
             number("size_plus", expected.size), number("size_minus", expected.other.size),
             number("radius_of_gyration", body.gyration), number("restitution_of_maximum", share)});
        expect_block(as_surveyed.block, expected);
    }
}

TEST(TwoSides, GivenByAnglesAndDistancesImplyTheInclineOfTheBase)
{
    std::mt19937_64 generator(62);
    for (int i = 0; i < 50; ++i) {
        const Body body = random_body(generator);
        const Block<double> block = body.block(0.5);
        const std::vector<Given> surveyed{number("slenderness_plus", block.slenderness),
                                          number("slenderness_minus", block.other.slenderness),
                                          number("size_plus", block.size),
                                          number("size_minus", block.other.size),
                                          number("radius_of_gyration", body.gyration),
                                          number("restitution", 0.5),
                                          number("pga", 0.6),
                                          number("pulse_period", 0.5)};
        // A few roundings of lengths of 1 m over a base of at least 0.2 m.
        EXPECT_NEAR(value_of({}, grid_of({}, surveyed), "incline"), body.incline, 1e-14);
    }
}

TEST(TwoSides, ThatAreEqualGiveTheSymmetricBlock)
{
    const std::vector<Given> box{number("width", 0.5), number("height", 2.0),
                                 number("restitution_of_maximum", 1)};
    const Point symmetric = point_of(box);
    std::vector<Given> level = box;
    level.push_back(number("incline", 0));
    const Point general = point_of(level);
    EXPECT_TRUE(general.block.is_symmetric());
    EXPECT_EQ(general.block.slenderness, symmetric.block.slenderness);
    EXPECT_EQ(general.block.frequency_parameter, 1);
    // By other formulas, with a few roundings.
    EXPECT_NEAR(general.block.restitution, symmetric.block.restitution, 1e-15);
    EXPECT_NEAR(general.frequency, symmetric.frequency, 1e-14);
    EXPECT_EQ(general.amplitude, symmetric.amplitude);
}

TEST(TwoSides, OfARockingFrameAreThoseOfAnEquivalentBlock)
{
    // Columns of the half diagonal R under a beam of gamma times their mass, tan alpha = 1/6,
    // gamma = 10: p of the frame over that of a column, and r_max, seven digits each.
    const double angle = std::atan(1.0 / 6);
    const double column = 1.5;
    const double gamma = 10;
    const double radius = column * (1 + 4 * gamma) / (1 + 2 * gamma);
    const Point frame =
        point_of({number("slenderness_plus", angle), number("slenderness_minus", angle),
                  number("size_plus", radius), number("size_minus", radius),
                  number("radius_of_gyration", radius / std::sqrt(3 + 12 * gamma)),
                  number("restitution_of_maximum", 1)});
    EXPECT_TRUE(frame.block.is_symmetric());
    EXPECT_NEAR(frame.block.restitution, 0.8956386, 5e-8);
    EXPECT_NEAR(4 * std::numbers::pi / frame.frequency / std::sqrt(3 * 9.81 / (4 * column)),
                0.8230549, 5e-8);
}

TEST(Direction, OfTheMirrorImageMirrorsTheMotion)
{
    const Grid grid =
        grid_of({}, {number("width", 0.5), number("height", 2.0), number("incline", 0.02),
                     number("restitution", 0.7), number("pulse_period", 0.5),
                     axis("direction", {0, 180}), axis("pga", {0, 0.3, 0.6})});
    const std::vector<Point> points = Coordinates({}, grid).points();
    ASSERT_EQ(points.size(), 6u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(points[3 + i].amplitude, -points[i].amplitude);
        EXPECT_TRUE(std::signbit(points[3 + i].amplitude));
    }
}

TEST(Coordinates, OfTwoComponentsHaveThePeakOfEveryDirection)
{
    Scene scene;
    scene.motion = Suite{{record_of_two_components(0.5, 0.01), record_of_two_components(1, 0.02)}};
    const Grid grid = grid_of(scene, {number("slenderness", 0.2), number("size", 1.0),
                                      number("restitution", 0.8), axis("motion", {1, 2}),
                                      axis("direction", {0, 30, 90, 210}), axis("scale", {1, 3})});
    const Coordinates coordinates(scene, grid);
    EXPECT_EQ(coordinates.dimensions_of("pga"), (std::vector<std::size_t>{0, 1, 2}));
    const std::vector<double>& pga = coordinates.of("pga").values;
    const std::vector<Point> points = coordinates.points();
    ASSERT_EQ(points.size(), pga.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto record = directed_record(scene, points[i]);
        EXPECT_EQ(pga[i], record->peak() * points[i].amplitude);
        EXPECT_EQ(pga_of_unit(scene, points[i]), record->peak());
        EXPECT_GT(points[i].amplitude, 0); // its mirror image is that of the direction
    }
    EXPECT_EQ(pga[0], 0.75); // of the first component
    EXPECT_EQ(pga[4], 0.5);  // of the second one
    EXPECT_EQ(pga[2], pga[6]);
}

TEST(LargestRestitution, ExistsBelowTheSlendernessAtWhichItIsZero)
{
    EXPECT_DOUBLE_EQ(limit_of_r_max, std::asin(std::sqrt(2.0 / 3)));
    EXPECT_EQ(r_max_of(0.3), largest_restitution(0.3));
    EXPECT_EQ(r_max_of(limit_of_r_max), std::nullopt);
    EXPECT_NEAR(r_max_of(std::nextafter(limit_of_r_max, 0.0)).value(), 0, 1e-30);
}

TEST(LiftingPga, LiftsTheBlockOfThisSlenderness)
{
    Point point{.block = {0.2, 1}, .amplitude = 1, .frequency = 1};
    EXPECT_DOUBLE_EQ(lifting_pga({}, point), std::tan(0.2));
    EXPECT_DOUBLE_EQ(lifting_pga({.theory = Theory::linear}, point), 0.2);
    // Without vertical motion, the peak of any record lifts the block at the same acceleration.
    const Scene scene = scene_of_three_records();
    for (; point.record < 3; ++point.record) {
        EXPECT_NEAR(lifting_pga(scene, point), std::tan(0.2), 1e-15);
    }
}

} // namespace
} // namespace overturn
