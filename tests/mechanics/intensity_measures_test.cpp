// Intensity measures: closed forms, and invariances that need none.
#include "overturn/mechanics/intensity_measures.hpp"

#include "support/observed_order.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace overturn {
namespace {

constexpr double gravity = 9.80665;
constexpr double pi = std::numbers::pi;
// Sums of a few hundred terms of one sign lose at most as many roundings.
constexpr double round_off = 1e-13;

/// A sine of this amplitude [g] from 0 to pi, over 1 s.
std::vector<double> half_sine(int steps, double amplitude)
{
    std::vector<double> values;
    for (int i = 0; i <= steps; ++i) {
        values.push_back(amplitude * std::sin(pi * i / steps));
    }
    return values;
}

/// From 0 up to the amplitude [g] and back.
std::vector<double> triangle(int steps_per_side, double amplitude)
{
    std::vector<double> values;
    for (int i = 0; i <= 2 * steps_per_side; ++i) {
        values.push_back(amplitude * (1 - std::abs(double(i) / steps_per_side - 1)));
    }
    return values;
}

std::vector<double> noise()
{
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> value(-0.4, 0.4);
    std::vector<double> values(300);
    for (double& a : values) {
        a = value(random);
    }
    return values;
}

TEST(IntensityMeasures, OfAConstantAccelerationFollowFromItsLength)
{
    // 2 s at 0.3 g: v = g a t, Arias = pi g a^2 t/2, and energy grows evenly.
    const auto measures = intensity_measures(std::vector<double>(201, 0.3), 0.01, gravity);
    EXPECT_EQ(measures.pga, 0.3);
    EXPECT_NEAR(measures.pgv, gravity * 0.3 * 2, round_off * 6);
    EXPECT_NEAR(measures.arias_intensity, pi / 2 * gravity * 0.09 * 2, round_off * 3);
    EXPECT_NEAR(measures.significant_duration, 0.9 * 2, round_off * 2);
}

TEST(IntensityMeasures, OfATriangleAreExactAtAnyNumberOfSamples)
{
    // 1 s: Arias = pi g a^2 t/6. Energy grows with the cube of time, so that a share s < 1/2 is
    // reached at t/2 cbrt(2 s).
    for (const int steps : {1, 2, 7, 100}) {
        const auto measures = intensity_measures(triangle(steps, -0.5), 0.5 / steps, gravity);
        EXPECT_EQ(measures.pga, 0.5);
        EXPECT_NEAR(measures.pgv, gravity * 0.5 / 2, round_off);
        EXPECT_NEAR(measures.arias_intensity, pi / 6 * gravity * 0.25, round_off);
        EXPECT_NEAR(measures.significant_duration, 1 - std::cbrt(0.1), round_off);
    }
}

TEST(IntensityMeasures, OfAHalfSineConvergeWithOrderTwo)
{
    // 1 s at 0.4 g: v = g a 2 t/pi, Arias = pi g a^2 t/4. The polygon lies within the sine.
    const auto measures_of = [](int steps) {
        return intensity_measures(half_sine(steps, 0.4), 1.0 / steps, gravity);
    };
    const std::vector<int> steps{16, 32, 64, 128, 256};
    const double order_of_velocity =
        observed_order(steps, [&](int n) { return gravity * 0.4 * 2 / pi - measures_of(n).pgv; });
    const double order_of_arias = observed_order(
        steps, [&](int n) { return pi / 4 * gravity * 0.16 - measures_of(n).arias_intensity; });
    // At 16 steps the next term is 1 % of the error; trapezoids of a^2 would be exact here.
    EXPECT_NEAR(order_of_velocity, 2, 0.01);
    EXPECT_NEAR(order_of_arias, 2, 0.01);
}

TEST(IntensityMeasures, OfAHalfSineHaveTheDurationOfItsEnergy)
{
    // The share s is reached at t with t - sin(2 pi t)/(2 pi) = s: by bisection for s = 0.05.
    double low = 0, high = 0.5;
    for (int i = 0; i < 60; ++i) {
        const double t = (low + high) / 2;
        (t - std::sin(2 * pi * t) / (2 * pi) < 0.05 ? low : high) = t;
    }
    const auto measures = intensity_measures(half_sine(2000, 0.4), 1.0 / 2000, gravity);
    // The error of the polygon, of order (pi/2000)^2/12 = 2e-7; the nearest sample is 1e-4 off.
    EXPECT_NEAR(measures.significant_duration, 1 - 2 * low, 1e-6);
}

TEST(IntensityMeasures, OfOneIntervalFindTheDurationWithinIt)
{
    // From -a to a the integral of a^2 is point-symmetric about the zero: a^3 = a_0^3 (1 - 2 s).
    const auto measures = intensity_measures(std::vector<double>{-0.2, 0.2}, 3.0, gravity);
    EXPECT_NEAR(measures.significant_duration, 3 * std::cbrt(0.9), round_off);
}

TEST(IntensityMeasures, AreThoseOfTheMirroredRecord)
{
    std::vector<double> mirrored = noise();
    for (double& a : mirrored) {
        a = -a;
    }
    const auto measures = intensity_measures(noise(), 0.01, gravity);
    const auto others = intensity_measures(mirrored, 0.01, gravity);
    EXPECT_EQ(measures.pga, others.pga);
    EXPECT_EQ(measures.pgv, others.pgv);
    EXPECT_EQ(measures.arias_intensity, others.arias_intensity);
    EXPECT_EQ(measures.significant_duration, others.significant_duration);
}

TEST(IntensityMeasures, ScaleWithTheRecord)
{
    std::vector<double> scaled = noise();
    for (double& a : scaled) {
        a *= 4; // exact
    }
    const auto measures = intensity_measures(noise(), 0.01, gravity);
    const auto others = intensity_measures(scaled, 0.01, gravity);
    EXPECT_EQ(others.pga, 4 * measures.pga);
    EXPECT_EQ(others.pgv, 4 * measures.pgv);
    EXPECT_EQ(others.arias_intensity, 16 * measures.arias_intensity);
    EXPECT_EQ(others.significant_duration, measures.significant_duration);
}

TEST(IntensityMeasures, StretchWithTime)
{
    const auto measures = intensity_measures(noise(), 0.01, gravity);
    const auto others = intensity_measures(noise(), 0.02, gravity);
    EXPECT_EQ(others.pga, measures.pga);
    EXPECT_EQ(others.pgv, 2 * measures.pgv);
    EXPECT_EQ(others.arias_intensity, 2 * measures.arias_intensity);
    EXPECT_EQ(others.significant_duration, 2 * measures.significant_duration);
}

TEST(IntensityMeasures, HaveTheDurationOfTheReversedRecord)
{
    std::vector<double> reversed = noise();
    std::reverse(reversed.begin(), reversed.end());
    EXPECT_NEAR(intensity_measures(reversed, 0.01, gravity).significant_duration,
                intensity_measures(noise(), 0.01, gravity).significant_duration, 3 * round_off);
}

TEST(IntensityMeasures, OfTinyAndHugeRecordsNeitherUnderflowNorOverflow)
{
    for (const double size : {1e-150, 1e150}) {
        std::vector<double> scaled = noise();
        for (double& a : scaled) {
            a *= size;
        }
        EXPECT_NEAR(intensity_measures(scaled, 0.01, gravity).significant_duration,
                    intensity_measures(noise(), 0.01, gravity).significant_duration, 3 * round_off);
    }
}

TEST(IntensityMeasures, OfNoMotionAreZero)
{
    for (const std::size_t samples : {0, 1, 10}) {
        const auto measures = intensity_measures(std::vector<double>(samples, 0.0), 0.01, gravity);
        EXPECT_EQ(measures.pga, 0);
        EXPECT_EQ(measures.pgv, 0);
        EXPECT_EQ(measures.arias_intensity, 0);
        EXPECT_EQ(measures.significant_duration, 0);
    }
}

TEST(IntensityMeasures, OfOneSampleHaveAPeakOnly)
{
    const auto measures = intensity_measures(std::vector<double>{-0.7}, 0.01, gravity);
    EXPECT_EQ(measures.pga, 0.7);
    EXPECT_EQ(measures.pgv, 0);
    EXPECT_EQ(measures.arias_intensity, 0);
    EXPECT_EQ(measures.significant_duration, 0);
}

} // namespace
} // namespace overturn
