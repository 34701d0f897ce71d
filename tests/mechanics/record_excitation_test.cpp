// A block under a recorded ground motion: the push between samples, and when it lifts the block.
#include "support/random_record.hpp"
#include "support/special_values.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace overturn {
namespace {

TEST(RecordExcitation, IsLinearBetweenItsSamples)
{
    const RecordPoint point{accelerogram({0.5, -1, 2}, {0, 0.25, -0.5}), {0.2, 0.9}, 0.5, 4};
    const auto excitation = excitation_of<Theory::linear, Directions::both>(point);
    // All of these are exact in binary.
    const std::array<std::array<double, 3>, 5> expected{{{0, 0.25, 1},
                                                         {0.5, -0.125, 1.0625},
                                                         {1, -0.5, 1.125},
                                                         {1.25, -0.125, 1.03125},
                                                         {2, 1, 0.75}}};
    for (const auto& [phase, horizontal, gravity] : expected) {
        const Ground<double> ground = excitation.ground(phase);
        EXPECT_EQ(ground.horizontal, horizontal) << phase;
        EXPECT_EQ(ground.gravity, gravity) << phase;
    }
    EXPECT_EQ(excitation.largest_acceleration(), 0.5 * 2.5);
    // A quarter of a sample after the phase, at 4 samples per unit of time.
    const auto push = excitation.series<14>(-0.5, 1.25, 4.0);
    EXPECT_EQ(push.at(0.0625).horizontal, -0.25);
    EXPECT_EQ(push.at(0.0625).gravity, 0.9375);
}

TEST(RecordExcitation, HasAPiecePerInterval)
{
    const Accelerogram record = accelerogram({1, 2, 3, 4});
    const RecordMotion<double> motion = record_motion<double>(record);
    EXPECT_EQ(motion.begin, 0);
    EXPECT_EQ(motion.end, 3);
    EXPECT_EQ(motion.pieces(), 3);
    EXPECT_EQ(motion.end_of_piece(0.0), 1);
    EXPECT_EQ(motion.end_of_piece(std::nextafter(1.0, 0.0)), 1);
    EXPECT_EQ(motion.end_of_piece(1.0), 2); // a sample begins the next piece
    EXPECT_EQ(motion.end_of_piece(2.5), 3);
    EXPECT_EQ(motion.end_of_piece(3.0), 3);
    EXPECT_TRUE(motion.is_monotone(0.5, 1.0));
    EXPECT_FALSE(motion.is_monotone(0.5, 1.001));
}

/// At uneven phases.
Accelerogram shape_of_pulse()
{
    return Accelerogram::of_pulse({0, 0.5, 0.75, 4}, {0.5, -1, 0, 0.25});
}

TEST(PulseOfSamples, HasAPiecePerInterval)
{
    const Accelerogram shape = shape_of_pulse();
    const RecordMotion<double, true> motion = record_motion<double>(shape);
    EXPECT_EQ(motion.begin, 0);
    EXPECT_EQ(motion.end, 4);
    EXPECT_EQ(motion.pieces(), 3);
    EXPECT_EQ(motion.end_of_piece(0.0), 0.5);
    EXPECT_EQ(motion.end_of_piece(std::nextafter(0.5, 0.0)), 0.5);
    EXPECT_EQ(motion.end_of_piece(0.5), 0.75); // a sample begins the next piece
    EXPECT_EQ(motion.end_of_piece(3.0), 4);
    EXPECT_EQ(motion.end_of_piece(4.0), 4);
    EXPECT_EQ(motion.end_of_piece(5.0), 4);
    EXPECT_EQ(motion.sample_after(0.0), 0);
    EXPECT_EQ(motion.sample_after(0.5), 1);
    EXPECT_EQ(motion.sample_after(std::nextafter(0.5, 1.0)), 2);
    EXPECT_EQ(motion.sample_after(4.0), 3);
    EXPECT_EQ(motion.sample_after(4.5), 4);
    EXPECT_TRUE(motion.is_monotone(0.75, 4.0));
    EXPECT_FALSE(motion.is_monotone(0.6, 0.8));
}

TEST(PulseOfSamples, IsLinearBetweenItsSamplesAndHasTheAmplitudeOfALiftedBlock)
{
    const Accelerogram shape = shape_of_pulse();
    const Block<double> block{0.25, 0.9};
    const auto excitation = record_excitation<Theory::linear>(shape, block, -2.0, 3.0);
    EXPECT_EQ(excitation.acceleration, -0.5); // twice what lifts it, mirrored
    EXPECT_EQ(excitation.frequency, 3);
    for (const auto& [phase, expected] :
         {std::pair(0.0, -0.25), {0.25, 0.125}, {0.5, 0.5}, {0.625, 0.25}, {4.0, -0.125}}) {
        EXPECT_EQ(horizontal_of(excitation.ground(phase)), expected) << phase;
    }
    // A quarter of a unit of time after the phase, in which the phase grows by 0.75.
    EXPECT_EQ(excitation.series<14>(0.5, 1.0, 3.0).at(0.25).horizontal, 0.5 * 0.25 / 3.25);
}

TEST(PulseOfSamples, LiftsWhereTheAccelerationFirstExceedsTheThreshold)
{
    const Accelerogram shape = shape_of_pulse();
    auto excitation = record_excitation<Theory::linear>(shape, Block<double>{0.25, 0.9}, 1.0, 3.0);
    excitation.acceleration = 1;
    EXPECT_EQ(excitation.next_uplift(true, 0, -infinity), 0);
    // From 0.5 to -1 in 0.5: it reaches -0.25 after a phase of 0.25.
    EXPECT_NEAR(excitation.next_uplift(true, 0.2, 0), 0.25, 4 * epsilon);
    EXPECT_EQ(excitation.next_uplift(true, 0.75, 0.5), infinity);
    excitation.acceleration = 1.25; // the last sample is above 0.25
    EXPECT_NEAR(excitation.next_uplift(true, 0.75, 0.5), 0.75 + 0.8 * 3.25, 8 * epsilon);
}

/// The excess of the ground over what lifts the block, with the larger of both signs.
template <Directions directions>
double excess(const RecordExcitation<double, directions>& excitation, double phase)
{
    const auto ground = excitation.ground(phase);
    if constexpr (directions == Directions::both) {
        return std::abs(ground.horizontal) - excitation.to_plus * ground.gravity;
    } else {
        return std::abs(ground) - excitation.to_plus;
    }
}

/// By halving, in the first interval whose end lifts the block; the excess is convex between
/// samples.
template <Directions directions>
double first_uplift(const RecordExcitation<double, directions>& excitation, double phase)
{
    double low = phase;
    double high = phase;
    while (!(excess(excitation, high) > 0)) {
        if (high == excitation.motion.end) {
            return infinity;
        }
        low = high;
        high = std::floor(high) + 1;
    }
    while (low < (low + high) / 2 && (low + high) / 2 < high) {
        const double middle = (low + high) / 2;
        (excess(excitation, middle) > 0 ? high : low) = middle;
    }
    return high;
}

template <Directions directions>
RecordExcitation<double, directions> random_excitation(const RecordPoint& point,
                                                       std::mt19937_64& generator)
{
    auto excitation = excitation_of<Theory::nonlinear, directions>(point);
    excitation.to_plus = random_threshold(generator, point.record, point.scale);
    excitation.to_minus = excitation.to_plus;
    return excitation;
}

template <Directions directions>
void expect_uplifts_by_halving()
{
    std::mt19937_64 generator(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    int at_sample = 0;
    int between = 0;
    int never = 0;
    for (int i = 0; i < 20000; ++i) {
        const RecordPoint point = random_record_point(generator, 2 + i % 20, directions);
        const auto excitation = random_excitation<directions>(point, generator);
        const double end = excitation.motion.end;
        const double phase =
            i % 3 == 0 ? std::floor(end * uniform(generator)) : end * uniform(generator);
        if (phase != std::floor(phase) && excess(excitation, phase) >= 0) {
            continue; // no block rests there
        }
        const double expected = first_uplift(excitation, phase);
        const double ours = excitation.next_uplift(true, phase, -infinity);
        if (expected == infinity) {
            ASSERT_EQ(ours, infinity);
            ++never;
            continue;
        }
        // Accelerations are rounded to a few units of the last place, which moves the crossing by
        // that over their slope; 1e-3 bounds the slope where the crossing is not lost anyway.
        const double most = excitation.largest_acceleration() + 2 * excitation.to_plus;
        const double slope = std::abs(excess(excitation, std::ceil(expected)) -
                                      excess(excitation, std::ceil(expected) - 1));
        const double tolerance = 8 * epsilon * (end + most / std::max(slope, 1e-3 * most));
        ASSERT_NEAR(ours, expected, tolerance) << phase;
        ASSERT_GE(ours, phase);
        ++(expected == std::floor(expected) ? at_sample : between);
    }
    EXPECT_GT(at_sample, 1000);
    EXPECT_GT(between, 1000);
    EXPECT_GT(never, 1000);
}

TEST(RecordExcitation, LiftsWhereTheAccelerationFirstExceedsTheThreshold)
{
    expect_uplifts_by_halving<Directions::horizontal>();
}
TEST(RecordExcitation, LiftsWhereTheAccelerationFirstExceedsTheThresholdOfItsGravity)
{
    expect_uplifts_by_halving<Directions::both>();
}

TEST(RecordExcitation, LiftsAtTheFirstSampleIfThatIsAboveTheThreshold)
{
    for (const double first : {0.3, -0.3}) {
        const RecordPoint point{accelerogram({first, 0, 0.5}), {0.2, 0.9}, 1, 4};
        const auto excitation = excitation_of<Theory::linear, Directions::horizontal>(point);
        EXPECT_EQ(excitation.next_uplift(true, 0, -infinity), 0);
        // The next one crosses the threshold 0.2 between 0 and 0.5.
        EXPECT_NEAR(excitation.next_uplift(true, 0.75, 0), 1.4, 4 * epsilon);
    }
}

TEST(RecordExcitation, CrossingFromOneSideToTheOtherLiftsOnTheOther)
{
    // At rest at 0.5; the sample before it lifts, too, to the other side.
    const RecordPoint point{accelerogram({1, -1}), {0.2, 0.9}, 1, 4};
    const auto excitation = excitation_of<Theory::linear, Directions::horizontal>(point);
    EXPECT_NEAR(excitation.next_uplift(true, 0.5, 0), 0.6, 4 * epsilon);
}

TEST(RecordExcitation, DoesNotLiftAtTheThresholdOrBelow)
{
    const RecordPoint point{accelerogram({0, 0.25, -0.25}), {0.25, 0.9}, 1, 4};
    auto excitation = excitation_of<Theory::linear, Directions::horizontal>(point);
    EXPECT_EQ(excitation.next_uplift(true, 0, -infinity), infinity);
    excitation.acceleration = std::nextafter(1.0, 2.0);
    EXPECT_NEAR(excitation.next_uplift(true, 0, -infinity), 1, 4 * epsilon);
    EXPECT_EQ(excitation.next_uplift(false, 0, -infinity), infinity);
}

TEST(RecordExcitation, VerticalMotionChangesTheThreshold)
{
    std::mt19937_64 generator(6);
    const auto expect_threshold = [&]<Theory theory>() {
        for (int i = 0; i < 200; ++i) {
            RecordPoint point = random_record_point(generator, 2, Directions::both);
            const double lifting = Equations<theory>::uplift_acceleration(point.block);
            const double v = point.record.upwards()[1];
            const double a = std::abs(point.record.horizontal()[1]);
            if (a <= v * lifting) {
                continue; // no scale lifts the block at the second sample
            }
            const double scale = lifting / (a - v * lifting); // scale a = (1 + scale v) lifting
            point.record = accelerogram({0, a}, {v, v});
            if (!(scale < 0.999 * point.record.free_fall_scale())) {
                continue;
            }
            // A few roundings, hundreds of times smaller than 1e-11 unless terms cancel.
            point.scale = scale * (1 - 1e-11);
            EXPECT_EQ(
                (excitation_of<theory, Directions::both>(point).next_uplift(true, 0, -infinity)),
                infinity);
            point.scale = scale * (1 + 1e-11);
            EXPECT_LT(
                (excitation_of<theory, Directions::both>(point).next_uplift(true, 0, -infinity)),
                1);
        }
    };
    expect_threshold.template operator()<Theory::linear>();
    expect_threshold.template operator()<Theory::nonlinear>();
}

TEST(RecordExcitation, ALaterUpliftIsLater)
{
    std::mt19937_64 generator(7);
    for (int i = 0; i < 5000; ++i) {
        const RecordPoint point = random_record_point(generator, 20, Directions::both);
        const auto excitation = excitation_of<Theory::linear, Directions::both>(point);
        double latest = -infinity;
        double phase = 0;
        for (int n = 0; n < 20; ++n) {
            // A block that comes to rest at once must not be lifted at the same phase again.
            const double next = excitation.next_uplift(true, phase, latest);
            ASSERT_GT(next, latest);
            if (next == infinity) {
                break;
            }
            ASSERT_GE(next, phase);
            ASSERT_LE(next, excitation.motion.end * (1 + 2 * epsilon));
            // It lifts there, to a few roundings.
            ASSERT_GT(excess(excitation, next), -16 * epsilon * excitation.largest_acceleration());
            latest = next;
            phase = next;
        }
    }
}

TEST(RecordExcitation, MirroredRecordMirrorsThePush)
{
    std::mt19937_64 generator(8);
    for (int i = 0; i < 1000; ++i) {
        const RecordPoint point = random_record_point(generator, 20, Directions::both);
        const auto plain = excitation_of<Theory::linear, Directions::both>(point);
        auto mirrored = plain;
        mirrored.acceleration = -plain.acceleration;
        EXPECT_EQ(plain.next_uplift(true, 0, -infinity), mirrored.next_uplift(true, 0, -infinity));
        const double phase = plain.motion.end * i / 1000;
        EXPECT_EQ(plain.ground(phase).horizontal, -mirrored.ground(phase).horizontal);
        EXPECT_EQ(plain.ground(phase).gravity, mirrored.ground(phase).gravity);
    }
}

} // namespace
} // namespace overturn
