// Intensity measures of two components: closed forms of their dependence on the direction, and
// RotD50 and RotD100.

#include "overturn/mechanics/intensity_measures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

namespace overturn {
namespace {

constexpr double gravity = 9.80665;
constexpr double time_step = 0.01;
// A few roundings of values, and of sums of a few hundred terms, below 10.
constexpr double round_off = 1e-12;

double radians(int degrees)
{
    return degrees * std::numbers::pi / 180;
}

std::vector<double> noise(unsigned seed)
{
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> value(-0.4, 0.4);
    std::vector<double> values(300);
    for (double& a : values) {
        a = value(random);
    }
    return values;
}

Accelerogram record_of(const std::vector<double>& first, const std::vector<double>& second)
{
    return {first, {}, time_step, second};
}

IntensityMeasures measures_in(const Accelerogram& record, double degrees)
{
    return intensity_measures(record.in_direction(degrees).horizontal(), time_step, gravity);
}

TEST(DirectedMeasures, OfAProportionalSecondComponentFollowFromTheFirstOne)
{
    // a2 = c a1: the motion at psi is that of a1 times cos psi + c sin psi.
    const std::vector<double> first = noise(1);
    const IntensityMeasures of_first = intensity_measures(first, time_step, gravity);
    for (const double c : {1.0, -0.5, 3.0}) {
        std::vector<double> second = first;
        for (double& a : second) {
            a *= c;
        }
        const Accelerogram record = record_of(first, second);
        std::vector<double> factors;
        for (int degrees = 0; degrees < 360; ++degrees) {
            const double factor =
                std::abs(std::cos(radians(degrees)) + c * std::sin(radians(degrees)));
            const IntensityMeasures measures = measures_in(record, degrees);
            EXPECT_NEAR(measures.pga, factor * of_first.pga, round_off);
            EXPECT_NEAR(measures.pgv, factor * of_first.pgv, round_off);
            EXPECT_NEAR(measures.arias_intensity, factor * factor * of_first.arias_intensity,
                        10 * round_off);
            if (factor > 1e-3) { // else there is nothing but roundings
                EXPECT_NEAR(measures.significant_duration, of_first.significant_duration, 1e-9);
            }
            if (degrees < 180) {
                factors.push_back(factor);
            }
        }
        std::ranges::sort(factors);
        const RotatedMeasures rotated = rotated_measures(record, gravity);
        const double median = (factors[89] + factors[90]) / 2;
        EXPECT_NEAR(rotated.pga_rotd50, median * of_first.pga, round_off);
        EXPECT_NEAR(rotated.pgv_rotd50, median * of_first.pgv, round_off);
        EXPECT_NEAR(rotated.pga_rotd100, factors.back() * of_first.pga, round_off);
        EXPECT_NEAR(rotated.pgv_rotd100, factors.back() * of_first.pgv, round_off);
    }
}

TEST(DirectedMeasures, HaveTheAriasIntensityOfAQuadraticForm)
{
    // Arias(psi) = a11 cos^2 psi + 2 a12 cos psi sin psi + a22 sin^2 psi, of which psi = 45 gives
    // a12 = Arias(45) - (a11 + a22)/2.
    const Accelerogram record = record_of(noise(1), noise(2));
    const auto arias = [&](int degrees) { return measures_in(record, degrees).arias_intensity; };
    const double a11 = arias(0);
    const double a22 = arias(90);
    const double a12 = arias(45) - (a11 + a22) / 2;
    EXPECT_GT(std::abs(a12), 1e-3);
    for (int degrees = 0; degrees < 360; degrees += 7) {
        const double cosine = std::cos(radians(degrees));
        const double sine = std::sin(radians(degrees));
        EXPECT_NEAR(arias(degrees),
                    a11 * cosine * cosine + 2 * a12 * cosine * sine + a22 * sine * sine, round_off);
    }
}

TEST(RotatedMeasures, OfACircularMotionAreEqual)
{
    // The acceleration passes through every degree, twice in opposite directions.
    std::vector<double> first, second;
    for (int degrees = 0; degrees <= 720; ++degrees) {
        first.push_back(0.3 * std::cos(radians(degrees)));
        second.push_back(0.3 * std::sin(radians(degrees)));
    }
    const RotatedMeasures rotated = rotated_measures(record_of(first, second), gravity);
    EXPECT_NEAR(rotated.pga_rotd50, 0.3, round_off);
    EXPECT_NEAR(rotated.pga_rotd100, 0.3, round_off);
}

TEST(RotatedMeasures, AreTheMedianAndTheLargestOfAllDirections)
{
    const Accelerogram record = record_of(noise(1), noise(2));
    const RotatedMeasures rotated = rotated_measures(record, gravity);
    int above_pga = 0, above_pgv = 0;
    for (int degrees = 0; degrees < 360; ++degrees) {
        const IntensityMeasures measures = measures_in(record, degrees);
        EXPECT_LE(measures.pga, rotated.pga_rotd100);
        EXPECT_LE(measures.pgv, rotated.pgv_rotd100 + round_off); // rotated before it is summed
        above_pga += measures.pga > rotated.pga_rotd50;
        above_pgv += measures.pgv > rotated.pgv_rotd50;
    }
    EXPECT_EQ(above_pga, 180);
    EXPECT_EQ(above_pgv, 180);
}

TEST(RotatedMeasures, DoNotDependOnTheOrientationOfTheSensors)
{
    const Accelerogram record = record_of(noise(1), noise(2));
    const RotatedMeasures rotated = rotated_measures(record, gravity);
    for (const double degrees : {30.0, 90.0, 137.0}) {
        const Accelerogram turned = record_of(record.in_direction(degrees).horizontal(),
                                              record.in_direction(degrees + 90).horizontal());
        const RotatedMeasures others = rotated_measures(turned, gravity);
        EXPECT_NEAR(others.pga_rotd50, rotated.pga_rotd50, round_off);
        EXPECT_NEAR(others.pga_rotd100, rotated.pga_rotd100, round_off);
        EXPECT_NEAR(others.pgv_rotd50, rotated.pgv_rotd50, round_off);
        EXPECT_NEAR(others.pgv_rotd100, rotated.pgv_rotd100, round_off);
    }
}

} // namespace
} // namespace overturn
