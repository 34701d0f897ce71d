#include "overturn/mechanics/energy_criteria.hpp"
#include "support/free_stage.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace overturn {
namespace {

struct FreeStart {
    Block<double> block;
    State<double> state;
};

/// Random blocks in random states, distributed over all regions.
std::vector<FreeStart> free_starts(int count)
{
    std::mt19937_64 generator(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<FreeStart> starts;
    for (int i = 0; i < count; ++i) {
        const double slenderness = 0.08 + 0.37 * uniform(generator);
        const double restitution = 0.4 + 0.6 * uniform(generator);
        const double tilt = 2.2 * slenderness * uniform(generator);
        const double rate = 2.2 * slenderness * (2 * uniform(generator) - 1);
        const double side = uniform(generator) < 0.5 ? -1 : 1;
        starts.push_back({{slenderness, restitution}, {tilt, rate, side}});
    }
    return starts;
}

/// Eq. 20 as printed, p = 1; theta0, theta0' signed.
bool stable_by_equation_20(const FreeStart& start)
{
    const double alpha = start.block.slenderness;
    const double theta = start.state.side * start.state.tilt;
    const double velocity = start.state.side * start.state.rate;
    const double sine = std::sin((alpha - std::abs(theta)) / 2);
    const double q0 = 4 * sine * sine - velocity * velocity;
    const double q_max = 4 * std::sin(alpha / 2) * std::sin(alpha / 2);
    const double q_min = q_max * (1 - 1 / start.block.restitution);
    const double quarter_turn = pi<double>() / 2;
    return (std::abs(theta) <= quarter_turn && theta * velocity < 0 && q_min <= q0 && q0 <= 0) ||
           (std::abs(theta) <= alpha && 0 <= q0 && q0 <= q_max);
}

TEST(Separatrix, HasTheSlopeOfItsRate)
{
    const double h = 1e-5;
    for (const double tilt : {0.0, 0.1, 0.3, 0.5}) {
        const auto difference = [&]<Theory theory>() {
            return (Equations<theory>::separatrix_rate(BlockSide{0.3}, tilt + h) -
                    Equations<theory>::separatrix_rate(BlockSide{0.3}, tilt - h)) /
                   (2 * h);
        };
        // Central differences: h^2 / 6 times a third derivative below 1/4, and round-off / h.
        EXPECT_NEAR((Equations<Theory::nonlinear>::separatrix_slope(BlockSide{0.3}, tilt)),
                    difference.template operator()<Theory::nonlinear>(), 1e-10);
        EXPECT_NEAR((Equations<Theory::linear>::separatrix_slope(BlockSide{0.3}, tilt)),
                    difference.template operator()<Theory::linear>(), 1e-10);
    }
}

TEST(RegionAfterPulse, IsSafeExactlyWhereEquation20Holds)
{
    int safe = 0;
    for (const FreeStart& start : free_starts(200000)) {
        const bool stable = stable_by_equation_20(start);
        safe += stable;
        EXPECT_EQ(is_safe(region_after_pulse<Theory::nonlinear>(start.state, start.block)), stable);
    }
    EXPECT_GT(safe, 20000); // neither outcome is rare here
    EXPECT_LT(safe, 180000);
}

TEST(RegionAfterPulse, AgreesWithTheIntegratedFreeStage)
{
    std::map<Region, int> seen;
    for (const FreeStart& start : free_starts(4000)) {
        const double margin = margin_after_pulse<Theory::nonlinear>(start.state, start.block);
        if (std::abs(margin) < 1e-6) {
            continue; // closer to the separatrix than the integration is exact
        }
        const Region region = region_after_pulse<Theory::nonlinear>(start.state, start.block);
        const FreeOutcome outcome = watch_free_stage(start.state, start.block);
        ++seen[region];
        const double side = start.state.side;
        switch (region) {
        case Region::S: EXPECT_FALSE(outcome.falls); break;
        case Region::S_plus:
        case Region::S_minus:
            EXPECT_FALSE(outcome.falls);
            EXPECT_EQ(side * start.state.rate > 0, region == Region::S_plus);
            // It is safe only because of the loss at the first impact.
            EXPECT_TRUE(watch_free_stage(start.state, {start.block.slenderness, 1.0}).falls);
            break;
        default:
            ASSERT_TRUE(is_unsafe(region));
            EXPECT_TRUE(outcome.falls);
            EXPECT_EQ(outcome.impacts,
                      region == Region::U1_plus || region == Region::U1_minus ? 1 : 0);
            EXPECT_EQ(outcome.side,
                      region == Region::U0_plus || region == Region::U1_plus ? 1.0 : -1.0);
        }
    }
    for (int code = 0; code <= int(Region::U1_minus); ++code) {
        EXPECT_GT(seen[Region(code)], 20) << "too few states in region " << code;
    }
}

TEST(RegionAfterPulse, IsMirroredWithTheSide)
{
    const std::map<Region, Region> mirror{{Region::S, Region::S},
                                          {Region::S_plus, Region::S_minus},
                                          {Region::S_minus, Region::S_plus},
                                          {Region::U0_plus, Region::U0_minus},
                                          {Region::U0_minus, Region::U0_plus},
                                          {Region::U1_plus, Region::U1_minus},
                                          {Region::U1_minus, Region::U1_plus}};
    for (const FreeStart& start : free_starts(10000)) {
        const State<double> mirrored{start.state.tilt, start.state.rate, -start.state.side};
        EXPECT_EQ(region_after_pulse<Theory::nonlinear>(mirrored, start.block),
                  mirror.at(region_after_pulse<Theory::nonlinear>(start.state, start.block)));
    }
}

TEST(RegionAfterPulse, ABlockAtRestIsInS)
{
    const Block<double> block{0.2, 0.8};
    EXPECT_EQ(region_after_pulse<Theory::nonlinear>(State<double>{0, 0, 1}, block), Region::S);
    EXPECT_EQ(region_after_pulse<Theory::linear>(State<double>{0, 0, -1}, block), Region::S);
    EXPECT_EQ(margin_after_pulse<Theory::linear>(State<double>{0, 0, -1}, block), 1);
}

TEST(MarginAfterPulse, HasTheSignOfTheVerdict)
{
    for (const FreeStart& start : free_starts(100000)) {
        EXPECT_EQ(margin_after_pulse<Theory::nonlinear>(start.state, start.block) >= 0,
                  is_safe(region_after_pulse<Theory::nonlinear>(start.state, start.block)));
        EXPECT_EQ(margin_after_pulse<Theory::linear>(start.state, start.block) >= 0,
                  is_safe(region_after_pulse<Theory::linear>(start.state, start.block)));
    }
}

TEST(MarginAfterPulse, OfTheLinearTheoryIsTheLimitOfTheNonlinearOne)
{
    for (const double rate : {-1.3, -0.4, 0.2, 0.9}) {
        const double size = 1e-4;
        const State<double> state{0.4 * size, rate * size, 1};
        const Block<double> block{size, 0.8};
        // They differ by size^2 / 24, which is 4e-10.
        EXPECT_NEAR(margin_after_pulse<Theory::nonlinear>(state, block),
                    margin_after_pulse<Theory::linear>(state, block), 1e-9);
    }
}

} // namespace
} // namespace overturn
