#include "overturn/mechanics/sliding.hpp"

#include <gtest/gtest.h>

#include <random>

namespace overturn {
namespace {

constexpr double g = 9.81;

/// A box on a level base, seen from a corner. [m], [s]
SlidingSide<double> box(double width, double height, double friction)
{
    const double b = width / 2;
    const double h = height / 2;
    return {b, b, h, (b * b + h * h) / 3, g, 1, 0, friction};
}

SlidingSide<double> random_side(std::mt19937_64& generator)
{
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(generator);
    };
    return {between(0.05, 1), between(0.05, 1), between(0.1, 2), between(0.01, 2), g, 1, 0,
            between(0.01, 2)};
}

/// Of a block that turns about its corner at the tilt 0, over the mass.
double kinetic_energy(const SlidingSide<double>& side, double rate, double slip)
{
    const double along = slip + rate * side.height;
    const double upwards = rate * side.base;
    return (along * along + upwards * upwards + side.gyration * rate * rate) / 2;
}

TEST(SlidingSide, IsThatOfTheBlock)
{
    const double alpha = std::atan(1.0 / 3);
    const Block<double> block(alpha, largest_restitution(alpha));
    const SlidingSide<double> side = sliding_side(block, 1 / std::sqrt(3.0), 0.4);
    const double R = 1;
    EXPECT_NEAR(side.base, R * std::sin(alpha), 1e-15);
    EXPECT_NEAR(side.other_base, R * std::sin(alpha), 1e-15);
    EXPECT_NEAR(side.height, R * std::cos(alpha), 1e-15);
    EXPECT_NEAR(side.inertia(), 4.0 / 3, 1e-15);
    EXPECT_NEAR(side.gravity, 4.0 / 3, 1e-15); // p^2 = 3 g / (4 R) = 1
    EXPECT_NEAR(side.friction_to_lift(), 1.0 / 3, 1e-15);
    EXPECT_NEAR(side.acceleration_to_move(), 1.0 / 3, 1e-15);
    EXPECT_NEAR(share_of_rate_kept(side, block.restitution), 1, 1e-15);
}

TEST(SlidingSide, OnAnInclineSlidesFromTheAngleOfFrictionOn)
{
    const double incline = 0.1;
    SlidingSide<double> side = box(1, 2, 0.3);
    side.cosine = std::cos(incline);
    side.sine = std::sin(incline);
    EXPECT_NEAR(side.acceleration_to_move(), std::tan(std::atan(0.3) - incline), 1e-15);
    EXPECT_NEAR(side.turned().acceleration_to_move(), std::tan(std::atan(0.3) + incline), 1e-15);
    const Field2<double> field = field_on(side, -side.acceleration_to_move(), 1.0);
    EXPECT_NEAR(field.along, -0.3 * field.normal, 1e-14);
}

TEST(ImpactWithFriction, OfACornerThatSticksHasTheLargestRestitution)
{
    for (const double width : {0.2, 0.6, 1.0}) {
        const SlidingSide<double> side = box(width, 2, 1);
        ASSERT_LT(side.friction_of_impact(), 1);
        const auto after = impact_with_friction<double>(side, 1.5, 0, 1);
        const double r_max = largest_restitution(std::atan(width / 2));
        EXPECT_NEAR(after.rate, 1.5 * std::sqrt(r_max), 1e-15);
        EXPECT_EQ(after.slip, 0);
        EXPECT_NEAR(impact_with_friction<double>(side, 1.5, 0, 0.8).rate, 1.2 * std::sqrt(r_max),
                    1e-15);
    }
}

TEST(ImpactWithFriction, NeedsTheStatedCoefficientToStick)
{
    const double needed = box(0.6, 1.8, 0).friction_of_impact();
    EXPECT_NEAR(needed, 0.3 * 0.9 / (0.3 + 0.81), 1e-15); // k^2 = 0.3
    EXPECT_EQ(impact_with_friction<double>(box(0.6, 1.8, needed * 1.001), 1, 0, 1).slip, 0);
    EXPECT_GT(impact_with_friction<double>(box(0.6, 1.8, needed * 0.999), 1, 0, 1).slip, 0);
}

TEST(ImpactWithFriction, NeverAddsEnergyNorCrossesTheCone)
{
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    int slipped = 0;
    int stayed = 0;
    for (int i = 0; i < 1000000; ++i) {
        const SlidingSide<double> side = random_side(generator);
        const double rate = std::exp(2 * uniform(generator));
        const double slip = i % 3 == 0 ? 0 : 2 * uniform(generator);
        const double loss = i % 2 == 0 ? 1 : std::abs(uniform(generator));
        const double before = kinetic_energy(side.turned(), rate, slip);
        const auto after = impact_with_friction(side, rate, slip, loss);
        const double left = after.stays_down ? after.slip * after.slip / 2
                                             : kinetic_energy(side, after.rate, after.slip);
        ASSERT_LE(left, before * (1 + 1e-13)) << i;
        ASSERT_GE(after.rate, 0);
        slipped += after.slip != 0;
        stayed += after.stays_down;
    }
    EXPECT_GT(slipped, 100000);
    EXPECT_GT(stayed, 10000);
}

} // namespace
} // namespace overturn
