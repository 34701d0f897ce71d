#include "overturn/mechanics/theory/theories.hpp"

#include <gtest/gtest.h>

namespace overturn {
namespace {

TEST(LargestRestitution, OfThePapersBlockIsThatOfThePaper)
{
    EXPECT_NEAR(largest_restitution(std::atan2(1.0, 5.67)), 0.911547, 0.5e-6); // printed digits
}

TEST(LargestRestitution, VanishesWhereEquation17LosesItsMeaning)
{
    const double limit = std::asin(std::sqrt(2.0 / 3.0));
    // r_max is a square: round-off of 1e-16 in the root leaves 1e-32.
    EXPECT_LT(largest_restitution(limit), 1e-30);
}

TEST(RockingAcceleration, OfAnUprightBlockIsZeroExactlyAtTheUpliftAcceleration)
{
    for (const double slenderness : {0.01, 0.17, 0.45, 1.2}) {
        const double push =
            -Equations<Theory::nonlinear>::uplift_acceleration(BlockSide{slenderness});
        // tan * cos - sin: two roundings of sin(alpha).
        EXPECT_NEAR(Equations<Theory::nonlinear>::acceleration(BlockSide{slenderness}, 0.0, push),
                    0, 4.5e-16 * slenderness);
        EXPECT_EQ(Equations<Theory::linear>::acceleration(
                      BlockSide{slenderness}, 0.0,
                      -Equations<Theory::linear>::uplift_acceleration(BlockSide{slenderness})),
                  0);
    }
}

TEST(RockingAcceleration, IsEquation47OnBothSides)
{
    // Eq. 47, theta signed: theta'' = -(sin(alpha sign(theta) - theta) + A cos(the same)).
    const double slenderness = 0.2;
    for (const double theta : {-0.7, -0.1, 0.05, 0.4}) {
        for (const double ground : {-3.0, 0.2, 1.7}) {
            const double sign = theta > 0 ? 1 : -1;
            const double y = slenderness * sign - theta;
            const double exact = -(std::sin(y) + ground * std::cos(y));
            const double ours = Equations<Theory::nonlinear>::acceleration(
                BlockSide{slenderness}, std::abs(theta), sign * ground);
            EXPECT_NEAR(sign * ours, exact, 1e-15 * 5); // three roundings of numbers below 4
        }
    }
}

TEST(RockingAcceleration, ApproachesTheLinearTheoryAsTheSquareOfTheSlenderness)
{
    const auto gap = [](double size) {
        return std::abs(Equations<Theory::nonlinear>::acceleration(BlockSide{size}, 0.3 * size,
                                                                   0.5 * size) -
                        Equations<Theory::linear>::acceleration(BlockSide{size}, 0.3 * size,
                                                                0.5 * size)) /
               size;
    };
    EXPECT_NEAR(gap(1e-2) / gap(1e-3), 100, 1); // the next term is 1e-4 of it; first order gives 10
}

TEST(StateAfterImpact, KeepsTheSignOfTheVelocityAndLosesItsShareOfTheEnergy)
{
    const double r = 0.64;
    const State<double> before{0, -0.5, 1}; // theta' = side * rate = -0.5
    const State<double> after = state_after_impact(before, std::sqrt(r));
    EXPECT_EQ(after.side, -1);
    EXPECT_EQ(after.side * after.rate, -0.4);
    EXPECT_NEAR(after.rate * after.rate / (before.rate * before.rate), r, 1e-15);
}

} // namespace
} // namespace overturn
