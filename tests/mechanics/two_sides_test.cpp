#include "support/two_sides.hpp"

#include "overturn/mechanics/energy_criteria.hpp"
#include "overturn/mechanics/free_rocking.hpp"
#include "support/free_stage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace overturn {
namespace {

struct Start {
    Block<double> block; ///< as seen from the side of the state
    State<double> state;
};

/// A body with some share of its largest restitution, in a state on either side, in all regions.
Start random_start(std::mt19937_64& generator)
{
    std::uniform_real_distribution<double> uniform(0, 1);
    const Body body = random_body(generator);
    const double side = uniform(generator) < 0.5 ? -1 : 1;
    const Block<double> block = seen_from(
        side,
        body.block(std::min(1.0, (0.5 + 0.6 * uniform(generator)) * body.largest_restitution())));
    const double alpha = block.slenderness;
    return {block,
            {std::min(2.2 * alpha * uniform(generator), 1.57),
             2.2 * alpha * (2 * uniform(generator) - 1), side}};
}

/// A rate within `distance` of one at which the region changes.
template <Theory theory>
double rate_next_to_a_limit(const Start& start, int which, double distance)
{
    const SafeRates<double> safe = safe_rates<theory>(start.state.tilt, start.block);
    const double limits[]{safe.outward, -safe.outward, -safe.one.limit, safe.one.limit,
                          -safe.two.limit};
    return limits[which % 5] + distance;
}

/// What the closed form of free rocking does, by at most three impacts.
template <Theory theory>
FreeOutcome outcome_in_closed_form(const Start& start)
{
    FreeRocking<theory, double> rocking(start.state, start.block);
    while (rocking.impacts() < 3 && std::isfinite(rocking.impact_time())) {
        rocking.strike();
    }
    return {std::isfinite(rocking.fall_time()), rocking.impacts(), rocking.arc().side()};
}

void expect_region(Region region, const FreeOutcome& outcome)
{
    ASSERT_EQ(is_unsafe(region), outcome.falls) << name_of(region);
    if (outcome.falls) {
        EXPECT_EQ(falls_to_plus(region), outcome.side > 0) << name_of(region);
        const bool without = region == Region::U0_plus || region == Region::U0_minus;
        const bool after_one = region == Region::U1_plus || region == Region::U1_minus;
        EXPECT_EQ(outcome.impacts, without ? 0 : after_one ? 1 : 2) << name_of(region);
    }
}

template <Theory theory>
void expect_regions_of_the_closed_form()
{
    std::mt19937_64 generator(38);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::map<Region, int> seen;
    for (int i = 0; i < 100'000; ++i) {
        Start start = random_start(generator);
        if (i % 2 == 0) { // margins of 1e-12 and less
            start.state.rate =
                rate_next_to_a_limit<theory>(start, i / 2, 1e-12 * uniform(generator));
        }
        // Both are rounded; the closed form computes q in quadruple precision.
        const double margin = margin_after_pulse<theory>(start.state, start.block);
        if (!(std::abs(margin) > 1e-14)) {
            continue;
        }
        const Region region = region_after_pulse<theory>(start.state, start.block);
        ++seen[region];
        EXPECT_EQ(is_safe(region), margin > 0);
        if (std::abs(start.state.rate) > 2.2 * start.block.slenderness) {
            continue; // moved out of the range in which the arcs are tested
        }
        expect_region(region, outcome_in_closed_form<theory>(start));
    }
    for (const Region region :
         {Region::S, Region::S_plus, Region::S_minus, Region::U0_plus, Region::U0_minus,
          Region::U1_plus, Region::U1_minus, Region::U2_plus, Region::U2_minus}) {
        EXPECT_GT(seen[region], 300) << name_of(region);
    }
}

TEST(TwoSides, HaveTheRegionsOfFreeRockingInTheNonlinearTheory)
{
    expect_regions_of_the_closed_form<Theory::nonlinear>();
}
TEST(TwoSides, HaveTheRegionsOfFreeRockingInTheLinearTheory)
{
    expect_regions_of_the_closed_form<Theory::linear>();
}

TEST(TwoSides, HaveTheRegionsOfTheIntegratedFreeStage)
{
    std::mt19937_64 generator(39);
    int after_two = 0;
    for (int i = 0; i < 4000; ++i) {
        const Start start = random_start(generator);
        if (std::abs(margin_after_pulse<Theory::nonlinear>(start.state, start.block)) < 1e-6) {
            continue; // closer to a limit than the integration is exact
        }
        const Region region = region_after_pulse<Theory::nonlinear>(start.state, start.block);
        after_two += region == Region::U2_plus || region == Region::U2_minus;
        FreeOutcome outcome = watch_free_stage(start.state, start.block);
        expect_region(region, outcome);
    }
    EXPECT_GT(after_two, 20);
}

TEST(TwoSides, OfASymmetricBlockGiveTheFormulasOfThePaper)
{
    std::mt19937_64 generator(40);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 10'000; ++i) {
        const double alpha = 0.01 + 1.2 * uniform(generator);
        const Block<double> block{alpha, 1 - 0.9 * uniform(generator) * uniform(generator)};
        const State<double> state{2 * alpha * uniform(generator),
                                  2 * alpha * (2 * uniform(generator) - 1), 1};
        const double c = 2 * std::sin((alpha - state.tilt) * 0.5);
        const double largest = 2 * std::sin(alpha * 0.5);
        // Eqs. 16, 18 and 20; a few roundings, also those of another sine.
        const double q_min = largest * largest * (1 - 1 / block.restitution);
        const double expected =
            std::min(c - state.rate, state.rate + std::sqrt(c * c - q_min)) / largest;
        EXPECT_NEAR(margin_after_pulse<Theory::nonlinear>(state, block), expected,
                    1e-14 * (1 + std::abs(state.rate / largest) + std::sqrt(-q_min) / largest));
    }
}

TEST(TwoSides, AreSeenFromEachOther)
{
    const Block<double> block = eccentric_body.block(0.7);
    EXPECT_FALSE(block.is_symmetric());
    const Block<double> back = block.turned().turned();
    EXPECT_EQ(back.slenderness, block.slenderness);
    EXPECT_EQ(back.other.frequency_parameter, block.other.frequency_parameter);
    const Block<double> mirrored = eccentric_body.mirrored().block(0.7);
    EXPECT_EQ(mirrored.slenderness, block.turned().slenderness);
    EXPECT_EQ(mirrored.rate_ratio(), block.turned().rate_ratio());
    EXPECT_TRUE((Block<double>{0.2, 0.7}.is_symmetric()));
    EXPECT_EQ((Block<double>{0.2, 0.7}.rate_ratio()), std::sqrt(0.7));
}

TEST(TwoSides, HaveTheEnergyRatiosOfAnEccentricBody)
{
    // Angular velocities of B2, each with eight digits.
    const double r = eccentric_body.largest_restitution();
    EXPECT_NEAR(r, 0.83185649, 1e-8);
    const Block<double> plus = eccentric_body.block(r);
    const Block<double> minus = plus.turned();
    EXPECT_NEAR(plus.rate_ratio() * plus.other.frequency_parameter / plus.frequency_parameter,
                0.92827256, 1e-8);
    EXPECT_NEAR(minus.rate_ratio() * minus.other.frequency_parameter / minus.frequency_parameter,
                0.89613387, 1e-8);
}

TEST(TwoSides, HaveAMarginThatIsContinuousBetweenImpacts)
{
    std::mt19937_64 generator(41);
    std::uniform_real_distribution<double> uniform(-1, 1);
    int inside = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Start start = random_start(generator);
        State<double> moved = start.state;
        const double small = 1e-9;
        moved.tilt += small * uniform(generator);
        moved.rate += small * uniform(generator);
        const SafeRates<double> safe = safe_rates<Theory::nonlinear>(start.state.tilt, start.block);
        const double c = std::abs(safe.outward) + small;
        // |c| changes by less than `small`, c^2 by less than 2 c small, and its signed root by less
        // than the root of twice that.
        const double most = (small + small + std::sqrt(4 * c * small)) / safe.largest;
        EXPECT_NEAR(margin_after_pulse<Theory::nonlinear>(start.state, start.block),
                    margin_after_pulse<Theory::nonlinear>(moved, start.block), most);
        inside += safe.inward().minus_q_min < 0;
    }
    EXPECT_GT(inside, 2000);
}

TEST(TwoSides, ComeToRestAtTheLimitOfTheirImpacts)
{
    const auto expect_limit = []<Theory theory>(double r) {
        const Block<double> block = eccentric_body.block(r);
        const State<double> begin{0.03, 0, 1};
        FreeRocking<theory, double> rocking(begin, block);
        while (rocking.arc().impact_speed() > 1e-16) {
            rocking.strike();
        }
        // Each of the n summed terms is rounded to half an epsilon of the sum.
        EXPECT_NEAR((time_of_rest<theory>(begin, block)), rocking.begin(),
                    rocking.impacts() * rocking.begin() * 0x1p-53);
    };
    for (const double r : {0.3, 0.8, 0.97}) {
        expect_limit.operator()<Theory::nonlinear>(r);
        expect_limit.operator()<Theory::linear>(r);
    }
}

TEST(TwoSides, TurnAndLieFlatWhereTheArcsDo)
{
    std::mt19937_64 generator(42);
    int fallen = 0;
    for (int i = 0; i < 2000; ++i) {
        const Start start = random_start(generator);
        const double margin = margin_after_pulse<Theory::nonlinear>(start.state, start.block);
        if (std::abs(margin) < 1e-3) {
            continue;
        }
        FreeRocking<Theory::nonlinear, double> rocking(start.state, start.block);
        double highest = 0;
        while (rocking.impacts() < 3 && std::isfinite(rocking.impact_time())) {
            const double q = rocking.arc().q();
            if (q > 0 && (rocking.impacts() > 0 || start.state.rate > 0)) {
                const double alpha = rocking.block().slenderness;
                highest = std::max(highest, (alpha - 2 * std::asin(std::sqrt(q) / 2)) / alpha);
            }
            rocking.strike();
        }
        if (margin > 0) {
            EXPECT_NEAR(largest_free_tilt<Theory::nonlinear>(start.state, start.block), highest,
                        1e-9);
        } else {
            ++fallen;
            const double fall =
                time_to_lie_flat<Theory::nonlinear, double>(start.state, start.block);
            EXPECT_NEAR(fall, rocking.fall_time(), 1e-9 * rocking.fall_time());
        }
    }
    EXPECT_GT(fallen, 300);
}

} // namespace
} // namespace overturn
