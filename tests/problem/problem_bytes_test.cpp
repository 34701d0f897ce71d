#include "overturn/problem/problem_bytes.hpp"

#include "overturn/problem/coordinates.hpp"
#include "overturn/problem/pulse_table.hpp"
#include "overturn/text/mapped.hpp"
#include "support/given_values.hpp"
#include "support/short_records.hpp"

#include <gtest/gtest.h>

namespace overturn {
namespace {

const Quantities listed_block{number("width", 0.6), axis("height", {1.8, 2.5}),
                              number("restitution_of_maximum", 0.9)};

/// A problem of every kind.
std::vector<Problem> every_problem()
{
    const Quantities pulse =
        listed_block + Quantities{axis("pga", AxisRange{0.1, 2, 30, Spacing::log}),
                                  axis("pulse_period", {0.5, 1})};
    const Scene pulse_scene{.motion =
                                Pulse{PulseKind::mavroeidis_papageorgiou,
                                      {.window = 0.5, .cycles = 2, .gamma = 1.5, .nu = -0.25}},
                            .theory = Theory::linear,
                            .gravity = 1.62};
    const Scene records = scene_of_three_records();
    Scene vertical;
    vertical.motion = Suite{{short_record(0.5, 0.01, 0.25), short_record(0.5, 0.02, -0.25)}};
    Scene directions;
    directions.motion = Suite{{record_of_two_components(0.5, 0.01)}};
    Scene table;
    table.motion = pulse_of_table({0, 0.5, 2}, {1, -2, 0}).pulse;
    std::vector<Problem> problems{
        {.scene = table,
         .grid = grid_of(table, pulse),
         .numerics = {.method = Method::taylor},
         .fields = {Field::region}},
        {.scene = pulse_scene,
         .grid = grid_of(pulse_scene, pulse),
         .numerics = {.method = Method::taylor, .tolerance = 1e-6, .resolve = true},
         .fields = {{"margin", Precision::single_precision}, Field::region}},
        {.scene = {},
         .grid = grid_of({}, pulse),
         .product = FilledSpectrum{{}, 0.25},
         .fields = {Field::region, Field::evaluated}},
        {.scene = {},
         .grid = grid_of({}, pulse),
         .product = Boundaries(),
         .fields = boundary_fields({}, grid_of({}, pulse))},
        {.scene = {},
         .grid = grid_of({}, pulse),
         .product = Boundaries{&quantity("height")},
         .fields = boundary_fields({}, grid_of({}, pulse))},
        {.scene = {},
         .grid = grid_of({}, {number("slenderness", 0.2), number("restitution", 0.9),
                              number("amplitude", 2), number("frequency", 3)}),
         .fields = {Field::region}},
        {.scene = {},
         .grid = grid_of({}, listed_block + Quantities{column("pga", {0.5, 0.2}),
                                                       column("pulse_frequency", {3, 2})}),
         .fields = {Field::region}},
        {.scene = records,
         .grid = grid_of(records, listed_block + Quantities{axis("motion", {1, 2, 3}),
                                                            axis("scale", {1, 2, 3, 4})}),
         .numerics = {.method = Method::taylor, .resolve = true},
         .fields = {Field::region, Field::status}},
        {.scene = vertical,
         .grid = grid_of(vertical, listed_block + Quantities{column("motion", {2, 1, 2}),
                                                             column("scale", {1, 0.5, 1.5})}),
         .numerics = {.method = Method::taylor},
         .fields = {Field::peak}},
        {.scene = directions,
         .grid =
             grid_of(directions, listed_block + Quantities{number("motion", 1), number("scale", 1),
                                                           axis("direction", {0, 30})}),
         .fields = {Field::region}}};
    return problems;
}

TEST(ProblemBytes, OfAnEqualProblemAreEqual)
{
    std::vector<std::string> all;
    for (const Problem& problem : every_problem()) {
        const std::string bytes = bytes_of(problem);
        EXPECT_EQ(bytes_of(problem_of(bytes)), bytes) << all.size();
        EXPECT_EQ(std::count(all.begin(), all.end(), bytes), 0) << "two problems have these bytes";
        all.push_back(bytes);
    }
}

void expect_equal(const Scene& one, const Scene& other)
{
    ASSERT_EQ(one.motion.index(), other.motion.index());
    if (const Pulse* pulse = one.pulse()) {
        EXPECT_EQ(pulse->kind, other.pulse()->kind);
        EXPECT_EQ(pulse->named()->numbers, other.pulse()->named()->numbers);
    }
    EXPECT_EQ(one.theory, other.theory);
    EXPECT_EQ(one.gravity, other.gravity);
    ASSERT_EQ(one.records().size(), other.records().size());
    for (std::size_t i = 0; i < one.records().size(); ++i) {
        EXPECT_EQ(one.records()[i]->horizontal(), other.records()[i]->horizontal());
        EXPECT_EQ(one.records()[i]->upwards(), other.records()[i]->upwards());
        EXPECT_EQ(one.records()[i]->second(), other.records()[i]->second());
        EXPECT_EQ(one.records()[i]->time_step(), other.records()[i]->time_step());
        EXPECT_EQ(one.records()[i]->phases(), other.records()[i]->phases());
    }
}

void expect_equal(const Numerics& one, const Numerics& other)
{
    EXPECT_EQ(one.method, other.method);
    EXPECT_EQ(one.tolerance, other.tolerance);
    EXPECT_EQ(one.resolve, other.resolve);
}

TEST(ProblemBytes, KeepEverything)
{
    for (const Problem& problem : every_problem()) {
        const Problem received = problem_of(bytes_of(problem));
        expect_equal(received.scene, problem.scene);
        expect_equal(received.numerics, problem.numerics);
        EXPECT_EQ(received.product.audit(), problem.product.audit());
        EXPECT_EQ(received.product, problem.product);
        EXPECT_EQ(received.fields, problem.fields);
        EXPECT_EQ(mapped(received.fields, &Field::precision),
                  mapped(problem.fields, &Field::precision));
        EXPECT_EQ(stored_shape(received), stored_shape(problem));
        EXPECT_EQ(tiling_of(received).tile_shape(), tiling_of(problem).tile_shape());
        EXPECT_EQ(received.grid.table() != nullptr, problem.grid.table() != nullptr);
        const Coordinates coordinates(problem.scene, problem.grid);
        const Coordinates same(received.scene, received.grid);
        for (const Quantity& each : all_quantities()) {
            ASSERT_EQ(same.has(each.name), coordinates.has(each.name)) << each.name;
            if (same.has(each.name)) {
                EXPECT_EQ(same.dimensions_of(each.name), coordinates.dimensions_of(each.name));
                EXPECT_EQ(same.of(each.name).values, coordinates.of(each.name).values);
            }
        }
    }
}

TEST(ProblemBytes, KeepRangesAsRanges)
{
    const Problem received = problem_of(bytes_of(every_problem()[1]));
    const Axis& pga = received.grid.find("pga")->values;
    ASSERT_TRUE(pga.is_range());
    EXPECT_EQ(std::get<AxisRange>(pga.definition()).spacing, Spacing::log);
    EXPECT_FALSE(received.grid.find("pulse_period")->values.is_range());
}

} // namespace
} // namespace overturn
