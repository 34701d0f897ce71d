// GCC 12 reports a non-existing overlap in std::string (its bug 105329).
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wrestrict"
#endif

#include "overturn/integrate/error_growth.hpp"

#include "support/one_point.hpp"
#include "support/random_point.hpp"
#include "support/untrapped_floating_point.hpp"

#include <gtest/gtest.h>

#include <random>

namespace overturn {
namespace {

TEST(ErrorGrowth, BoundsTheWorstSumOfErrors)
{
    struct StepOfErrors {
        Variation<double> by;
        double tilt, rate;
    };
    std::mt19937_64 generator(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int run = 0; run < 200; ++run) {
        ErrorGrowth<double> growth;
        std::vector<StepOfErrors> steps(30);
        for (StepOfErrors& step : steps) {
            step = {variation_over<double>(0.3, uniform(generator), 1, 1),
                    std::abs(uniform(generator)), std::abs(uniform(generator))};
            growth.pass(step.by, true);
            growth.add(step.tilt, step.rate, true);
        }
        // Propagated back to a step, the combination determines the worst signs of its errors.
        for (const auto& [a, b] : {std::pair(1.0, 0.0), {0.0, 1.0}, {1.0, -1.0}, {0.3, 2.0}}) {
            double worst = 0;
            double by_tilt = a;
            double by_rate = b;
            for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
                worst += std::abs(by_tilt) * step->tilt + std::abs(by_rate) * step->rate;
                const Variation<double>& by = step->by;
                const double before = by_tilt * by.tilt_by_tilt + by_rate * by.rate_by_tilt;
                by_rate = by_tilt * by.tilt_by_rate + by_rate * by.rate_by_rate;
                by_tilt = before;
            }
            EXPECT_LE(worst, growth.bound(a, b) * (1 + 1e-12));
        }
    }
}

TEST(ErrorGrowth, OfErrorsOfOneKindIsTheirSum)
{
    ErrorGrowth<double> growth;
    const Variation<double> still{1, 0, 0, 1};
    for (int step = 0; step < 10; ++step) {
        growth.pass(still, true);
        growth.add(0, 0.5, true);
    }
    // Ten errors of 0.5 in the rate; 2^-13 more for the uncertainty of variations.
    EXPECT_NEAR(growth.bound(0, 1), 5, 5 * 0x1p-12);
    EXPECT_EQ(growth.bound(1, 0), 0);
}

TEST(ErrorGrowth, KeepsALongThinEllipseThin)
{
    // A thousand low bounces: with a larger rate, a block gains more and more tilt.
    ErrorGrowth<double> growth;
    const double shear = 100;
    const int steps = 1000;
    const double own = 1e-16;
    for (int step = 0; step < steps; ++step) {
        growth.pass({1, shear, 0, 1}, true);
        growth.add(own, own, true);
    }
    // At worst the rate is off by the sum of all, the tilt by that times the steps since. A bound
    // by the root of steps * sum of squares, as here, is at most twice that; the 65th step begins a
    // new weight, which adds another factor of sqrt(1 + 64 / steps). The ellipse of the rectangle
    // is sqrt(2) larger than the rectangle.
    const double rate = steps * own;
    const double tilt = shear * own * steps * (steps - 1) / 2 + steps * own;
    EXPECT_GE(growth.bound(0, 1), rate);
    EXPECT_LE(growth.bound(0, 1), 3 * rate);
    EXPECT_GE(growth.bound(1, 0), tilt);
    EXPECT_LE(growth.bound(1, 0), 3 * tilt);
}

TEST(ErrorGrowth, ShrinksAgainWithTheErrors)
{
    // Up to the top and down again: errors stretched by e^20 are as small as before.
    ErrorGrowth<double> growth;
    growth.add(1e-10, 1e-10, true);
    const double before = growth.bound(1, 1);
    const Variation<double> up = variation_over<double>(4, 1, 1, 1);
    for (int i = 0; i < 5; ++i) {
        growth.pass(up, true);
    }
    const double at_the_top = growth.bound(1, 1);
    EXPECT_NEAR(at_the_top / before, std::exp(20.0), 1e-3 * std::exp(20.0));
    for (int i = 0; i < 5; ++i) {
        growth.pass({up.tilt_by_tilt, -up.tilt_by_rate, -up.rate_by_tilt, up.rate_by_rate}, true);
    }
    EXPECT_GE(growth.bound(1, 1), before);
    // The round-off of squares at the top, stretched in the other direction.
    EXPECT_LE(growth.bound(1, 1), std::sqrt(8 * 0x1p-52) * at_the_top * std::exp(20.0));
}

TEST(ErrorGrowth, OfTheTimeIsAlongTheMotion)
{
    ErrorGrowth<double> growth;
    const double time = 1e-14;
    const double speed = 0.5;
    const double acceleration = -2;
    growth.add_round_off({0, 0, time}, speed, acceleration, true);
    EXPECT_NEAR(growth.bound(1, 0), time * speed, time * speed * 0x1p-12);
    EXPECT_NEAR(growth.bound(0, 1), time * 2, time * 2 * 0x1p-12);
    // The energy is constant, except for 2^-12 of the squares, the uncertainty of variations.
    const double energy = growth.bound(acceleration, -speed);
    EXPECT_LE(energy, 1.01 * 0x1p-6 * std::sqrt(2.0) * time * std::abs(speed * acceleration));
}

TEST(ErrorGrowth, EndsWhenTheBlockComesToRest)
{
    ErrorGrowth<double> growth;
    growth.add(0.1, 0.2, true);
    growth.forget(true);
    EXPECT_EQ(growth.bound(1, 1), 0);
}

TEST(ErrorGrowth, IsInfiniteForNaN)
{
    const UntrappedFloatingPoint untrapped;
    ErrorGrowth<double> growth;
    growth.add(0.1, std::numeric_limits<double>::infinity(), true);
    EXPECT_FALSE(growth.bound(1, 1) < 1e300);
}

/// Whether it is uncertain that an event happened in a step with an error of the tilt of 1e-6.
bool is_doubtful_after(const Rocking<double>& start, double end_tilt, double end_rate,
                       double turning_tilt)
{
    const Block<double> block{0.2, 0.9};
    const auto excitation = pulse_excitation<Theory::linear>(
        pulse_motion<double>(PulseKind::one_sine), Block<double>{0.2, 1}, 2.0, 3.0);
    StepEnd<double, Outputs{.error = true}> step{};
    step.phase = start.phase + 1;
    step.tilt = end_tilt;
    step.rate = end_rate;
    step.moved = true;
    step.strikes = end_tilt == 0;
    step.falls = end_tilt == pi<double>() / 2;
    step.errors = {.variation = {1, 0, 0, 1},
                   .tilt = 1e-6,
                   .rate = 0,
                   .acceleration = 0,
                   .turning_tilt = turning_tilt};
    MarginError<Theory::linear, double> error;
    error.pass_step(block, excitation, start, step, true);
    return error.is_doubtful();
}

TEST(MarginError, IsUnknownIfABlockTurnedCloserToAnEventThanItsError)
{
    const double flat = pi<double>() / 2;
    const Rocking<double> outward{.phase = 1, .tilt = 0.5, .rate = 0.4, .side = 1};
    const Rocking<double> inward{.phase = 1, .tilt = 0.5, .rate = -0.4, .side = 1};
    for (const double end : {0.3, 0.0}) { // also if the step ends at an impact
        EXPECT_TRUE(is_doubtful_after(outward, end, -0.4, flat - 5e-7));
        EXPECT_FALSE(is_doubtful_after(outward, end, -0.4, flat - 5e-6));
    }
    for (const double end : {0.3, flat}) { // also if it ends with a fall
        EXPECT_TRUE(is_doubtful_after(inward, end, 0.4, 5e-7));
        EXPECT_FALSE(is_doubtful_after(inward, end, 0.4, 5e-6));
    }
    // Also if the block turned twice.
    EXPECT_TRUE(is_doubtful_after(inward, 0.3, -0.4, 5e-7));
    EXPECT_FALSE(is_doubtful_after(inward, 0.3, -0.4, 5e-6));
    EXPECT_TRUE(is_doubtful_after(outward, 0.7, 0.4, 5e-7));
}

TEST(ForcedStage, BoundsItsErrorAgainstFiftyDigits)
{
    // A bound of first order may be exceeded once in 10^5 points; here are 300, four times each.
    std::mt19937_64 generator(9);
    for_every_scene([&]<Theory theory>(PulseKind pulse) {
        for (int i = 0; i < 25; ++i) {
            const PulsePoint<double> point = random_point(generator);
            const auto exact = forced_end<theory>(pulse, in_digits(point), 1e-25);
            const auto margin = double(margin_of<theory>(exact, in_digits(point)));
            const auto check = [&]<class Method>(double tolerance) {
                const auto end = forced_end<theory, Method, true>(pulse, point, tolerance);
                EXPECT_LE(std::abs(margin_of<theory>(end, point) - margin), end.error)
                    << "tolerance " << tolerance << ", alpha " << point.slenderness << ", r "
                    << point.restitution << ", Omega " << point.frequency << ", a "
                    << point.amplitude;
            };
            check.template operator()<RungeKutta>(1e-6);
            check.template operator()<RungeKutta>(1e-10);
            check.template operator()<Taylor<14>>(1e-4);
            check.template operator()<Taylor<20>>(1e-9);
        }
    });
}

TEST(ForcedStage, HasTheSameEndWithAndWithoutItsError)
{
    std::mt19937_64 generator(10);
    for_every_scene([&]<Theory theory>(PulseKind pulse) {
        const PulsePoint<double> point = random_point(generator);
        const auto check = [&]<class Method>() {
            const auto plain = forced_end<theory, Method>(pulse, point, 1e-6);
            const auto watched = forced_end<theory, Method, true>(pulse, point, 1e-6);
            EXPECT_EQ(plain.state.tilt, watched.state.tilt);
            EXPECT_EQ(plain.state.rate, watched.state.rate);
            EXPECT_EQ(plain.steps, watched.steps);
        };
        check.template operator()<RungeKutta>();
        check.template operator()<Taylor<14>>();
        check.template operator()<Taylor<20>>();
    });
}

} // namespace
} // namespace overturn
