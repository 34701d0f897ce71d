#include "overturn/mechanics/pulse_motion.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "overturn/sweep/history.hpp"
#include "point_run.hpp"
#include "support/every_scene.hpp"
#include "support/given_values.hpp"
#include "support/random_point.hpp"
#include "support/random_record.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace overturn {
namespace {

const Point safe_point{.block = {0.1745716, 0.9}, .amplitude = 1.3, .frequency = 3};

/// The fields of one point.
TileFields fields_of(const Scene& scene, const Point& point, const Numerics& numerics,
                     const std::vector<Field>& fields)
{
    const Problem problem{
        .scene = scene, .grid = grid_of_point(point), .numerics = numerics, .fields = fields};
    return compute_tile(problem, tiling_of(problem)[0], widest_kernel());
}

/// Calls check(scene, point) for some points under every pulse and theory.
template <class Check>
void for_random_points(const Check& check)
{
    std::mt19937_64 generator(33);
    for (const Scene& scene : every_scene()) {
        for (int i = 0; i < 12; ++i) {
            const PulsePoint<double> point = random_point(generator);
            check(scene, Point{point.block(), point.amplitude, point.frequency});
        }
    }
}

int count(const History& history, EventKind kind, double until)
{
    return int(
        std::count_if(history.events.begin(), history.events.end(), [&](const HistoryEvent& found) {
            return found.kind == kind && found.after.time <= until;
        }));
}

TEST(History, ThatDoublesCannotFollowHasTheSettledRegionAndUnknownTimes)
{
    std::mt19937_64 generator(7);
    int searched = 0;
    int corrected = 0;
    while (searched < 20) {
        const RecordPoint drawn = random_record_point(generator, 150, Directions::horizontal);
        Scene scene;
        scene.motion = Suite{{std::make_shared<const Accelerogram>(drawn.record)}};
        const auto region_at = [&](double scale, const Numerics& numerics) {
            const PointRun run(scene, {{drawn.block, scale, drawn.frequency}}, widest_kernel());
            return outcomes_of(run, numerics, {.region = true})[0].region;
        };
        const Numerics doubles{Method::taylor, 1e-12};
        double safe = 0;
        double unsafe = drawn.scale;
        if (!is_unsafe(region_at(unsafe, doubles))) {
            continue;
        }
        ++searched;
        for (double middle = unsafe / 2; safe < middle && middle < unsafe;
             middle = safe + (unsafe - safe) / 2) {
            (is_unsafe(region_at(middle, doubles)) ? unsafe : safe) = middle;
        }
        for (const double scale : {safe, unsafe}) {
            const Region settled = region_at(scale, most_accurate);
            const History history = history_of(scene, {drawn.block, scale, drawn.frequency});
            EXPECT_NE(settled, Region::undecided) << scale;
            EXPECT_EQ(history.region, settled) << scale;
            EXPECT_FALSE(history.is_curve_certain) << scale;
            EXPECT_TRUE(std::isnan(history.time_of_fall) && std::isnan(history.time_of_rest))
                << scale;
            corrected += is_unsafe(settled) != (scale == unsafe);
        }
    }
    EXPECT_GT(corrected, 0);
}

TEST(History, ThatDoublesCanFollowHasTheRegionOfTheSpectrum)
{
    std::mt19937_64 generator(8);
    for (int i = 0; i < 120; ++i) {
        const RecordPoint drawn = random_record_point(generator, 150, Directions::horizontal);
        Scene scene;
        scene.motion = Suite{{std::make_shared<const Accelerogram>(drawn.record)}};
        const Point point{drawn.block, drawn.scale, drawn.frequency};
        const PointRun run(scene, {point}, widest_kernel());
        const History history = history_of(scene, point);
        EXPECT_TRUE(history.is_curve_certain) << i;
        EXPECT_EQ(history.region, outcomes_of(run, most_accurate, {.region = true})[0].region) << i;
    }
}

TEST(History, HasTheEndStateOfTheSpectrum)
{
    for_random_points([](const Scene& scene, const Point& point) {
        const TileFields fields =
            fields_of(scene, point, {Method::taylor, 1e-12},
                      {Field::region, Field::margin, Field::error, Field::impacts});
        const auto region = Region(std::get<std::vector<std::uint8_t>>(fields.values[0])[0]);
        const double margin = std::get<std::vector<double>>(fields.values[1])[0];
        const double error = std::get<std::vector<double>>(fields.values[2])[0];
        const int impacts = std::get<std::vector<std::uint16_t>>(fields.values[3])[0];
        const History history = history_of(scene, point);
        EXPECT_EQ(history.region, region);
        EXPECT_NEAR(history.margin, margin, error + history.error);
        const double end = std::min(history.end_of_pulse, history.time_of_fall);
        const int struck = count(history, EventKind::impact, end);
        EXPECT_TRUE(impacts == struck || impacts == impact_count::bounce_series);
        EXPECT_EQ(std::isfinite(history.time_of_fall), is_unsafe(region));
        EXPECT_EQ(std::isfinite(history.time_of_rest), is_safe(region));
    });
}

/// The largest friction of the samples until the block last passes alpha.
double largest_friction(const History& history, const Block<double>& block)
{
    double largest = 0;
    double beyond = 0;
    for (const HistorySample& sample : history.samples) {
        const bool is_beyond =
            std::abs(sample.angle) > seen_from(sample.angle < 0 ? -1.0 : 1.0, block).slenderness;
        beyond = std::max(beyond, sample.friction_demand);
        if (!is_beyond) {
            largest = std::max(largest, beyond);
            beyond = 0;
        }
    }
    return largest;
}

TEST(History, HasTheFrictionOfTheSpectrum)
{
    std::mt19937_64 generator(6);
    std::uniform_real_distribution<double> uniform(0, 1);
    int compared = 0;
    constexpr std::array pulses{PulseKind::one_sine, PulseKind::rectangular, PulseKind::one_cosine};
    for (int i = 0; i < 36; ++i) {
        Scene scene;
        Point point{};
        if (i % 2 == 0) {
            const RecordPoint drawn = random_record_point(
                generator, 100, i % 4 == 0 ? Directions::horizontal : Directions::both);
            scene.motion = Suite{{std::make_shared<const Accelerogram>(drawn.record)}};
            point = {drawn.block, drawn.scale, drawn.frequency};
        } else {
            scene.motion = Pulse{pulses[std::size_t(i / 2) % pulses.size()]};
            const PulsePoint<double> drawn = random_point(generator);
            point = {drawn.block(), drawn.amplitude, drawn.frequency};
        }
        point.gyration = 0.4 + 0.4 * uniform(generator);
        const PointRun run(scene, {point}, widest_kernel());
        const Numerics numerics{Method::taylor, 1e-11};
        const Outcome outcome = outcomes_of(run, numerics, {.contact = true, .region = true})[0];
        const double found = outcome.friction_demand;
        const History history = history_of(scene, point, {.samples = 3000});
        // A record has kinks, so that peaks are narrow.
        const History forced =
            history_of(scene, point, {.until = history.end_of_pulse, .samples = 10000});
        const double seen =
            std::max(largest_friction(history, point.block), largest_friction(forced, point.block));
        if (std::isfinite(found) && std::isfinite(seen) &&
            is_unsafe(history.region) == is_unsafe(outcome.region)) {
            ++compared;
            EXPECT_LE(seen, found * (1 + 1e-7)) << i;
            EXPECT_GE(seen, found * 0.98) << i; // samples miss narrow peaks
        }
    }
    EXPECT_GT(compared, 27);
}

TEST(History, NeedsNoFrictionAtRestUnderAJumpThatLiftsTheBlock)
{
    const Point point{.block = {0.2, 0.9}, .amplitude = 4, .frequency = 3, .gyration = 0.577};
    for (const PulseKind pulse : {PulseKind::rectangular, PulseKind::one_cosine}) {
        const History history = history_of({Pulse{pulse}}, point);
        const HistoryEvent& uplift = history.events.front();
        EXPECT_EQ(uplift.kind, EventKind::uplift);
        EXPECT_EQ(uplift.before.time, 0);
        EXPECT_EQ(uplift.before.friction_demand, 0);
        EXPECT_EQ(uplift.after.time, 0);
        EXPECT_DOUBLE_EQ(uplift.after.ground, 4 * std::tan(0.2));
    }
}

TEST(History, AgreesWithPeaksAndFallTimesOfTheSpectrum)
{
    for_random_points([](const Scene& scene, const Point& point) {
        HistoryView view;
        view.samples = 4000;
        const History history = history_of(scene, point, view);
        double peak = 0;
        for (const HistorySample& sample : history.samples) {
            peak = std::max(peak, std::abs(sample.angle) / point.block.slenderness);
        }
        for (const Numerics& numerics :
             {Numerics{Method::rk45, 1e-9}, {Method::taylor, 1e-9}, {Method::rk45, 1e-9, true}}) {
            const TileFields fields =
                fields_of(scene, point, numerics, {Field::peak, Field::fall_time, Field::error});
            const double found = std::get<std::vector<double>>(fields.values[0])[0];
            const double fall = std::get<std::vector<double>>(fields.values[1])[0];
            if (is_safe(history.region)) {
                // Half a spacing away from a peak the angle is lower by an eighth of the
                // acceleration, below 1 + a, times the spacing squared; and errors of 1e-9 grow.
                const double h = history.samples.back().time / view.samples;
                EXPECT_NEAR(found, peak, (1 + point.amplitude) * h * h / 8 + 1e-6);
                EXPECT_TRUE(std::isinf(fall));
            } else {
                EXPECT_TRUE(std::isinf(found));
                const double uplift = history.events.front().after.time;
                EXPECT_NEAR(fall, history.time_of_fall - uplift, 1e-6);
            }
        }
    });
}

TEST(History, ObeysTheEquationOfMotionBetweenEvents)
{
    // By Simpson's rule over pairs of intervals of the evenly spaced times: h^5 / 90 times a fourth
    // derivative, which is at most that of the pulse, Omega^4 (Ricker: 30 Omega^4), and round-off.
    for_random_points([](const Scene& scene, const Point& point) {
        HistoryView view;
        view.until = 1.5;
        view.samples = 3001;
        const History history = history_of(scene, point, view);
        const double h = 1.5 / 3000;
        const double size = 1 + point.amplitude;
        const double tolerance =
            std::pow(h, 5) / 90 * 100 * size * std::pow(1 + point.frequency, 4) + 1e-14;
        const Pulse& pulse = *scene.pulse();
        const PulseMotion<double> motion = pulse_motion<double>(pulse.kind, pulse.shape);
        const double kink = (motion.kink - motion.begin) / point.frequency; // 0 if there is none
        int compared = 0;
        for (std::size_t i = 2; i < history.samples.size(); ++i) {
            const HistorySample& first = history.samples[i - 2];
            const HistorySample& middle = history.samples[i - 1];
            const HistorySample& last = history.samples[i];
            const bool no_event = std::abs(middle.time - first.time - h) < 1e-9 &&
                                  std::abs(last.time - middle.time - h) < 1e-9;
            const bool no_kink = kink <= first.time || kink >= last.time;
            if (!no_event || !no_kink) {
                continue;
            }
            ++compared;
            EXPECT_NEAR(last.velocity - first.velocity,
                        h / 3 * (first.acceleration + 4 * middle.acceleration + last.acceleration),
                        tolerance);
            EXPECT_NEAR(last.angle - first.angle,
                        h / 3 * (first.velocity + 4 * middle.velocity + last.velocity), tolerance);
        }
        EXPECT_GT(compared, 100);
    });
}

TEST(History, LosesSpeedOnlyAtImpacts)
{
    for_random_points([](const Scene& scene, const Point& point) {
        const History history = history_of(scene, point);
        for (const HistoryEvent& event : history.events) {
            EXPECT_NEAR(event.before.angle, event.after.angle, 1e-15);
            if (event.kind == EventKind::impact) {
                EXPECT_NEAR(event.after.velocity,
                            std::sqrt(point.block.restitution) * event.before.velocity,
                            1e-13 * std::abs(event.before.velocity) + 1e-15);
                EXPECT_GE(event.after.q, event.before.q);
            } else if (event.kind != EventKind::rest) {
                EXPECT_NEAR(event.before.velocity, event.after.velocity, 1e-15);
            }
        }
        for (std::size_t i = 1; i < history.samples.size(); ++i) {
            const HistorySample& before = history.samples[i - 1];
            const HistorySample& after = history.samples[i];
            EXPECT_LE(before.time, after.time);
            const double speed = std::max(std::abs(before.velocity), std::abs(after.velocity));
            // Between two samples the speed may exceed that of both by an acceleration times h.
            const double h = after.time - before.time;
            EXPECT_LE(std::abs(after.angle - before.angle),
                      h * (speed + h * (2 + point.amplitude)) + 1e-15);
        }
    });
}

TEST(History, ContinuesUntilTheBlockIsAtRest)
{
    const History history = history_of({}, safe_point);
    EXPECT_EQ(history.region, Region::S);
    EXPECT_EQ(history.events.front().kind, EventKind::uplift);
    // When sin(phase) = 1 / a.
    EXPECT_NEAR(history.events.front().after.time, std::asin(1 / 1.3) / 3, 1e-15);
    EXPECT_EQ(history.events.back().kind, EventKind::rest);
    EXPECT_EQ(history.events.back().after.time, history.time_of_rest);
    EXPECT_EQ(history.samples.back().time, history.time_of_rest);
    EXPECT_EQ(history.samples.back().angle, 0);
}

TEST(History, EndsWhenTheBlockOverturns)
{
    Point point = safe_point;
    point.amplitude = 2;
    const History free = history_of({}, point);
    EXPECT_EQ(free.events.back().kind, EventKind::fall);
    EXPECT_GT(free.time_of_fall, free.end_of_pulse);
    EXPECT_NEAR(std::abs(free.samples.back().angle), std::acos(0.0), 1e-14);
    point.amplitude = 30;
    point.frequency = 0.5;
    const History forced = history_of({}, point);
    EXPECT_EQ(forced.events.back().kind, EventKind::fall);
    EXPECT_LT(forced.time_of_fall, forced.end_of_pulse);
    EXPECT_NEAR(std::abs(forced.samples.back().angle), std::acos(0.0), 1e-14);
}

TEST(History, IsThatOfABlockAtRestIfNothingLiftsIt)
{
    Point point = safe_point;
    point.amplitude = 0.5;
    const History history = history_of({}, point);
    ASSERT_EQ(history.events.size(), 1u);
    EXPECT_EQ(history.events[0].kind, EventKind::end_of_pulse);
    EXPECT_EQ(history.time_of_rest, 0);
    EXPECT_EQ(history.samples.size(), 2000u + 2); // the event has two
    for (const HistorySample& sample : history.samples) {
        EXPECT_EQ(sample.angle, 0);
        EXPECT_EQ(sample.acceleration, 0);
    }
}

TEST(History, ContainsRestAndAnotherUplift)
{
    // A slow pulse: bounces die out before the second lobe.
    Point point = safe_point;
    point.frequency = 0.05;
    point.amplitude = 1.00001;
    point.block.restitution = 0.3;
    const History history = history_of({Pulse{PulseKind::one_sine}}, point);
    EXPECT_EQ(count(history, EventKind::uplift, history.end_of_pulse), 2);
    EXPECT_EQ(count(history, EventKind::rest, history.end_of_pulse), 2);
    EXPECT_EQ(history.events.back().kind, EventKind::end_of_pulse);
    EXPECT_LT(history.time_of_rest, history.end_of_pulse);
}

TEST(History, OfABlockWithoutLossTerminates)
{
    Point point = safe_point;
    point.block.restitution = 1;
    const History history = history_of({}, point);
    EXPECT_TRUE(std::isinf(history.time_of_rest));
    EXPECT_TRUE(std::isinf(history.time_of_fall));
    EXPECT_EQ(history.samples.back().time, history.end_of_pulse + free_time_shown);
    // The energy equals that at the end of the pulse.
    const double q = history.samples.back().q;
    for (const HistorySample& sample : history.samples) {
        if (sample.time > history.end_of_pulse) {
            EXPECT_NEAR(sample.q, q, 1e-14);
        }
    }
}

TEST(History, EndsAtTheRequestedTime)
{
    for (const double until : {0.1, 1.0, 30.0, 100.0}) {
        HistoryView view;
        view.until = until;
        view.samples = 101;
        const History history = history_of({}, safe_point, view);
        EXPECT_EQ(history.samples.front().time, 0);
        EXPECT_EQ(history.samples.back().time, until);
        EXPECT_EQ(history.samples.size(), 101 + 2 * history.events.size());
        EXPECT_EQ(history.time_of_rest, history_of({}, safe_point).time_of_rest);
    }
}

} // namespace
} // namespace overturn
