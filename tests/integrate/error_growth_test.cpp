// GCC 12 sees an overlap in std::string that is not there (its bug 105329).
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wrestrict"
#endif

#include "overturn/integrate/error_growth.hpp"

#include "support/one_point.hpp"
#include "support/random_point.hpp"

#include <gtest/gtest.h>

#include <random>

namespace overturn {
namespace {

TEST(ErrorGrowth, HoldsEveryErrorThatStepsMayAddUpTo)
{
    std::mt19937_64 generator(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    ErrorGrowth<double> growth;
    // The same errors with random signs, a hundred times.
    std::vector<std::pair<double, double>> errors(100, {0, 0});
    for (int step = 0; step < 30; ++step) {
        const Variation<double> by = variation_over<double>(0.3, uniform(generator), 1, 1);
        const double tilt = std::abs(uniform(generator));
        const double rate = std::abs(uniform(generator));
        growth.pass(by, true);
        growth.add(tilt, rate, 0, 0, true);
        for (auto& [x, v] : errors) {
            const double x_before = x;
            x = by.tilt_by_tilt * x_before + by.tilt_by_rate * v + tilt * uniform(generator);
            v = by.rate_by_tilt * x_before + by.rate_by_rate * v + rate * uniform(generator);
        }
    }
    for (const auto& [a, b] : {std::pair(1.0, 0.0), {0.0, 1.0}, {1.0, -1.0}, {0.3, 2.0}}) {
        for (const auto& [x, v] : errors) {
            EXPECT_LE(std::abs(a * x + b * v), growth.bound(a, b));
        }
    }
}

TEST(ErrorGrowth, OfErrorsOfOneKindIsTheirSum)
{
    ErrorGrowth<double> growth;
    const Variation<double> still{1, 0, 0, 1};
    for (int step = 0; step < 10; ++step) {
        growth.pass(still, true);
        growth.add(0, 0.5, 0, 0, true);
    }
    // Ten errors of 0.5 in the rate; a 2^-13 more for what variations are not sure of.
    EXPECT_NEAR(growth.bound(0, 1), 5, 5 * 0x1p-12);
    EXPECT_EQ(growth.bound(1, 0), 0);
}

TEST(ErrorGrowth, EndsWhereTheBlockRests)
{
    ErrorGrowth<double> growth;
    growth.add(0.1, 0.2, 0, 0, true);
    growth.forget(true);
    EXPECT_EQ(growth.bound(1, 1), 0);
}

TEST(ErrorGrowth, SaysNothingGoodOfWhatIsNotANumber)
{
    ErrorGrowth<double> growth;
    growth.add(0.1, std::numeric_limits<double>::infinity(), 0, 0, true);
    EXPECT_FALSE(growth.bound(1, 1) < 1e300);
}

TEST(ForcedStage, BoundsItsErrorAgainstFiftyDigits)
{
    // A bound of first order may be missed once in 10^5 points; here are 2000.
    std::mt19937_64 generator(9);
    for_every_scene([&]<class Pulse, Theory theory>() {
        for (int i = 0; i < 25; ++i) {
            const Point<double> point = random_point(generator);
            const auto exact = forced_end<Pulse, theory>(in_digits(point), 1e-25);
            const auto margin = double(margin_of<theory>(exact, in_digits(point)));
            const auto check = [&]<class Method>(double tolerance) {
                const auto end = forced_end<Pulse, theory, Method, true>(point, tolerance);
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

TEST(ForcedStage, EndsAlikeWhetherItsErrorIsWatchedOrNot)
{
    std::mt19937_64 generator(10);
    for_every_scene([&]<class Pulse, Theory theory>() {
        const Point<double> point = random_point(generator);
        const auto check = [&]<class Method>() {
            const auto plain = forced_end<Pulse, theory, Method>(point, 1e-6);
            const auto watched = forced_end<Pulse, theory, Method, true>(point, 1e-6);
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
