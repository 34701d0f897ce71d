#include "support/random_record.hpp"
#include "support/special_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace overturn {
namespace {

bool lifts(const Accelerogram& record, std::int64_t i, double scale, double threshold)
{
    const double upwards = record.upwards().empty() ? 0 : record.upwards()[std::size_t(i)];
    return scale * std::abs(record.horizontal()[std::size_t(i)]) >
           (1 + scale * upwards) * threshold;
}

UpliftThresholds on_both(double side)
{
    return {side, side};
}

TEST(Accelerogram, FindsTheFirstSampleThatLifts)
{
    std::mt19937_64 generator(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    int found = 0;
    int missed = 0;
    for (int i = 0; i < 2000; ++i) {
        const Accelerogram record = random_record(
            generator, 2 + i % 30, i % 2 == 0 ? Directions::both : Directions::horizontal);
        const double scale = uniform(generator) * std::min(record.free_fall_scale(), 10.0);
        const double threshold = random_threshold(generator, record, scale);
        for (std::int64_t first = 0; first <= record.samples(); ++first) {
            std::int64_t expected = first;
            while (expected < record.samples() && !lifts(record, expected, scale, threshold)) {
                ++expected;
            }
            ASSERT_EQ(record.first_lifting(first, scale, on_both(threshold)), expected);
            ++(expected < record.samples() ? found : missed);
        }
    }
    EXPECT_GT(found, 5000); // so that neither is trivial
    EXPECT_GT(missed, 5000);
}

TEST(Accelerogram, ASampleAtTheThresholdDoesNotLift)
{
    const Accelerogram record = accelerogram({0, 0.25, -0.5});
    EXPECT_EQ(record.first_lifting(0, 1, on_both(0.5)), 3);
    EXPECT_EQ(record.first_lifting(0, 1, on_both(0.25)), 2);
    EXPECT_EQ(record.first_lifting(0, 1, on_both(std::nextafter(0.25, 0))), 1);
    // A fall of the ground by half of g halves the threshold.
    EXPECT_EQ(accelerogram({0, 0.25, -0.5}, {0, 0, -0.5}).first_lifting(0, 1, on_both(1)), 3);
    EXPECT_EQ(accelerogram({0, 0.25, -0.5}, {0, 0, -0.5}).first_lifting(0, 1, on_both(0.99)), 2);
}

TEST(Accelerogram, LargestScaleLeavesGravityPositive)
{
    EXPECT_EQ(accelerogram({1, 2, -3}).free_fall_scale(), infinity);
    EXPECT_EQ(accelerogram({1, 2}, {0, 5}).free_fall_scale(), infinity);
    EXPECT_EQ(accelerogram({1, 2}, {4, -0.5}).free_fall_scale(), 2);
    std::mt19937_64 generator(4);
    for (int i = 0; i < 100; ++i) {
        const Accelerogram record = random_record(generator, 20, Directions::both);
        const auto gravity = [&](double scale) {
            double least = infinity;
            for (const double v : record.upwards()) {
                least = std::min(least, 1 + scale * v);
            }
            return least;
        };
        if (record.free_fall_scale() < infinity) {
            EXPECT_GT(gravity(0.999 * record.free_fall_scale()), 0);
            EXPECT_LT(gravity(1.001 * record.free_fall_scale()), 0);
        }
    }
}

TEST(Accelerogram, PeaksAreTheLargestOfAllSamples)
{
    const Accelerogram record = accelerogram({0.5, -2, 1, 0}, {-0.25, 0.5, 0, -1});
    EXPECT_EQ(record.peak(), 2);
    EXPECT_EQ(record.upwards_peak(), 1);
    EXPECT_EQ(accelerogram({1, 0}).upwards_peak(), 0);
}

TEST(Accelerogram, InADirectionIsTheSumOfBothComponents)
{
    std::mt19937_64 generator(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 200; ++i) {
        const Accelerogram first = random_record(generator, 20, Directions::both);
        const Accelerogram other = random_record(generator, 20, Directions::horizontal);
        const Accelerogram both(first.horizontal(), first.upwards(), 0.25, other.horizontal());
        EXPECT_EQ(both.in_direction(0).horizontal(), first.horizontal());
        EXPECT_EQ(both.in_direction(90).horizontal(), other.horizontal());
        const double direction = 360 * uniform(generator);
        const double angle = direction * pi<double>() / 180;
        const Accelerogram motion = both.in_direction(direction);
        const Accelerogram mirrored =
            both.in_direction(direction < 180 ? direction + 180 : direction - 180);
        const Accelerogram across = both.in_direction(std::fmod(direction + 90, 360));
        EXPECT_EQ(motion.upwards(), first.upwards());
        EXPECT_EQ(motion.time_step(), 0.25);
        EXPECT_TRUE(motion.second().empty());
        for (std::size_t k = 0; k < motion.horizontal().size(); ++k) {
            const double a = motion.horizontal()[k];
            const double a1 = first.horizontal()[k];
            const double a2 = other.horizontal()[k];
            const double size = std::abs(a1) + std::abs(a2);
            EXPECT_NEAR(a, a1 * std::cos(angle) + a2 * std::sin(angle), 1e-14 * size);
            EXPECT_NEAR(std::hypot(a, across.horizontal()[k]), std::hypot(a1, a2), 1e-14 * size);
            // direction + 180 may be rounded.
            EXPECT_NEAR(mirrored.horizontal()[k], -a, 1e-12 * size);
        }
        const double exact = std::floor(direction / 2); // below 180
        std::vector<double> opposite = both.in_direction(exact + 180).horizontal();
        for (double& a : opposite) {
            a = -a;
        }
        EXPECT_EQ(opposite, both.in_direction(exact).horizontal());
    }
}

TEST(Accelerogram, LiftingScaleSeparatesScalesThatLiftFromOthers)
{
    std::mt19937_64 generator(5);
    std::uniform_real_distribution<double> uniform(0.01, 1);
    for (int i = 0; i < 1000; ++i) {
        const Accelerogram record = random_record(
            generator, 2 + i % 30, i % 2 == 0 ? Directions::both : Directions::horizontal);
        const double threshold = uniform(generator);
        const double scale = record.lifting_scale(on_both(threshold));
        if (std::isinf(scale)) { // the ground always rises too fast
            EXPECT_EQ(record.first_lifting(0, 1e6, on_both(threshold)), record.samples());
            continue;
        }
        // A few roundings, hundreds of times smaller than 1e-12 unless |a| and v cancel.
        EXPECT_LT(record.first_lifting(0, scale * (1 + 1e-12), on_both(threshold)),
                  record.samples());
        EXPECT_EQ(record.first_lifting(0, scale * (1 - 1e-12), on_both(threshold)),
                  record.samples());
    }
    EXPECT_EQ(accelerogram({0, 0.25}, {0, 1}).lifting_scale(on_both(0.25)), infinity);
    EXPECT_EQ(accelerogram({0, 0.25, -0.5}).lifting_scale(on_both(0.25)), 0.5);
    EXPECT_EQ(accelerogram({0, 0.25, -0.5}, {0, 0, -0.5}).lifting_scale(on_both(1)), 1);
}

} // namespace
} // namespace overturn
