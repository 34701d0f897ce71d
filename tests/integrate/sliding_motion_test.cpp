#include "overturn/integrate/sliding_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace overturn {
namespace {

/// The box 0.6 m x 1.8 m, with numbers in units of R and 1/p.
struct Box {
    static constexpr double g = 9.81;
    static constexpr double gyration = 0.57735026918962576;
    double R = std::hypot(0.3, 0.9);
    double p = std::sqrt(3 * g / (4 * R));
    double incline = 0;

    Block<double> block(double share_of_r_max = 1) const
    {
        const double alpha = std::atan(1.0 / 3);
        const double r = share_of_r_max * largest_restitution(alpha);
        return {BlockSide<double>{alpha - incline}, r, BlockSide<double>{alpha + incline}};
    }

    PulseExcitation<double> pulse(PulseKind kind, double period, double pga) const
    {
        const Block<double> at = block();
        const double least = std::min(at.slenderness, at.other.slenderness);
        return pulse_excitation<Theory::nonlinear>(
            pulse_motion<double>(kind), at, pga / std::tan(least), 2 * pi<double>() / (period * p));
    }

    SlidingEnd<double> under(PulseKind kind, double period, double pga, double friction,
                             double tolerance = 1e-12) const
    {
        return run_sliding<double>(block(), gyration, friction, pulse(kind, period, pga),
                                   tolerance);
    }
};

/// An independent event-driven program found these flips in steps of 0.01 g from 0.3 to 2.5 g.
TEST(SlidingMotion, FlipsWhereAnIndependentProgramDoes)
{
    const Box box;
    const auto topples = [&](double pga, double friction) {
        const auto end = box.under(PulseKind::one_sine, 0.5, pga, friction);
        EXPECT_NE(end.region, Region::undecided);
        return is_unsafe(end.region);
    };
    const std::pair<double, std::vector<double>> flips[] = {
        {5, {0.903473050, 1.839675309, 2.129684844}},
        {0.6, {0.903473050, 1.840337805, 2.197886429}},
        {0.5, {0.903473050, 2.247929522}},
        {0.45, {0.903568714}},
        {0.4, {0.949190031}},
        {0.36, {1.147676284}},
        {0.34, {1.604914382}},
        {1.0 / 3, {}}};
    for (const auto& [friction, at] : flips) {
        bool expected = false;
        auto next = at.begin();
        for (int i = 30; i <= 250; ++i) {
            const double pga = 0.01 * i;
            if (next != at.end() && *next < pga) {
                EXPECT_EQ(topples(*next - 2e-9, friction), expected) << friction << ", " << *next;
                expected = !expected;
                EXPECT_EQ(topples(*next + 2e-9, friction), expected) << friction << ", " << *next;
                ++next;
            }
            EXPECT_EQ(topples(pga, friction), expected) << friction << ", " << pga;
        }
    }
}

TEST(SlidingMotion, MovesTheBaseAsInClosedFormOrAsAnIndependentProgramFound)
{
    const Box box;
    const auto slide = [](const SlidingEnd<double>& end, const Box& of) {
        EXPECT_TRUE(end.slipped);
        EXPECT_EQ(end.impacts, 0);
        return end.slide * of.R;
    };
    // g (A - mu) A t_d^2 / (2 mu) under a rectangular pulse.
    for (const auto& [A, t_d, mu] : {std::array{0.5, 0.2, 0.2}, {0.8, 0.2, 0.3}, {0.4, 1.0, 0.1}}) {
        EXPECT_NEAR(slide(box.under(PulseKind::rectangular, 2 * t_d, A, mu), box),
                    -Box::g * (A - mu) * A * t_d * t_d / (2 * mu), 1e-13);
    }
    EXPECT_NEAR(slide(box.under(PulseKind::half_sine, 0.5, 0.6, 0.25), box), -0.0774640327, 1e-10);
    const auto end = box.under(PulseKind::one_sine, 0.5, 0.6, 0.2);
    EXPECT_NEAR(slide(end, box), -0.0201010964, 1e-10);
    EXPECT_NEAR(end.slide_peak * box.R, 0.0883227284, 1e-10);
    const Box inclined{.incline = 0.05};
    EXPECT_NEAR(slide(inclined.under(PulseKind::one_sine, 0.5, 0.5, 0.3), inclined), 0.0323666561,
                2e-10);
}

TEST(SlidingMotion, OfTheMirroredMotionIsMirrored)
{
    std::mt19937_64 generator(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 200; ++i) {
        const Box box{.incline = i % 2 == 0 ? 0 : 0.1 * uniform(generator)};
        const Box turned{.incline = -box.incline};
        const double friction = 0.2 + 0.5 * uniform(generator);
        const double period = 0.3 + uniform(generator);
        const double pga = 0.3 + 1.5 * uniform(generator);
        const auto one = box.under(PulseKind::one_cosine, period, pga, friction);
        const auto other = turned.under(PulseKind::one_cosine, period, -pga, friction);
        // On an incline, the distances of the corners are rounded in another order.
        const double rounding = box.incline == 0 ? 0 : 1e-9;
        EXPECT_NEAR(one.slide, -other.slide, rounding);
        EXPECT_NEAR(one.slide_peak, other.slide_peak, rounding);
        EXPECT_EQ(is_unsafe(one.region), is_unsafe(other.region));
        EXPECT_EQ(one.impacts, other.impacts);
    }
}

/// The mode with which a block at rest begins to move under a jump of the ground acceleration to A
/// g (Shenton 1996): it rests up to the smaller of mu and b/h; above mu < b/h it slides; above b/h
/// it rocks if mu is at least |F| / N of a corner that sticks, else it slips as it rocks, with
///
///     F / m g = A - lambda h (A h - b) / R^2,   N / m g = 1 + lambda b (A h - b) / R^2
///
/// in magnitude, lambda = m R^2 / I.
SlidingMode mode_at_onset(double A, double friction, double b, double h)
{
    const double lambda = 0.75;
    const double turning = lambda * (A * h - b) / (b * b + h * h);
    return A <= std::min(friction, b / h)                    ? SlidingMode::rest
           : friction <= b / h                               ? SlidingMode::slide
           : A - turning * h <= friction * (1 + turning * b) ? SlidingMode::rock
                                                             : SlidingMode::slide_rock;
}

TEST(SlidingMotion, BeginsInTheModeOfShentonsMap)
{
    const Box box;
    std::array<int, 4> found{};
    for (int i = 1; i <= 60; ++i) {
        for (int j = 1; j <= 40; ++j) {
            const double A = 0.0503 * i;
            const double friction = 0.0251 * j;
            SlidingMotion<double, PulseExcitation<double>> motion(
                box.block(), Box::gyration, friction, box.pulse(PulseKind::rectangular, 1, A),
                1e-12);
            motion.advance(); // from rest
            const SlidingMode expected = mode_at_onset(A, friction, 0.3, 0.9);
            EXPECT_EQ(motion.mode(), expected) << A << ", " << friction;
            ++found[std::size_t(expected)];
        }
    }
    EXPECT_TRUE(std::ranges::all_of(found, [](int count) { return count > 100; }));
}

TEST(SlidingMotion, DoesNotDependOnTheUnits)
{
    // The same block in metres and seconds: sizes and frequencies are not powers of two.
    const Box box;
    const double p = box.p;
    for (const double pga : {0.6, 0.95, 1.5, 2.3}) {
        const auto one = box.under(PulseKind::one_sine, 0.5, pga, 0.4);
        const Block<double> of = box.block();
        const BlockSide<double> side{of.slenderness, box.R, p};
        const auto in_metres = pulse_excitation<Theory::nonlinear>(
            pulse_motion<double>(PulseKind::one_sine), Block<double>(side, of.restitution, side),
            pga / std::tan(of.slenderness), 2 * pi<double>() / 0.5);
        const auto other = run_sliding<double>(Block<double>(side, of.restitution, side),
                                               Box::gyration, 0.4, in_metres, 1e-12);
        EXPECT_EQ(one.region, other.region);
        EXPECT_NEAR(one.slide * box.R, other.slide, 1e-11);
        EXPECT_NEAR(one.peak, other.peak, 1e-11);
    }
}

} // namespace
} // namespace overturn
