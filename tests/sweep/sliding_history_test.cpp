#include "overturn/mechanics/pulse_motion.hpp"
#include "overturn/sweep/history.hpp"
#include "point_run.hpp"
#include "support/random_record.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace overturn {
namespace {

constexpr double third = 1.0 / 3;

/// A box with b / h = 1/3 and its motion: pulse frequencies and sizes in units of p and R.
Point box(double friction, double pga, double frequency)
{
    const double alpha = std::atan(third);
    Point point{.block = {alpha, largest_restitution(alpha)},
                .amplitude = pga / third,
                .frequency = frequency};
    point.gyration = 1 / std::sqrt(3.0);
    point.friction = friction;
    return point;
}

struct Case {
    Scene scene;
    Point point;
};

/// Boxes that slide flat, or slip while they rock, under two pulses and records.
std::vector<Case> cases()
{
    std::vector<Case> all;
    for (const PulseKind kind : {PulseKind::one_sine, PulseKind::half_sine}) {
        for (const double friction : {0.2, 0.36, 0.45}) {
            for (const double pga : {0.3, 0.6, 1.0, 1.6, 2.2}) {
                Scene scene;
                scene.motion = Pulse{kind, {}};
                all.push_back({scene, box(friction, pga, 4)});
            }
        }
    }
    std::mt19937_64 generator(5);
    for (int i = 0; i < 8; ++i) {
        const RecordPoint drawn = random_record_point(generator, 100, Directions::horizontal);
        Scene scene;
        scene.motion = Suite{{std::make_shared<const Accelerogram>(drawn.record)}};
        Point point = box(i % 2 == 0 ? 0.25 : 0.38, third, drawn.frequency);
        point.amplitude = 4 * drawn.scale;
        all.push_back({scene, point});
    }
    return all;
}

bool slips(const HistorySample& sample)
{
    return sample.mode == SlidingMode::slide || sample.mode == SlidingMode::slide_rock;
}

/// Calls check(history, scene, point) where the block slips.
template <class Check>
void for_slipping_blocks(const Check& check)
{
    int rocking = 0;
    static const std::vector<Case> all = cases();
    for (const auto& [scene, point] : all) {
        const History history = history_of(scene, point);
        if (!history.slips) {
            continue;
        }
        rocking += std::ranges::any_of(history.samples, [](const HistorySample& sample) {
            return sample.mode == SlidingMode::slide_rock;
        });
        check(history, scene, point);
    }
    EXPECT_GT(rocking, 10);
}

TEST(HistoryWithSlip, EndsAsThePointOfASpectrum)
{
    for_slipping_blocks([](const History& history, const Scene& scene, const Point& point) {
        const PointRun run(scene, {point}, widest_kernel());
        const Outcome outcome = outcomes_of(run, most_accurate, {.region = true, .slide = true})[0];
        EXPECT_EQ(history.region, outcome.region);
        EXPECT_FALSE(history.shortened);
        const HistorySample& last = history.samples.back();
        EXPECT_NEAR(last.slide, outcome.slide, 1e-10);
        double farthest = 0;
        for (const HistorySample& sample : history.samples) {
            farthest = std::max(farthest, std::abs(sample.slide));
        }
        EXPECT_LE(farthest, outcome.slide_peak + 1e-10);
        EXPECT_NEAR(farthest, outcome.slide_peak, 1e-4);
        if (is_unsafe(outcome.region)) {
            EXPECT_EQ(history.events.back().kind, EventKind::fall);
            EXPECT_NEAR(std::abs(last.angle), std::acos(0.0), 1e-12);
            EXPECT_EQ(last.time, history.time_of_fall);
            EXPECT_TRUE(std::isinf(history.time_of_rest));
        } else {
            EXPECT_EQ(last.angle, 0);
            EXPECT_EQ(last.slide_velocity, 0);
            EXPECT_DOUBLE_EQ(last.time, std::max(history.time_of_rest, history.end_of_pulse));
            EXPECT_TRUE(std::isinf(history.time_of_fall));
        }
    });
}

TEST(HistoryWithSlip, HasForcesWithinTheConeOfFriction)
{
    for_slipping_blocks([](const History& history, const Scene&, const Point& point) {
        for (const HistorySample& sample : history.samples) {
            const double most = point.friction * sample.force_normal;
            EXPECT_GT(sample.force_normal, 0);
            EXPECT_LE(std::abs(sample.force_along), most * (1 + 1e-11));
            if (slips(sample)) { // the force opposes the slip
                EXPECT_NEAR(std::abs(sample.force_along), most, 1e-12 * most);
                EXPECT_LE(sample.force_along * sample.slide_velocity, 1e-13);
            } else {
                EXPECT_EQ(sample.slide_velocity, 0);
            }
        }
    });
}

/// The forces and the ground are the acceleration of the centre of mass, by Simpson's rule.
TEST(HistoryWithSlip, FulfilsNewtonsLaw)
{
    const double b = std::sin(std::atan(third));
    const double h = std::cos(std::atan(third));
    constexpr double gravity = 4 * third; // over p^2 R
    int compared = 0;
    for_slipping_blocks([&](const History& history, const Scene& scene, const Point&) {
        if (scene.pulse() == nullptr) {
            return; // whose ground has kinks between the samples
        }
        struct Centre {
            double along;
            double upwards;
            double position;
        };
        const auto velocity_of = [&](const HistorySample& sample) -> Centre {
            const double tilt = std::abs(sample.angle);
            const double side = sample.angle < 0 ? -1 : 1;
            const double y = b * std::sin(tilt) + h * std::cos(tilt);
            const double x = h * std::sin(tilt) - b * std::cos(tilt);
            return {sample.slide_velocity + y * sample.velocity, -x * side * sample.velocity,
                    sample.slide};
        };
        for (std::size_t i = 2; i < history.samples.size(); ++i) {
            const HistorySample& first = history.samples[i - 2];
            const HistorySample& middle = history.samples[i - 1];
            const HistorySample& last = history.samples[i];
            const double step = (last.time - first.time) / 2;
            const bool is_even = std::abs(middle.time - first.time - step) < 1e-12;
            if (step <= 0 || !is_even || first.mode != last.mode) {
                continue;
            }
            const auto integral = [&](const auto& of) {
                return step / 3 * (of(first) + 4 * of(middle) + of(last));
            };
            // Of the fifth power of the step times the fourth derivative.
            const double tolerance = 1e3 * std::pow(step, 5) + 1e-12;
            const Centre before = velocity_of(first);
            const Centre after = velocity_of(last);
            const auto along = [&](const HistorySample& at) {
                return gravity * (at.force_along - at.ground);
            };
            const auto upwards = [&](const HistorySample& at) {
                return gravity * (at.force_normal - 1);
            };
            EXPECT_NEAR(after.along - before.along, integral(along), tolerance);
            EXPECT_NEAR(after.upwards - before.upwards, integral(upwards), tolerance);
            EXPECT_NEAR(last.slide - first.slide,
                        integral([](const HistorySample& at) { return at.slide_velocity; }),
                        tolerance);
            EXPECT_NEAR(last.velocity - first.velocity,
                        integral([](const HistorySample& at) { return at.acceleration; }),
                        tolerance);
            ++compared;
        }
    });
    EXPECT_GT(compared, 10000);
}

TEST(HistoryWithSlip, ChangesItsModeAtEvents)
{
    for_slipping_blocks([](const History& history, const Scene&, const Point&) {
        SlidingMode mode = SlidingMode::rest;
        double time = 0;
        for (const HistoryEvent& event : history.events) {
            EXPECT_GE(event.after.time, time);
            EXPECT_EQ(event.before.mode, mode);
            EXPECT_NEAR(event.before.slide, event.after.slide,
                        1e-15 * (1 + std::abs(event.before.slide)));
            EXPECT_NEAR(event.before.angle, event.after.angle, 1e-13);
            if (event.kind == EventKind::slip || event.kind == EventKind::uplift ||
                event.kind == EventKind::stick) {
                EXPECT_NEAR(event.before.velocity, event.after.velocity, 1e-14);
                EXPECT_NEAR(event.before.slide_velocity, event.after.slide_velocity, 1e-13);
            }
            EXPECT_EQ(event.kind == EventKind::rest, event.after.mode == SlidingMode::rest &&
                                                         event.kind != EventKind::end_of_pulse &&
                                                         event.kind != EventKind::impact);
            mode = event.after.mode;
            time = event.after.time;
        }
    });
}

TEST(HistoryWithSlip, IsThatOfABlockThatCannotSlipIfNothingSlips)
{
    for (const double pga : {0.2, 0.5, 0.8}) {
        const Point point = box(5, pga, 4);
        Point without = point;
        without.friction = std::numeric_limits<double>::infinity();
        const History history = history_of({}, point);
        const History plain = history_of({}, without);
        EXPECT_FALSE(history.slips);
        ASSERT_EQ(history.samples.size(), plain.samples.size());
        for (std::size_t i = 0; i < plain.samples.size(); ++i) {
            const HistorySample& one = history.samples[i];
            EXPECT_EQ(one.angle, plain.samples[i].angle);
            EXPECT_EQ(one.slide, 0);
            EXPECT_EQ(one.mode, one.angle == 0 && one.velocity == 0 && one.acceleration == 0
                                    ? SlidingMode::rest
                                    : SlidingMode::rock);
        }
        EXPECT_EQ(history.margin, plain.margin);
    }
}

/// Downhill is the side plus; the push towards it relieves the base of pga sin(incline).
TEST(HistoryWithSlip, EndsWhereTheBlockWouldLeaveTheBase)
{
    constexpr double incline = 0.3;
    constexpr double gyration = 0.6 / 0.9; // of a body with b = h, over h
    const double size = std::sqrt(2.0);
    const double p = std::sqrt(size / (gyration * gyration + 2));
    const auto side = [&](double descent) -> BlockSide<double> {
        return {std::atan(1.0) - descent, size, p};
    };
    const double kept = gyration * gyration / (gyration * gyration + 2);
    Scene scene;
    scene.motion = Pulse{PulseKind::half_sine, {}};
    for (const double share : {0.99, 1.01}) {
        Point point{.block = {side(incline), kept * kept, side(-incline)},
                    .amplitude = -share / std::tan(incline) / std::tan(std::atan(1.0) - incline),
                    .frequency = 4};
        point.gyration = gyration / size;
        point.friction = 0.35;
        const History history = history_of(scene, point);
        EXPECT_TRUE(history.slips);
        const bool leaves = share > 1;
        EXPECT_EQ(history.shortened, leaves);
        EXPECT_EQ(std::isnan(history.time_of_rest), leaves);
        EXPECT_EQ(history.region, leaves ? Region::undecided : Region::S);
        EXPECT_NEAR(history.samples.back().force_normal, leaves ? 0 : std::cos(incline), 1e-12);
    }
}

} // namespace
} // namespace overturn
