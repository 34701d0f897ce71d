// Blocks with two different sides through the forced stage: kernels, error bounds and flips.
#include "support/two_sides.hpp"

#include "overturn/integrate/more_digits.hpp"
#include "overturn/mechanics/free_rocking.hpp"
#include "overturn/sweep/boundary.hpp"
#include "point_run.hpp"
#include "support/every_scene.hpp"
#include "support/random_record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace overturn {
namespace {

double least_threshold(Theory theory, const Block<double>& block)
{
    return uplift_threshold(theory, std::min(block.slenderness, block.other.slenderness));
}

/// A body under a pulse of this period [s].
BoundaryLine line_of(const Scene& scene, const Body& body, double period, double direction)
{
    const Block<double> block = body.block(body.largest_restitution());
    return {.point = {block, 1, 2 * pi<double>() / period},
            .unit = direction * least_threshold(scene.theory, block)};
}

std::vector<double> accelerations(double last)
{
    return Axis(AxisRange{0.01, last, 300}).values();
}

void expect_flips(const Boundary& boundary, const std::vector<std::pair<double, Region>>& expected,
                  double tolerance)
{
    ASSERT_EQ(boundary.flips.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(boundary.flips[i].value(), expected[i].first, tolerance);
        EXPECT_EQ(boundary.flips[i].region_above, expected[i].second);
    }
}

TEST(TwoSides, FlipAtTheAccelerationsOfAnIndependentIntegration)
{
    // Twelve digits each, of the verdicts of other programs.
    const Scene one_sine;
    const auto flips = [&](const Body& body, double direction) {
        return boundary_on(one_sine, line_of(one_sine, body, 0.5, direction), accelerations(3),
                           widest_kernel());
    };
    expect_flips(flips(leaning_box, 1), {{0.407515258023, Region::U0_plus}}, 1e-11);
    expect_flips(flips(leaning_box, -1),
                 {{0.620924782649, Region::U2_plus},
                  {0.891748873204, Region::S_minus},
                  {1.173623183158, Region::U0_plus}},
                 1e-11);
    expect_flips(flips(eccentric_body, 1),
                 {{0.686360312579, Region::U2_minus},
                  {1.022079907029, Region::S_plus},
                  {1.324864005712, Region::U0_minus}},
                 1e-11);
    expect_flips(flips(eccentric_body, -1), {{0.418905920675, Region::U0_minus}}, 1e-11);
}

TEST(TwoSides, FlipUnderARectangularPulseAtTheClosedForm)
{
    // Linear theory, no impact: A = alpha / (1 - exp(-p t_d)), here on the side minus.
    const Scene scene{Pulse{PulseKind::rectangular}, Theory::linear};
    const Block<double> block = eccentric_body.block(0.8);
    const double duration = 0.2;
    const double expected =
        block.other.slenderness / (1 - std::exp(-block.other.frequency_parameter * duration));
    EXPECT_NEAR(expected, 0.4759132, 5e-8);
    const Boundary boundary = boundary_on(scene, line_of(scene, eccentric_body, 2 * duration, 1),
                                          accelerations(1), widest_kernel());
    expect_flips(boundary, {{expected, Region::U0_minus}}, 1e-12);
}

/// Points of random bodies under a scene, with up to about five times the least uplift.
std::vector<Point> random_points(const Scene& scene, std::mt19937_64& generator, int count)
{
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<Point> points;
    for (int i = 0; i < count; ++i) {
        const Body body = random_body(generator);
        const double r =
            std::min(1.0, (0.6 + 0.5 * uniform(generator)) * body.largest_restitution());
        const Block<double> block = body.block(r);
        const double sign = uniform(generator) < 0.5 ? -1 : 1;
        const double strength = 1.05 + 5 * uniform(generator) * uniform(generator);
        if (scene.is_under(Under::record)) {
            const Accelerogram& record = *scene.records().front();
            points.push_back(
                {block, sign * strength * least_threshold(scene.theory, block) / record.peak(),
                 1 / (0.02 + 0.05 * uniform(generator))});
        } else {
            points.push_back(
                {block, sign * strength, 2 * pi<double>() / (0.2 + 1.5 * uniform(generator))});
        }
    }
    return points;
}

/// The block and the motion mirrored.
std::vector<Point> mirrored(std::vector<Point> points)
{
    for (Point& point : points) {
        point.block = point.block.turned();
        point.amplitude = -point.amplitude;
    }
    return points;
}

constexpr Outputs all_outputs{
    .impacts = true, .error = true, .region = true, .margin = true, .steps = true, .phase = true};

Scene scene_of_random_record(Theory theory, std::mt19937_64& generator, Directions directions)
{
    Scene scene;
    scene.theory = theory;
    Accelerogram record = random_record(generator, 120, directions);
    std::vector<double> upwards = record.upwards();
    for (double& v : upwards) { // gravity never vanishes
        v *= 0.1;
    }
    scene.motion =
        Suite{{std::make_shared<const Accelerogram>(record.horizontal(), upwards, 0.02)}};
    return scene;
}

std::vector<Scene> scenes(std::mt19937_64& generator)
{
    std::vector<Scene> all = every_scene();
    for (const Theory theory : {Theory::nonlinear, Theory::linear}) {
        for (const Directions directions : {Directions::horizontal, Directions::both}) {
            all.push_back(scene_of_random_record(theory, generator, directions));
        }
    }
    return all;
}

std::vector<Numerics> numerics_for(const Scene& scene)
{
    std::vector<Numerics> all{{Method::taylor, 1e-6}, {Method::taylor, 1e-10}};
    if (!scene.is_under(Under::record)) {
        all.push_back({Method::rk45, 1e-8});
    }
    return all;
}

/// The end state of a block under a record of this many samples, with more digits than the result.
Outcomes end_under(Theory theory, const Accelerogram& record, std::size_t samples,
                   const Point& point)
{
    const auto first = [&](const std::vector<double>& values) {
        return std::vector<double>(values.begin(), values.begin() + std::ptrdiff_t(samples));
    };
    Scene scene{.theory = theory};
    scene.motion = Suite{{std::make_shared<const Accelerogram>(
        first(record.horizontal()), first(record.upwards()), record.time_step())}};
    Outcomes outcomes(1, all_outputs);
    PointRun(scene, {point}, widest_kernel()).run_in_31_digits(outcomes, {0});
    return outcomes;
}

/// A constant acceleration a, with a vertical one v, turns gravity by phi: the base is inclined by
/// -phi to it. Nonlinear: tan phi = a / (1 + v), linear: phi = a / (1 + v).
template <Theory theory>
void expect_turned_gravity()
{
    std::mt19937_64 generator(55);
    std::uniform_real_distribution<double> uniform(0, 1);
    int without = 0;
    int with_impact = 0;
    for (int i = 0; i < 1500; ++i) {
        const Body body = random_body(generator);
        const Block<double> block = body.block(0.7 * body.largest_restitution());
        const Accelerogram shaken = random_record(generator, 12, Directions::both);
        std::vector<double> horizontal = shaken.horizontal();
        std::vector<double> upwards = shaken.upwards();
        const double scale =
            (1 + 3 * uniform(generator)) * least_threshold(theory, block) / shaken.peak();
        std::transform(upwards.begin(), upwards.end(), upwards.begin(),
                       [&](double v) { return 0.3 / scale * v / shaken.upwards_peak(); });
        std::fill(horizontal.begin() + 6, horizontal.end(), horizontal[6] / 8);
        std::fill(upwards.begin() + 6, upwards.end(), upwards[6]);
        const double time_step = 0.02 + 0.06 * uniform(generator);
        const Accelerogram record(horizontal, upwards, time_step);
        const Point point{block, scale, 1 / time_step};
        const Outcomes begin = end_under(theory, record, 7, point);
        const Outcomes end = end_under(theory, record, 12, point);
        if (!(begin[0].tilt > 0) || ((begin[0].flags | end[0].flags) & outcome_flag::fell)) {
            continue;
        }
        const double a = scale * horizontal[6];
        const double down = 1 + scale * upwards[6];
        const bool linear = theory == Theory::linear;
        const double gravity = linear ? down : std::hypot(a, down);
        Body inclined = body;
        inclined.incline -= linear ? a / down : std::atan2(a, down);
        const Block<Digits50> other = block_in<Digits50>(
            seen_from(begin[0].side, inclined.block(block.restitution, 9.81 * gravity)));
        FreeRocking<theory, Digits50> rocking(
            State<Digits50>{begin[0].tilt, begin[0].rate / std::sqrt(gravity), begin[0].side},
            other);
        const Digits50 duration = 5 / Digits50(point.frequency);
        const bool strikes = rocking.impact_time() < duration;
        double speed = 1;
        if (strikes) {
            speed = double(rocking.arc().impact_speed()) / block.slenderness;
            rocking.strike();
        }
        if (rocking.impact_time() < duration || speed < 0.01) {
            continue;
        }
        const State<Digits50> state = rocking.at(duration);
        ASSERT_EQ(end[0].impacts, begin[0].impacts + strikes);
        // Roundings of the beginning, which grow e-fold in 1/p, at most e^2, and by the impact.
        const double tolerance = 1e-13 / std::min(speed, 1.0);
        EXPECT_NEAR(end[0].tilt, double(state.tilt), tolerance);
        EXPECT_NEAR(end[0].rate, double(state.rate) * std::sqrt(gravity), tolerance);
        EXPECT_EQ(end[0].side, double(state.side));
        ++(strikes ? with_impact : without);
    }
    EXPECT_GT(without, 100);
    EXPECT_GT(with_impact, 100);
}

TEST(TwoSides, MoveUnderAConstantAccelerationLikeABlockOnAnotherIncline)
{
    expect_turned_gravity<Theory::nonlinear>();
    expect_turned_gravity<Theory::linear>();
}

Region mirrored(Region region)
{
    const auto code = int(region);
    return code == 0 || code > 10 ? region : Region(code % 2 == 1 ? code + 1 : code - 1);
}

TEST(TwoSides, AreMirroredBitByBit)
{
    std::mt19937_64 generator(50);
    for (const Scene& scene : scenes(generator)) {
        const std::vector<Point> points = random_points(scene, generator, 60);
        for (const Numerics& numerics : numerics_for(scene)) {
            const auto outcomes = [&](const std::vector<Point>& of) {
                return outcomes_of(PointRun(scene, of, widest_kernel()), numerics, all_outputs);
            };
            const Outcomes one = outcomes(points);
            const Outcomes other = outcomes(mirrored(points));
            for (std::size_t i = 0; i < points.size(); ++i) {
                EXPECT_EQ(one[i].tilt, other[i].tilt);
                EXPECT_EQ(one[i].rate, other[i].rate);
                EXPECT_EQ(one[i].margin, other[i].margin);
                EXPECT_EQ(one[i].error, other[i].error);
                EXPECT_EQ(one[i].steps, other[i].steps);
                EXPECT_EQ(one[i].region, mirrored(other[i].region));
            }
        }
    }
}

TEST(TwoSides, HaveEqualBitsInEveryKernelAndBesideEveryNeighbour)
{
    std::mt19937_64 generator(51);
    for (const Scene& scene : scenes(generator)) {
        std::vector<Point> points = random_points(scene, generator, 40);
        for (std::size_t i = 0; i < points.size(); i += 3) { // symmetric neighbours
            const Block<double>& block = points[i].block;
            points[i].frequency /= block.frequency_parameter;
            points[i].block = {block.slenderness, block.restitution};
        }
        for (const Numerics& numerics : numerics_for(scene)) {
            const auto outcomes = [&](const std::vector<Point>& of, Kernel kernel) {
                return outcomes_of(PointRun(scene, of, kernel), numerics, all_outputs);
            };
            const Outcomes together = outcomes(points, widest_kernel());
            if (runs_here(Kernel::one_lane)) {
                const Outcomes one_by_one = outcomes(points, Kernel::one_lane);
                for (std::size_t i = 0; i < points.size(); ++i) {
                    EXPECT_EQ(together[i].rate, one_by_one[i].rate);
                    EXPECT_EQ(together[i].margin, one_by_one[i].margin);
                    EXPECT_EQ(together[i].error, one_by_one[i].error);
                }
            }
            for (std::size_t i = 0; i < points.size(); ++i) {
                const Outcomes alone = outcomes({points[i]}, widest_kernel());
                ASSERT_EQ(alone[0].rate, together[i].rate);
                ASSERT_EQ(alone[0].error, together[i].error);
            }
        }
    }
}

TEST(TwoSides, HaveErrorsWithinTheirBounds)
{
    std::mt19937_64 generator(52);
    int known = 0;
    int exceeded = 0;
    int all = 0;
    for (const Scene& scene : scenes(generator)) {
        const std::vector<Point> points = random_points(scene, generator, 12);
        const PointRun run(scene, points, widest_kernel());
        Outcomes exact(run.size(), all_outputs);
        for (const int point : run.all()) {
            run.run_in_more_digits<Digits50>(point, exact);
        }
        for (const Numerics& numerics : numerics_for(scene)) {
            const Outcomes found = outcomes_of(run, numerics, all_outputs);
            for (std::size_t i = 0; i < points.size(); ++i) {
                ++all;
                if (!std::isfinite(found[i].error) || !(exact[i].error < 1e-12)) {
                    continue;
                }
                ++known;
                exceeded +=
                    std::abs(found[i].margin - exact[i].margin) > found[i].error + exact[i].error;
                if (found[i].error < std::abs(found[i].margin)) {
                    EXPECT_EQ(is_safe(found[i].region), is_safe(exact[i].region));
                }
            }
        }
    }
    EXPECT_GT(known, all / 2);
    EXPECT_EQ(exceeded, 0);
}

TEST(TwoSides, AreResolved)
{
    std::mt19937_64 generator(53);
    const Scene one_sine;
    const Boundary flips = boundary_on(one_sine, line_of(one_sine, leaning_box, 0.5, -1),
                                       accelerations(3), widest_kernel());
    ASSERT_EQ(flips.flips.size(), 3u);
    const BoundaryLine line = line_of(one_sine, leaning_box, 0.5, -1);
    std::vector<Point> points;
    for (const Flip& flip : flips.flips) { // neighbouring doubles, and a little more
        for (const double acceleration : {flip.below, flip.above, flip.below * (1 - 1e-9)}) {
            points.push_back(line.point);
            points.back().amplitude = acceleration / line.unit;
        }
    }
    const Outcomes outcomes = outcomes_of(PointRun(one_sine, points, widest_kernel()),
                                          {Method::taylor, 1e-4, true}, {.region = true});
    for (std::size_t i = 0; i < flips.flips.size(); ++i) {
        EXPECT_EQ(outcomes[3 * i].region, flips.flips[i].region_below);
        EXPECT_EQ(outcomes[3 * i + 1].region, flips.flips[i].region_above);
        EXPECT_EQ(outcomes[3 * i + 2].region, flips.flips[i].region_below);
    }
}

TEST(TwoSides, ThatAreEqualMoveLikeASymmetricBlock)
{
    // A body whose corners differ by a few roundings takes the general path.
    std::mt19937_64 generator(54);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const Scene& scene : every_scene()) {
        std::vector<Point> general;
        std::vector<Point> symmetric;
        for (int i = 0; i < 20; ++i) {
            const double b = 0.1 + 0.3 * uniform(generator);
            const double r = 0.6 + 0.3 * uniform(generator);
            const Body box{b, b * (1 + 1e-14), 1, std::sqrt((1 + b * b) / 3)};
            const Block<double> block = box.block(r);
            ASSERT_FALSE(block.is_symmetric());
            const double amplitude = 1.1 + 3 * uniform(generator);
            const double rate = 2 * pi<double>() / (0.3 + uniform(generator));
            general.push_back({block, amplitude, rate});
            symmetric.push_back(
                {{block.slenderness, r}, amplitude, rate / block.frequency_parameter});
        }
        const Numerics accurate{Method::taylor, 1e-13};
        const Outcomes one =
            outcomes_of(PointRun(scene, general, widest_kernel()), accurate, all_outputs);
        const Outcomes other =
            outcomes_of(PointRun(scene, symmetric, widest_kernel()), accurate, all_outputs);
        for (std::size_t i = 0; i < general.size(); ++i) {
            // A change of the block by a few roundings has less effect than those of the steps.
            const double allowed = 8 * (one[i].error + other[i].error);
            EXPECT_LE(std::abs(one[i].margin - other[i].margin), allowed);
            if (allowed < std::abs(one[i].margin)) {
                EXPECT_EQ(one[i].region, other[i].region);
                EXPECT_EQ(one[i].impacts, other[i].impacts);
            }
        }
    }
}

} // namespace
} // namespace overturn
