// What is stored of a problem, and its division into tiles.
#include "overturn/problem/problem.hpp"

#include "support/given_values.hpp"
#include "support/short_records.hpp"

#include <gmock/gmock.h>

namespace overturn {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

Problem problem_of_grid(const Scene& scene, std::vector<Given> given)
{
    return {.scene = scene, .grid = grid_of(scene, std::move(given)), .fields = {Field::region}};
}

/// A spectrum of the paper's block. strength, rate: numbers or axes.
Problem spectrum(const Given& strength, const Given& rate)
{
    return problem_of_grid(
        {}, {number("slenderness", 0.1745716), number("restitution", 0.9), strength, rate});
}

Given pga_axis(std::int64_t count)
{
    return axis("pga", AxisRange{0.1, 2, count});
}

Given frequency_axis(std::int64_t count)
{
    return axis("frequency", AxisRange{0.5, 8, count});
}

TEST(TilingOf, AGridHasItsAxesFromSlendernessToFrequency)
{
    const Problem problem = problem_of_grid(
        {}, {axis("slenderness", {0.1, 0.2}), axis("restitution", {0.5, 0.7, 0.9}),
             axis("amplitude", AxisRange{1, 9, 100}), axis("frequency", AxisRange{1, 9, 20})});
    EXPECT_EQ(tiling_of(problem).shape(), (Shape{2, 3, 100, 20}));
    // 64 x 20 points, and as many as fit along the other dimensions, the fastest first.
    EXPECT_EQ(tiling_of(problem).tile_shape(), (Shape{1, 2, 100, 20}));
}

TEST(TilingOf, AnyGridHasAtMost64TimesSixtyFourPointsInATile)
{
    const auto tile = [](std::int64_t rows, std::int64_t columns) {
        return tiling_of(spectrum(pga_axis(rows), frequency_axis(columns))).tile_shape();
    };
    EXPECT_EQ(tile(1000, 1000), (Shape{64, 64}));
    EXPECT_EQ(tile(1000, 64), (Shape{64, 64}));
    EXPECT_EQ(tile(1000, 16), (Shape{256, 16}));
    EXPECT_EQ(tile(16, 1000), (Shape{16, 256}));
    EXPECT_EQ(tile(30, 20), (Shape{30, 20}));
    EXPECT_EQ(tiling_of(spectrum(pga_axis(10000), number("frequency", 3))).tile_shape(),
              (Shape{4096}));
    EXPECT_EQ(tiling_of(spectrum(number("pga", 1), number("frequency", 3))).size(), 1);
}

TEST(TilingOf, ATableHasTheOtherDimensionsFirst)
{
    const std::vector<double> widths(5000, 0.5);
    const Quantities blocks{column("width", widths), number("height", 2),
                            number("restitution", 0.9)};
    const auto tile = [&](const Quantities& given) {
        return tiling_of(problem_of_grid({}, blocks + given)).tile_shape();
    };
    EXPECT_EQ(tile({number("pga", 1), number("frequency", 3)}), (Shape{4096}));
    EXPECT_EQ(tile({pga_axis(8), number("frequency", 3)}), (Shape{512, 8}));
    EXPECT_EQ(tile({pga_axis(8), frequency_axis(4)}), (Shape{128, 8, 4}));
    EXPECT_EQ(tile({pga_axis(100), frequency_axis(3)}), (Shape{13, 100, 3}));
    EXPECT_EQ(tile({pga_axis(1000), frequency_axis(1000)}), (Shape{1, 64, 64}));
}

TEST(TilingOf, RecordsHasTilesOf16Times16PointsUnderOneRecord)
{
    const Scene scene = scene_of_three_records();
    const auto tile = [&](const Given& strength, const Given& size) {
        return tiling_of(
                   problem_of_grid(scene, {axis("motion", {1, 2, 3}), strength, size,
                                           number("slenderness", 0.2), number("restitution", 0.9)}))
            .tile_shape();
    };
    EXPECT_EQ(tile(pga_axis(100), axis("size", AxisRange{1, 2, 50})), (Shape{1, 16, 16}));
    EXPECT_EQ(tile(pga_axis(100), axis("size", {1, 2})), (Shape{1, 100, 2}));
}

TEST(TilingOf, AFilledSpectrumHasLargeTilesAlongStrengthAndRate)
{
    const auto tile = [](std::int64_t rows, std::int64_t columns) {
        Problem problem = problem_of_grid({}, {axis("slenderness", {0.1, 0.2}),
                                               axis("restitution", {0.5, 0.7, 0.9}), pga_axis(rows),
                                               frequency_axis(columns)});
        problem.product = FilledSpectrum();
        return tiling_of(problem).tile_shape();
    };
    EXPECT_EQ(tile(1000, 1000), (Shape{1, 1, 128, 128}));
    EXPECT_EQ(tile(100, 1000), (Shape{1, 1, 100, 128}));
    EXPECT_EQ(tile(1024, 300), (Shape{1, 1, 256, 256}));
    Problem line = spectrum(pga_axis(5000), number("frequency", 3));
    line.product = FilledSpectrum();
    EXPECT_EQ(tiling_of(line).tile_shape(), (Shape{256}));
}

std::vector<std::string> names_of_stored(const Problem& problem)
{
    std::vector<std::string> names;
    for (const StoredDimension& dimension : stored_dimensions(problem)) {
        names.push_back(dimension.name);
    }
    return names;
}

TEST(Boundary, StoresFlipsInPlaceOfTheStrength)
{
    Problem problem =
        problem_of_grid({}, {axis("slenderness", {0.1, 0.2}), number("restitution", 0.9),
                             pga_axis(100), frequency_axis(20)});
    EXPECT_EQ(stored_shape(problem), (Shape{2, 100, 20}));
    EXPECT_EQ(items_of(problem).count, 4000);
    EXPECT_STREQ(items_of(problem).name, "points");
    problem.product = Boundaries();
    EXPECT_EQ(names_of_stored(problem),
              (std::vector<std::string>{"slenderness", "crossing", "frequency"}));
    EXPECT_EQ(stored_shape(problem), (Shape{2, 64, 20}));
    EXPECT_EQ(items_of(problem).count, 40);
    EXPECT_STREQ(items_of(problem).name, "lines");
    // One line in a tile.
    EXPECT_EQ(tiling_of(problem).tile_shape(), (Shape{1, 64, 1}));
    EXPECT_EQ(tiling_of(problem).size(), 40);
}

TEST(Boundary, AlongAnotherQuantityStoresFlipsInPlaceOfThis)
{
    Problem problem =
        problem_of_grid({}, {axis("slenderness", {0.1, 0.2}), number("restitution", 0.9),
                             pga_axis(100), frequency_axis(20)});
    const Boundaries along{&quantity("slenderness")};
    problem.product = along;
    EXPECT_EQ(names_of_stored(problem), (std::vector<std::string>{"crossing", "pga", "frequency"}));
    EXPECT_EQ(stored_shape(problem), (Shape{64, 100, 20}));
    EXPECT_EQ(items_of(problem).count, 2000);
    EXPECT_EQ(boundary_fields(problem.scene, problem.grid, along),
              (std::vector<Field>{Field::flip_value, Field::region_below, Field::region_above}));
}

TEST(Boundary, UnderRecordsStoresMoreFlips)
{
    Problem problem = problem_of_grid(scene_of_three_records(),
                                      {axis("motion", {1, 2, 3}), pga_axis(100), number("size", 2),
                                       number("slenderness", 0.2), number("restitution", 0.9)});
    problem.product = Boundaries();
    EXPECT_EQ(stored_shape(problem), (Shape{3, 256}));
    EXPECT_EQ(tiling_of(problem).tile_shape(), (Shape{1, 256}));
    EXPECT_EQ(items_of(problem).count, 3);
}

TEST(Boundary, HasAPeakGroundAccelerationIfItIsGivenOrTheSizeIsKnown)
{
    const auto fields = [](const Problem& problem) {
        return boundary_fields(problem.scene, problem.grid);
    };
    const Given frequency = number("frequency", 3);
    const std::vector<Field> without{Field::flip_amplitude, Field::region_below,
                                     Field::region_above};
    std::vector<Field> with = without;
    with.push_back(Field::flip_pga);
    EXPECT_EQ(fields(spectrum(axis("amplitude", {1, 2}), frequency)), without);
    EXPECT_EQ(fields(spectrum(pga_axis(3), frequency)), with);
    EXPECT_EQ(
        fields(problem_of_grid({}, {axis("amplitude", {1, 2}), frequency, number("width", 0.4),
                                    number("height", 2), number("restitution", 0.9)})),
        with);
    with.insert(with.end(), {Field::unsafe_share, Field::undecided_share});
    EXPECT_EQ(fields(problem_of_grid(scene_of_three_records(),
                                     {number("motion", 1), axis("scale", {1, 2}), number("size", 2),
                                      number("slenderness", 0.2), number("restitution", 0.9)})),
              with);
}

TEST(ReasonNotToFill, IsAListARecordATableOrAnotherField)
{
    Problem problem = spectrum(pga_axis(100), frequency_axis(100));
    problem.fields = {Field::impacts, Field::region};
    EXPECT_THAT(reason_not_to_fill(problem), IsEmpty());
    problem.fields.push_back(Field::margin);
    EXPECT_THAT(reason_not_to_fill(problem), HasSubstr("\"margin\" cannot be filled"));
    EXPECT_THAT(reason_not_to_fill(spectrum(pga_axis(100), number("frequency", 3))), IsEmpty());
    EXPECT_THAT(reason_not_to_fill(spectrum(pga_axis(100), axis("frequency", {3}))), IsEmpty());
    EXPECT_THAT(reason_not_to_fill(spectrum(pga_axis(100), axis("frequency", {1, 2, 5}))),
                HasSubstr("plane.frequency lists its values"));
    EXPECT_THAT(reason_not_to_fill(problem_of_grid({}, {column("slenderness", {0.1, 0.3}),
                                                        number("restitution", 0.9), pga_axis(9),
                                                        frequency_axis(9)})),
                HasSubstr("have no neighbours"));
    EXPECT_THAT(
        reason_not_to_fill(problem_of_grid(
            scene_of_three_records(), {number("motion", 1), pga_axis(9), number("size", 2),
                                       number("slenderness", 0.2), number("restitution", 0.9)})),
        HasSubstr("under a record"));
}

} // namespace
} // namespace overturn
