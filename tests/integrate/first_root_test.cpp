#include "overturn/integrate/first_root.hpp"
#include "support/untrapped_floating_point.hpp"

#include <gtest/gtest.h>

#include <random>

namespace overturn {
namespace {

/// Bernstein coefficients of the polynomial k (r[0] - s)(r[1] - s)..., at most five roots.
Quintic<double> with_roots(const std::vector<double>& roots, double factor = 1)
{
    std::array<double, 6> power{factor};
    for (const double root : roots) {
        for (std::size_t k = 5; k > 0; --k) {
            power[k] = root * power[k] - power[k - 1];
        }
        power[0] *= root;
    }
    constexpr double binomial[6][6] = {{1},          {1, 1},          {1, 2, 1},
                                       {1, 3, 3, 1}, {1, 4, 6, 4, 1}, {1, 5, 10, 10, 5, 1}};
    Quintic<double> c{};
    for (std::size_t j = 0; j < 6; ++j) {
        for (std::size_t k = 0; k <= j; ++k) {
            c[j] += binomial[j][k] / binomial[5][k] * power[k];
        }
    }
    return c;
}

double first_fall(const Quintic<double>& c)
{
    return first_fall_below_zero(c, 1e-15, true);
}

const double third_of_digits = 1e-5; // relative accuracy of first_fall_below_zero

TEST(FirstFallBelowZero, FindsTheOnlyRoot)
{
    for (const double root : {1e-6, 0.1, 0.5, 0.97, 1.0 - 1e-9}) {
        EXPECT_NEAR(first_fall(with_roots({root})), root, third_of_digits * root);
    }
}

TEST(FirstFallBelowZero, FindsTheFirstOfSeveralRoots)
{
    EXPECT_NEAR(first_fall(with_roots({0.2, 0.5, 0.9})), 0.2, third_of_digits);
    EXPECT_NEAR(first_fall(with_roots({0.31, 0.3100001, 0.9})), 0.31, third_of_digits);
    EXPECT_NEAR(first_fall(with_roots({0.2, 0.4, 0.6, 0.8, 0.99})), 0.2, third_of_digits);
}

TEST(FirstFallBelowZero, FindsADipWithinTheStep)
{
    // Both ends are above zero: a check of the ends alone would miss it.
    for (const double width : {0.3, 1e-2, 1e-4, 1e-6}) {
        const double found = first_fall(with_roots({0.61 - width / 2, 0.61 + width / 2}));
        EXPECT_NEAR(found, 0.61 - width / 2, third_of_digits) << "width " << width;
    }
}

TEST(FirstFallBelowZero, FindsNoneIfThePolynomialOnlyComesClose)
{
    Quintic<double> close = with_roots({0.4, 0.4}); // touches zero at 0.4
    for (double& c : close) {
        c += 1e-12;
    }
    EXPECT_GT(first_fall(close), 1);
    EXPECT_GT(first_fall(with_roots({1.0001})), 1);
    EXPECT_GT(first_fall(with_roots({-0.2}, -1)), 1); // above zero and rising
}

TEST(FirstFallBelowZero, LeavingTheGroundIsNotAFall)
{
    EXPECT_GT(first_fall(Quintic<double>{0, 0.1, 0.2, 0.3, 0.4, 0.5}), 1);
    EXPECT_GT(first_fall(Quintic<double>{0, 0, 0, 0.3, 0.4, 0.5}), 1);       // uplift: s^3
    EXPECT_NEAR(first_fall(with_roots({0, 0.7}, -1)), 0.7, third_of_digits); // a hop
}

TEST(FirstFallBelowZero, NeverMissesARootFoundBySampling)
{
    std::mt19937_64 generator(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    int falls = 0;
    for (int i = 0; i < 20000; ++i) {
        Quintic<double> c;
        for (double& x : c) {
            x = uniform(generator);
        }
        c[0] = std::abs(c[0]);
        double seen = 2;
        for (int k = 1; k <= 400 && seen > 1; ++k) {
            if (restricted(c, 0.0, k / 400.0).back() < -1e-12) {
                seen = k / 400.0;
            }
        }
        const double found = first_fall(c);
        falls += seen <= 1;
        ASSERT_LE(found, seen + 1e-12);
        if (found <= 1) {
            // The result must be a root.
            EXPECT_NEAR(restricted(c, 0.0, found).back(), 0, 2e-4);
        }
    }
    EXPECT_GT(falls, 5000);
}

TEST(FirstFallBelowZero, ALaneFullOfNaNEndsTheSearch)
{
    const UntrappedFloatingPoint comparisons_with_nan;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_GT(first_fall(Quintic<double>{0, nan, nan, nan, nan, nan}), 1);
}

} // namespace
} // namespace overturn
