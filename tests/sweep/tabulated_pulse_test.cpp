// Pulses that are given by a table: those that sample another pulse, invariance, and more digits.
#include "overturn/integrate/more_digits.hpp"
#include "overturn/problem/pulse_table.hpp"
#include "overturn/sweep/boundary.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "overturn/sweep/history.hpp"
#include "point_run.hpp"
#include "support/every_kernel.hpp"
#include "support/given_values.hpp"
#include "support/observed_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <random>

namespace overturn {
namespace {

constexpr std::array theories{Theory::nonlinear, Theory::linear};

/// The rows of a table.
struct Rows {
    std::vector<double> times; ///< over the period
    std::vector<double> values;

    Scene scene(Theory theory = Theory::nonlinear) const
    {
        return {.motion = pulse_of_table(times, values).pulse, .theory = theory};
    }
};

const Rows triangle{{0, 0.25, 0.5}, {0, 3, 0}};
const Rows rectangle{{1, 1.5}, {-2, -2}}; // mirrored

Scene scene_of(PulseKind pulse, Theory theory = Theory::nonlinear)
{
    return {.motion = Pulse{pulse}, .theory = theory};
}

/// The formula of a pulse at evenly spaced phases.
Rows sampled(PulseKind pulse, int intervals)
{
    const PulseMotion<double> motion = pulse_motion<double>(pulse, {});
    Rows rows;
    for (int i = 0; i <= intervals; ++i) {
        const double phase = motion.begin + (motion.end - motion.begin) * i / intervals;
        rows.times.push_back(phase / (2 * pi<double>()));
        rows.values.push_back(motion.with_formula([&](const auto& f) { return f.value(phase); }));
    }
    return rows;
}

/// Rows at random times with random values.
Rows random_rows(std::mt19937_64& generator, int size)
{
    std::uniform_real_distribution<double> uniform(-1, 1);
    Rows rows;
    double time = uniform(generator);
    double value = 0;
    for (int i = 0; i < size; ++i) {
        rows.times.push_back(time);
        rows.values.push_back(value);
        time += 1e-3 + 2.0 / size * std::abs(uniform(generator));
        value = 0.7 * value + uniform(generator);
    }
    return rows;
}

const Quantities blocks_and_pulses{
    axis("slenderness", {0.12, 0.3}), axis("restitution_of_maximum", {0.6, 1.0}),
    axis("amplitude", AxisRange{0.9, 12.0, 13}), axis("frequency", AxisRange{0.3, 9.0, 21})};
const Numerics resolved{.method = Method::taylor, .tolerance = 1e-4, .resolve = true};
const std::vector<Field> margin_and_error{Field::region, Field::margin, Field::error};

using Values = std::map<std::string_view, std::vector<double>>;

/// The fields of all points by name. side: of the tiles.
Values values_of(const Problem& problem, Kernel kernel = widest_kernel(), std::int64_t side = 64)
{
    const Tiling tiling(stored_shape(problem), Shape(problem.grid.dimensions.size(), side));
    Values all;
    for (std::int64_t n = 0; n < tiling.size(); ++n) {
        const TileFields fields = compute_tile(problem, tiling[n], kernel);
        for (std::size_t f = 0; f < problem.fields.size(); ++f) {
            std::visit(
                [&](const auto& values) {
                    auto& list = all[problem.fields[f].name];
                    list.insert(list.end(), values.begin(), values.end());
                },
                fields.values[f]);
        }
    }
    return all;
}

Values values_under(const Scene& scene, const Quantities& quantities = blocks_and_pulses,
                    const std::vector<Field>& fields = margin_and_error,
                    const Numerics& numerics = resolved)
{
    return values_of({.scene = scene,
                      .grid = grid_of(scene, quantities),
                      .numerics = numerics,
                      .fields = fields});
}

/// Margins differ by the bounds of both errors, and by what the roundings of the rows do.
void expect_equal_verdicts(const Values& one, const Values& other, double roundings)
{
    ASSERT_EQ(one.at("region"), other.at("region"));
    std::vector<double> regions = one.at("region");
    std::ranges::sort(regions);
    EXPECT_GE(std::unique(regions.begin(), regions.end()) - regions.begin(), 3);
    for (std::size_t i = 0; i < one.at("margin").size(); ++i) {
        const double bound = one.at("error")[i] + other.at("error")[i] + roundings;
        ASSERT_NEAR(one.at("margin")[i], other.at("margin")[i], bound) << i;
    }
}

// A table of another duration, peak or beginning would have other verdicts at most points.
constexpr double of_roundings = 1e-11; // 1e-15 of the phases and values, amplified by impacts

TEST(TabulatedPulse, OfStraightLinesIsThePulseOfTheseLines)
{
    const auto mirrored = blocks_and_pulses + Quantities{number("direction", 180)};
    for (const Theory theory : theories) {
        expect_equal_verdicts(values_under(triangle.scene(theory)),
                              values_under(scene_of(PulseKind::triangular, theory)), of_roundings);
        expect_equal_verdicts(values_under(rectangle.scene(theory)),
                              values_under(scene_of(PulseKind::rectangular, theory), mirrored),
                              of_roundings);
    }
}

TEST(TabulatedPulse, HasThePeaksAndTheFallTimesOfThePulseOfTheseLines)
{
    const std::vector<Field> fields{Field::peak, Field::fall_time, Field::angle};
    const Values table = values_under(triangle.scene(), blocks_and_pulses, fields);
    const Values pulse = values_under(scene_of(PulseKind::triangular), blocks_and_pulses, fields);
    for (const auto& [name, values] : table) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double expected = pulse.at(name)[i];
            ASSERT_TRUE(values[i] == expected || std::abs(values[i] - expected) < of_roundings)
                << name << i << ": " << values[i] << ", " << expected;
        }
    }
}

TEST(TabulatedPulse, HasTheContactOfThePulseOfTheseLines)
{
    const std::vector<Field> fields{Field::region, Field::friction_demand, Field::normal};
    const Values table = values_under(triangle.scene(), blocks_and_pulses, fields);
    const Values pulse = values_under(scene_of(PulseKind::triangular), blocks_and_pulses, fields);
    for (const auto& [name, values] : table) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double expected = pulse.at(name)[i];
            // Both look for the extremes between two steps to a part in a thousand.
            ASSERT_TRUE(values[i] == expected || std::abs(values[i] / expected - 1) < 1e-3)
                << name << i << ": " << values[i] << ", " << expected;
        }
    }
}

TEST(TabulatedPulse, HasTheVerdictsOfThePulseThatItSamples)
{
    for (const Theory theory : theories) {
        const Values table = values_under(sampled(PulseKind::symmetric_ricker, 3999).scene(theory));
        const Values pulse = values_under(scene_of(PulseKind::symmetric_ricker, theory));
        int compared = 0;
        for (std::size_t i = 0; i < pulse.at("region").size(); ++i) {
            if (std::abs(pulse.at("margin")[i]) > 1e-4) {
                ++compared;
                ASSERT_EQ(is_safe(Region(table.at("region")[i])),
                          is_safe(Region(pulse.at("region")[i])))
                    << i;
            }
        }
        EXPECT_GT(compared, 1080); // of 1092
    }
}

TEST(TabulatedPulse, ApproachesThePulseThatItSamplesWithOrderTwo)
{
    const Quantities point{number("slenderness", 0.2), number("restitution", 0.8),
                           number("amplitude", 2), axis("frequency", {1.5, 3.0, 6.0})};
    const Values exact = values_under(scene_of(PulseKind::one_sine), point);
    const auto error = [&](int intervals) {
        const Values values = values_under(sampled(PulseKind::one_sine, intervals).scene(), point);
        double largest = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            largest = std::max(largest, std::abs(values.at("margin")[i] - exact.at("margin")[i]));
        }
        return largest;
    };
    // The peak of the table, a sample, is that of the sine; a shape that is held constant between
    // rows would have order 1.
    EXPECT_NEAR(observed_order({32, 64, 128, 256, 512}, error), 2.0, 0.1);
}

TEST(TabulatedPulse, DoesNotDependOnRowsOnItsLines)
{
    Rows more{{0}, {0}};
    for (const double time : {0.001, 0.1, 0.11, 0.2499, 0.25}) {
        more.times.push_back(time);
        more.values.push_back(4 * time);
    }
    for (const double time : {0.3, 0.4999, 0.5}) {
        more.times.push_back(time);
        more.values.push_back(4 * (0.5 - time));
    }
    expect_equal_verdicts(values_under(more.scene()), values_under(triangle.scene()), of_roundings);
}

TEST(TabulatedPulse, DoesNotDependOnItsBeginningAndItsUnit)
{
    // Powers of two and their sums: nothing is rounded.
    const Rows rows{{0, 0.125, 0.5, 0.625, 2}, {0.5, 1, -0.75, 0.25, 0}};
    Rows other = rows;
    std::ranges::for_each(other.times, [](double& time) { time += 32; });
    std::ranges::for_each(other.values, [](double& value) { value *= 8; });
    EXPECT_EQ(values_under(rows.scene()), values_under(other.scene()));
}

TEST(TabulatedPulse, MirroredIsTheMotionInTheOppositeDirection)
{
    std::mt19937_64 generator(71);
    const Rows rows = random_rows(generator, 30);
    Rows mirrored = rows;
    std::ranges::for_each(mirrored.values, [](double& value) { value = -value; });
    const std::vector<Field> fields{Field::angle, Field::margin, Field::peak};
    EXPECT_EQ(values_under(mirrored.scene(), blocks_and_pulses, fields),
              values_under(rows.scene(), blocks_and_pulses + Quantities{number("direction", 180)},
                           fields));
}

TEST(TabulatedPulse, HasTheSameBitsWithEveryKernelAndTile)
{
    std::mt19937_64 generator(72);
    const std::vector<Field> fields{Field::region,  Field::angle, Field::velocity,
                                    Field::margin,  Field::error, Field::peak,
                                    Field::impacts, Field::steps, Field::status};
    for (const Theory theory : theories) {
        const Scene scene = random_rows(generator, 57).scene(theory);
        for (const Numerics& numerics :
             {Numerics{.method = Method::taylor, .tolerance = 1e-9}, resolved}) {
            Problem problem{.scene = scene,
                            .grid = grid_of(scene, blocks_and_pulses),
                            .numerics = numerics,
                            .fields = fields};
            if (has_contact_forces(theory)) {
                problem.fields.push_back(Field::friction_demand);
            }
            const auto bits_of = [&](Kernel kernel, std::int64_t side) {
                std::map<std::string_view, std::vector<std::uint64_t>> bits;
                for (const auto& [name, values] : values_of(problem, kernel, side)) {
                    for (const double value : values) {
                        bits[name].push_back(std::bit_cast<std::uint64_t>(value));
                    }
                    if (side != 64) { // in another order
                        std::ranges::sort(bits[name]);
                    }
                }
                return bits;
            };
            auto expected = bits_of(every_kernel().front(), 64);
            for (const Kernel kernel : every_kernel()) {
                EXPECT_EQ(bits_of(kernel, 64), expected) << name_of(kernel);
            }
            for (auto& [name, values] : expected) {
                std::ranges::sort(values);
            }
            EXPECT_EQ(bits_of(widest_kernel(), 5), expected);
        }
    }
}

TEST(TabulatedPulse, IsAsAccurateAsItsErrorBoundSays)
{
    std::mt19937_64 generator(73);
    const Scene scene = random_rows(generator, 40).scene();
    const Grid grid = grid_of(scene, {number("slenderness", 0.2), number("restitution", 0.8),
                                      axis("amplitude", AxisRange{1.5, 6.0, 5}),
                                      axis("frequency", AxisRange{0.8, 5.0, 5})});
    const PointRun run(scene, Coordinates(scene, grid).points(), widest_kernel());
    const Outcomes doubles =
        outcomes_of(run, {.method = Method::taylor}, {.error = true, .margin = true});
    Outcomes exact(run.size(), {.margin = true});
    Outcomes in_31_digits(run.size(), {.error = true, .margin = true});
    run.run_in_31_digits(in_31_digits, run.all());
    for (int i = 0; i < run.size(); ++i) {
        run.run_in_more_digits<Digits50>(i, exact);
        EXPECT_NEAR(doubles[i].margin, exact[i].margin, doubles[i].error) << i;
        EXPECT_LT(doubles[i].error, 1e-6) << i;
        // One rounding of the margin, and its difference.
        EXPECT_NEAR(in_31_digits[i].margin, exact[i].margin, 0x1p-50) << i;
    }
}

TEST(TabulatedPulse, LiftsFromTheAccelerationOfItsLargestLobes)
{
    // Its peak pushes towards minus, three quarters of it towards plus.
    const Scene scene = Rows{{0, 0.25, 0.5, 0.75}, {0, 4, -3, 0}}.scene();
    const Grid grid = grid_of(scene, {number("width", 0.5), number("height", 2),
                                      number("incline", 0.05), number("restitution", 0.8),
                                      number("pga", 0.3), number("pulse_period", 0.5)});
    const Point point = Coordinates(scene, grid).points().front();
    const double plus = std::tan(point.block.slenderness);
    const double minus = std::tan(point.block.other.slenderness);
    ASSERT_LT(plus, 0.75 * minus);
    EXPECT_NEAR(pga_of_unit(scene, point), plus, 1e-15);
    EXPECT_NEAR(lifting_pga(scene, point), std::min(plus / 0.75, minus), 1e-15);
    const PointRun run(scene, {point}, widest_kernel());
    EXPECT_NEAR(run.point(0).amplitude, 0.3 / plus, 1e-15);
}

TEST(TabulatedPulse, MovesABlockWithTwoSidesAsThePulseOfTheseLinesDoes)
{
    const Quantities leaning{number("width", 0.5),
                             number("height", 2),
                             number("incline", 0.07),
                             number("restitution_of_maximum", 0.95),
                             axis("direction", {0, 180}),
                             axis("pga", AxisRange{0.1, 2, 20}),
                             axis("pulse_period", AxisRange{0.2, 2, 20})};
    expect_equal_verdicts(values_under(triangle.scene(), leaning),
                          values_under(scene_of(PulseKind::triangular), leaning), of_roundings);
}

TEST(TabulatedPulse, LetsABlockSlipAsThePulseOfTheseLinesDoes)
{
    const Quantities slipping{number("width", 0.5),
                              number("height", 2),
                              number("restitution_of_maximum", 0.95),
                              axis("friction", {0.2, 0.4}),
                              axis("pga", AxisRange{0.1, 2, 12}),
                              axis("pulse_period", AxisRange{0.2, 2, 10})};
    const std::vector<Field> fields{Field::region, Field::slide, Field::slide_peak};
    const Values table = values_under(triangle.scene(), slipping, fields);
    const Values pulse = values_under(scene_of(PulseKind::triangular), slipping, fields);
    EXPECT_EQ(table.at("region"), pulse.at("region"));
    int slid = 0;
    for (std::size_t i = 0; i < pulse.at("slide").size(); ++i) {
        // Runs with a tolerance of 1e-12 per step, whose errors the slip does not amplify much.
        EXPECT_NEAR(table.at("slide")[i], pulse.at("slide")[i], 1e-7) << i;
        EXPECT_NEAR(table.at("slide_peak")[i], pulse.at("slide_peak")[i], 1e-7) << i;
        slid += std::abs(pulse.at("slide")[i]) > 1e-3;
    }
    EXPECT_GT(slid, 50);
}

TEST(TabulatedPulse, FlipsWhereThePulseOfTheseLinesDoes)
{
    const BoundaryLine line{.point = {{0.1745716, 0.85}, 1, 3}};
    const std::vector<double> scan = Axis(AxisRange{0.5, 16, 80}).values();
    const auto flips = [&](const Scene& scene) {
        return boundary_on(scene, line, scan, widest_kernel()).flips;
    };
    for (const Theory theory : theories) {
        const auto table = flips(triangle.scene(theory));
        const auto pulse = flips(scene_of(PulseKind::triangular, theory));
        ASSERT_EQ(table.size(), pulse.size());
        ASSERT_FALSE(table.empty());
        for (std::size_t i = 0; i < table.size(); ++i) {
            // Either flip is known to 1e-12 of its size.
            EXPECT_NEAR(table[i].value() / pulse[i].value(), 1, 4e-12);
            EXPECT_EQ(table[i].region_above, pulse[i].region_above);
        }
    }
}

TEST(TabulatedPulse, HasTheHistoryOfThePulseOfTheseLines)
{
    const Point point{.block = {0.1745716, 0.9}, .amplitude = 1.8, .frequency = 2};
    const auto history = [&](const Scene& scene) {
        return history_of(scene, point, {.until = 6, .samples = 100});
    };
    const History table = history(triangle.scene());
    const History pulse = history(scene_of(PulseKind::triangular));
    EXPECT_NEAR(table.end_of_pulse, pi<double>() / 2, 1e-15);
    ASSERT_EQ(table.samples.size(), pulse.samples.size());
    for (std::size_t i = 0; i < table.samples.size(); ++i) {
        const HistorySample& one = table.samples[i];
        const HistorySample& other = pulse.samples[i];
        EXPECT_NEAR(one.time, other.time, of_roundings);
        EXPECT_NEAR(one.angle, other.angle, of_roundings);
        EXPECT_NEAR(one.velocity, other.velocity, of_roundings);
        EXPECT_NEAR(one.ground, other.ground, of_roundings);
    }
}

} // namespace
} // namespace overturn
