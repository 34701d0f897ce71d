#include "support/every_method.hpp"
#include "support/one_point.hpp"
#include "support/random_point.hpp"
#include "support/untrapped_floating_point.hpp"

#include <gtest/gtest.h>

#include <random>

namespace overturn {
namespace {

/// Properties of all methods.
template <class Method>
class ForcedStageByMethod : public testing::Test {};
TYPED_TEST_SUITE(ForcedStageByMethod, EveryMethod, MethodName);

TEST(ForcedStage, ErrorDecreasesWithTheTolerance)
{
    // The error of a controlled method of order 5 falls by about a decade per decade of tolerance.
    std::mt19937_64 generator(6);
    double log_ratio = 0;
    const int points = 200;
    for (int i = 0; i < points; ++i) {
        const PulsePoint<double> point = random_point(generator);
        const auto error = [&](double tolerance) {
            const auto best =
                forced_end<Theory::nonlinear>(PulseKind::one_sine, point, 1e-13).state;
            const auto state =
                forced_end<Theory::nonlinear>(PulseKind::one_sine, point, tolerance).state;
            return std::abs(state.tilt - best.tilt) + std::abs(state.rate - best.rate) + 1e-16;
        };
        log_ratio += std::log10(error(1e-5) / error(1e-8)) / points;
    }
    // On average 3 decades; a method of order 3 would gain 2.2, one without control almost none.
    EXPECT_GT(log_ratio, 2.6);
    EXPECT_LT(log_ratio, 3.6);
}

TYPED_TEST(ForcedStageByMethod, MirroredPulseMotionGivesTheMirroredEnd)
{
    std::mt19937_64 generator(8);
    for_every_scene([&]<Theory theory>(PulseKind pulse) {
        for (int i = 0; i < 50; ++i) {
            const PulsePoint<double> point = random_point(generator);
            PulseExcitation<double> excitation = excitation_of<theory>(pulse, point);
            const auto plain = run_in_doubles<TypeParam, theory>(point.block(), excitation, 1e-9);
            excitation.acceleration = -excitation.acceleration;
            const auto mirrored =
                run_in_doubles<TypeParam, theory>(point.block(), excitation, 1e-9);
            EXPECT_EQ(plain.fell, mirrored.fell);
            EXPECT_EQ(plain.state.tilt, mirrored.state.tilt);
            EXPECT_EQ(plain.state.rate, mirrored.state.rate);
            EXPECT_EQ(plain.impacts, mirrored.impacts);
            if (!(plain.state.tilt == 0 && plain.state.rate == 0)) {
                EXPECT_EQ(plain.state.side, -mirrored.state.side);
            }
        }
    });
}

/// Eq. 47 as printed, in seconds, with p = sqrt(3 g / 4 R), by small classical Runge-Kutta steps
/// from the uplift to the end of a half-sine pulse, in which no block strikes the ground.
State<double> dimensional_end(const PulsePoint<double>& point, double p)
{
    const double omega = point.frequency * p;
    const double psi = std::asin(1 / point.amplitude);
    const double duration = (pi<double>() - psi) / omega;
    const auto acceleration = [&](double t, double theta) {
        const double y = -point.slenderness - theta; // on the side theta < 0
        const double ground =
            point.amplitude * std::tan(point.slenderness) * std::sin(omega * t + psi);
        return -p * p * (std::sin(y) + ground * std::cos(y));
    };
    const int steps = 20000;
    const double h = duration / steps;
    double theta = 0;
    double velocity = 0;
    for (int i = 0; i < steps; ++i) {
        const double t = i * h;
        const double k1 = acceleration(t, theta);
        const double k2 = acceleration(t + h / 2, theta + h / 2 * velocity);
        const double k3 = acceleration(t + h / 2, theta + h / 2 * (velocity + h / 2 * k1));
        const double k4 = acceleration(t + h, theta + h * (velocity + h / 2 * k2));
        theta += h * (velocity + h / 6 * (k1 + k2 + k3));
        velocity += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return {-theta, -velocity / p, -1};
}

TYPED_TEST(ForcedStageByMethod, ResultDoesNotDependOnTheFrequencyParameter)
{
    for (const PulsePoint<double>& point :
         {PulsePoint<double>{0.17, 0.9, 5, 1.6}, PulsePoint<double>{0.3, 0.8, 6, 2.5}}) {
        const auto ours =
            forced_end<Theory::nonlinear, TypeParam>(PulseKind::half_sine, point, 1e-12);
        ASSERT_EQ(ours.impacts, 0);
        for (const double p : {0.4, 1.130441, 4.9}) {
            const State<double> theirs = dimensional_end(point, p);
            // Classical Runge-Kutta at 20000 steps: (duration / steps)^4 = 1e-16, and round-off.
            EXPECT_NEAR(ours.state.tilt, theirs.tilt, 1e-10 * point.slenderness);
            EXPECT_NEAR(ours.state.rate, theirs.rate, 1e-10 * point.slenderness);
            EXPECT_EQ(ours.state.side, theirs.side);
        }
    }
}

TYPED_TEST(ForcedStageByMethod, ABlockThatIsNotLiftedStaysAtRest)
{
    for_every_scene([]<Theory theory>(PulseKind pulse) {
        for (const double amplitude : {0.0, 0.4, 0.999}) {
            const auto end = forced_end<theory, TypeParam>(
                pulse, PulsePoint<double>{0.2, 0.8, 3, amplitude}, 1e-9);
            EXPECT_EQ(end.state.tilt, 0);
            EXPECT_EQ(end.state.rate, 0);
            EXPECT_FALSE(end.fell);
            EXPECT_FALSE(end.rested);
            EXPECT_EQ(end.steps, 0);
        }
    });
}

TYPED_TEST(ForcedStageByMethod, OverturningEndsWithTheVelocityOfEnergyAndWork)
{
    // A constant push B: u^2/2 = (work of Eq. 47 over the tilt) = cos y - cos alpha - B (sin y -
    // sin alpha) from y = alpha to y = alpha - pi/2, up to sign.
    const double alpha = 0.2;
    const double amplitude = 5;
    const auto end = forced_end<Theory::nonlinear, TypeParam>(
        PulseKind::rectangular, PulsePoint<double>{alpha, 0.9, 0.4, amplitude}, 1e-12);
    ASSERT_TRUE(end.fell);
    const double push = -amplitude * std::tan(alpha);
    const double y = alpha - pi<double>() / 2;
    const double energy =
        -(std::cos(alpha) - std::cos(y)) * -1 - push * (std::sin(alpha) - std::sin(y));
    EXPECT_EQ(end.state.tilt, pi<double>() / 2);
    EXPECT_EQ(end.state.side, -1);
    EXPECT_NEAR(end.state.rate, std::sqrt(2 * energy), 1e-10);
}

/// A block that comes down while the ground is about to push it up again: below some amplitude it
/// touches the ground, above it does not.
template <class Method>
ForcedEnd<double> near_graze(double amplitude, double tolerance)
{
    return forced_end<Theory::nonlinear, Method>(
        PulseKind::antisymmetric_ricker, PulsePoint<double>{0.2, 0.85, 1.0, amplitude}, tolerance);
}

/// The amplitude at which it just touches the ground.
template <class Method>
double grazing_amplitude()
{
    double low = 7.03;
    double high = 7.04;
    for (int i = 0; i < 40; ++i) {
        const double middle = (low + high) / 2;
        (near_graze<Method>(middle, 1e-12).impacts > 0 ? low : high) = middle;
    }
    return low;
}

TYPED_TEST(ForcedStageByMethod, AGrazeMuchShorterThanAStepIsDetected)
{
    const double amplitude = grazing_amplitude<TypeParam>();
    // A dip of about 1e-6 of alpha lasts 1e-3, a fiftieth of a step at the first tolerance.
    for (const double tolerance : {1e-8, 1e-9, 1e-11}) {
        EXPECT_EQ(near_graze<TypeParam>(amplitude * (1 - 1e-6), tolerance).impacts, 2);
        EXPECT_EQ(near_graze<TypeParam>(amplitude * (1 + 1e-6), tolerance).impacts, 0);
    }
}

TYPED_TEST(ForcedStageByMethod, AGrazeChangesTheEndByTheRootOfItsDepth)
{
    const double amplitude = grazing_amplitude<TypeParam>();
    const double free_of_it = near_graze<TypeParam>(amplitude * (1 + 1e-9), 1e-12).state.rate;
    const auto change = [&](double depth) {
        return near_graze<TypeParam>(amplitude * (1 - depth), 1e-12).state.rate - free_of_it;
    };
    // Impacts as fast as the root of the depth; the next term is linear in it: 3 % at 1e-6.
    EXPECT_NEAR(change(1e-6) / change(1e-8), 10, 0.5);
}

TYPED_TEST(ForcedStageByMethod, ANumberThatIsNotFiniteEndsTheLaneWithAStatus)
{
    const UntrappedFloatingPoint overflow_at_the_first_step;
    const auto end = forced_end<Theory::nonlinear, TypeParam>(
        PulseKind::one_sine, PulsePoint<double>{0.2, 0.8, 3, 1e200}, 1e-9);
    EXPECT_TRUE(end.not_finite);
    EXPECT_FALSE(end.fell);
}

} // namespace
} // namespace overturn
