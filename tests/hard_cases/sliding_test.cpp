// Blocks that may slip, where modes meet.
#include "overturn/integrate/sliding_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

namespace overturn {
namespace {

constexpr double g = 9.81;

/// A body over its mass, on an inclined base. [m], [s]
struct Body {
    double plus, minus, height, gyration; ///< gyration: k
    double incline = 0;
    double share_of_r_max = 1;

    double r_max() const
    {
        const double k2 = gyration * gyration;
        const double kept = k2 + height * height - plus * minus;
        return kept * kept /
               ((k2 + plus * plus + height * height) * (k2 + minus * minus + height * height));
    }

    Block<double> block() const
    {
        const auto side = [&](double base, double angle) -> BlockSide<double> {
            const double size = std::hypot(base, height);
            return {std::atan(base / height) - angle, size,
                    std::sqrt(g * size / (gyration * gyration + size * size))};
        };
        return {side(plus, incline), share_of_r_max * r_max(), side(minus, -incline)};
    }
};

constexpr Body box{0.3, 0.3, 0.9, 0.54772255750516607};

SlidingEnd<double> end_of(const Body& body, double friction, double pga,
                          PulseKind kind = PulseKind::one_sine, double period = 0.5)
{
    const Block<double> block = body.block();
    const double least = std::min(block.slenderness, block.other.slenderness);
    const auto excitation = pulse_excitation<Theory::nonlinear>(
        pulse_motion<double>(kind), block, pga / std::tan(least), 2 * pi<double>() / period);
    const auto end =
        run_sliding<double>(block, body.gyration / block.size, friction, excitation, 1e-12);
    EXPECT_FALSE(end.capped);
    EXPECT_TRUE(std::isfinite(end.slide)) << friction;
    return end;
}

TEST(Sliding, AtTheCoefficientThatLiftsTheBlockIsContinuous)
{
    const double lifts = 0.3 / 0.9;
    for (const double pga : {0.34, 0.4, 0.6, 1.0}) {
        const auto flat = end_of(box, lifts, pga);
        EXPECT_EQ(flat.region, Region::S);
        EXPECT_EQ(flat.peak, 0);
        EXPECT_EQ(end_of(box, std::nextafter(lifts, 0), pga).peak, 0);
        // The block tilts by an angle in proportion to the excess of the coefficient, falls back
        // from there at a speed in proportion to its root, and goes on turning at this speed where
        // the moment about a corner that slips outward is almost zero.
        for (const double more : {1e-15, 1e-12, 1e-9, 1e-6}) {
            const auto end = end_of(box, lifts * (1 + more), pga);
            EXPECT_EQ(end.region, Region::S);
            EXPECT_LT(end.peak, 5 * std::sqrt(more));
            EXPECT_NEAR(end.slide, flat.slide, 5 * std::sqrt(more));
        }
    }
}

TEST(Sliding, AtTheCoefficientThatItNeedsIsContinuous)
{
    // At 0.9 g the box needs 0.4635: below it, the corner slips once, for a moment.
    double needed = 0.5;
    for (double low = 0.4; needed - low > 1e-14;) {
        const double middle = (low + needed) / 2;
        (end_of(box, middle, 0.9).slipped ? low : needed) = middle;
    }
    EXPECT_FALSE(end_of(box, needed, 0.9).slipped);
    const auto without = end_of(box, 10, 0.9);
    for (const double less : {1e-13, 1e-10, 1e-7}) {
        const auto end = end_of(box, needed - less, 0.9);
        EXPECT_EQ(end.region, without.region);
        EXPECT_LT(end.slide_peak, less);
        EXPECT_NEAR(end.state.tilt, without.state.tilt, 10 * less + 1e-12);
    }
}

TEST(Sliding, AtTheCoefficientOfAnImpactIsContinuous)
{
    // It lifts on the side minus, and strikes the corner plus, which is farther from its centre.
    const Body body{0.35, 0.15, 0.8, 0.4};
    const double of_impact = 0.8 * 0.35 / (0.16 + 0.64);
    ASSERT_GT(of_impact, 0.15 / 0.8);
    const auto sticks = end_of(body, of_impact * (1 + 1e-12), 0.35);
    EXPECT_GT(sticks.impacts, 0);
    const auto slips = end_of(body, of_impact * (1 - 1e-12), 0.35);
    EXPECT_EQ(sticks.region, slips.region);
    EXPECT_NEAR(sticks.state.tilt, slips.state.tilt, 1e-9);
    EXPECT_NEAR(sticks.slide, slips.slide, 1e-9);
}

TEST(Sliding, OnAnInclineNearTheAngleOfFrictionEnds)
{
    for (const double more : {1e-3, 1e-6, 1e-9}) {
        Body body = box;
        body.incline = 0.2;
        const auto end = end_of(body, std::tan(body.incline) * (1 + more), 0.3);
        EXPECT_EQ(end.region, Region::S);
        EXPECT_GT(end.slide, 0) << "downhill";
    }
}

TEST(Sliding, OfABlockThatIsPushedOffItsInclineIsUndecided)
{
    // The push towards the side plus, which is downhill, relieves the base of A sin(incline).
    Body body{0.9, 0.9, 0.9, 0.6};
    body.incline = 0.3;
    const double off = 1 / std::tan(body.incline);
    EXPECT_EQ(end_of(body, 0.35, -0.99 * off, PulseKind::half_sine).region, Region::S);
    const auto end = end_of(body, 0.35, -1.01 * off, PulseKind::half_sine);
    EXPECT_EQ(end.region, Region::undecided);
    EXPECT_TRUE(end.lifted_off);
}

TEST(Sliding, WithManyBouncesEnds)
{
    for (const double share : {0.05, 0.5, 1.0}) {
        Body body = box;
        body.share_of_r_max = share;
        for (const double friction : {0.335, 0.35, 0.5}) {
            const auto end = end_of(body, friction, 0.5, PulseKind::one_sine, 4.0);
            EXPECT_NE(end.region, Region::undecided);
            EXPECT_LT(end.steps, 20000);
        }
    }
}

TEST(Sliding, OfABlockThatLiftsOnOneSideOnlyIsDecided)
{
    const Body body{0.5, 0.15, 0.8, 0.4}; // lifts at minus only: 0.1875 < friction < 0.625
    for (int i = 1; i <= 40; ++i) {
        for (const double friction : {0.19, 0.3, 0.6}) {
            for (const double sign : {1, -1}) {
                const auto end = end_of(body, friction, sign * 0.05 * i);
                EXPECT_NE(end.region, Region::undecided) << friction << ", " << sign * 0.05 * i;
                EXPECT_NE(end.region, Region::F_plus);
            }
        }
    }
}

TEST(Sliding, AfterAnImpactThatNearlyEndsTheRotationIsDecided)
{
    // k^2 + h^2 - b^2 is 1e-6, 1e-9, 1e-12 of b^2: an impact leaves hardly any rotation.
    for (const double kept : {1e-6, 1e-9, 1e-12}) {
        const Body body{1.0, 1.0, 0.8, std::sqrt(0.36 + kept)};
        for (const double friction : {1.3, 2.0}) {
            const auto end = end_of(body, friction, 1.6, PulseKind::one_sine, 0.8);
            EXPECT_EQ(end.region, Region::S);
            EXPECT_GT(end.impacts, 0);
            EXPECT_LT(end.steps, 200);
        }
    }
}

/// Kinetic energy, that of sliding included, and potential energy, over the mass.
double energy_of(const SlidingMotion<double, PulseExcitation<double>>& motion,
                 const SlidingSide<double>& plus)
{
    const SlidingSide<double> side = motion.side() > 0 ? plus : plus.turned();
    const OnCorner<double> at = on_corner(side, motion.tilt());
    const double rate = motion.rate();
    const double along = motion.side() * motion.base_velocity() + rate * at.y;
    const double upwards = -rate * at.x;
    return (along * along + upwards * upwards + side.gyration * rate * rate) / 2 +
           side.gravity * at.y;
}

/// Of blocks with different sides, in a million steps and impacts.
TEST(Sliding, OnALevelBaseNeverAddsEnergyOnceTheGroundHasStopped)
{
    constexpr double period = 0.5;
    std::mt19937_64 generator(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::array<int, 4> steps{}; // by mode
    while (std::accumulate(steps.begin(), steps.end(), 0) < 400'000) {
        Body body{0.1 + 0.4 * uniform(generator), 0.1 + 0.4 * uniform(generator), 0.9, 0.5};
        body.share_of_r_max = 0.6 + 0.4 * uniform(generator);
        const Block<double> block = body.block();
        const double least = std::min(block.slenderness, block.other.slenderness);
        const double friction = std::tan(least) * (0.8 + uniform(generator));
        const double pga = (uniform(generator) < 0.5 ? -1 : 1) * (0.2 + 2 * uniform(generator));
        const auto excitation =
            pulse_excitation<Theory::nonlinear>(pulse_motion<double>(PulseKind::half_sine), block,
                                                pga / std::tan(least), 2 * pi<double>() / period);
        SlidingMotion<double, PulseExcitation<double>> motion(
            block, body.gyration / block.size, friction, excitation, 1e-10, Follow::until_rest);
        const SlidingSide<double> plus = sliding_side(block, body.gyration / block.size, friction);
        double before = std::numeric_limits<double>::infinity();
        while (!motion.is_over()) {
            if (motion.phase() >= excitation.motion.end) {
                const double now = energy_of(motion, plus);
                ASSERT_LE(now, before * (1 + 1e-11)) << friction << ", " << pga;
                before = now;
                ++steps[std::size_t(motion.mode())];
            }
            motion.advance();
        }
    }
    EXPECT_TRUE(std::ranges::all_of(steps, [](int count) { return count > 4'000; }));
}

} // namespace
} // namespace overturn
