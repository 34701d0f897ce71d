// Ground accelerations at the uplift threshold, just above it, and far above it.
#include "verdicts.hpp"

#include "support/untrapped_floating_point.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace overturn {
namespace {

constexpr double one_ulp_above = 1 + 0x1p-52;

/// The paper's 1.38 makes the peak of the antisymmetric wavelet 1.000086, see pulse.hpp.
double peak_of(PulseKind pulse)
{
    const double z = std::sqrt(3 - std::sqrt(6.0)); // f' = 0 at z^4 - 6 z^2 + 3 = 0
    const double antisymmetric = z * (3 - z * z) * std::exp(-z * z / 2) / 1.38;
    return pulse == PulseKind::antisymmetric_ricker ? antisymmetric : 1;
}

template <class Visitor>
void for_every_pulse_and_theory(const Visitor& visit)
{
    for (std::size_t pulse = 0; pulse < names_of<PulseKind>.size(); ++pulse) {
        for (const Theory theory : {Theory::nonlinear, Theory::linear}) {
            visit(HardCase{.pulse = PulseKind(pulse), .theory = theory});
        }
    }
}

void expect_never_lifted(const HardCase& point)
{
    const Truth truth = expect_right_verdicts(point);
    EXPECT_TRUE(truth.settled);
    EXPECT_EQ(truth.region, Region::S);
    for (const Numerics& numerics : plain_numerics()) {
        const Outcome outcome = outcome_of(point, numerics);
        EXPECT_EQ(outcome.region, Region::S) << point;
        EXPECT_EQ(outcome.angle, 0) << point;
        EXPECT_EQ(outcome.velocity, 0) << point;
        EXPECT_EQ(outcome.impacts, 0) << point;
        EXPECT_EQ(outcome.steps, 0) << point;
        EXPECT_EQ(outcome.status, 0) << point;
    }
}

TEST(UpliftThreshold, NoMotionOfTheGroundLeavesTheBlockAtRest)
{
    for_every_pulse_and_theory([](HardCase point) {
        point.amplitude = 0;
        expect_never_lifted(point);
    });
}

TEST(UpliftThreshold, AnAccelerationThatOnlyReachesItDoesNotLiftTheBlock)
{
    for_every_pulse_and_theory([](HardCase point) {
        // The peak of the antisymmetric wavelet is not a double; the next smaller double is below
        // it.
        point.amplitude =
            peak_of(point.pulse) == 1 ? 1 : 1 / peak_of(point.pulse) * (1 - 8 * 0x1p-52);
        expect_never_lifted(point);
    });
}

TEST(UpliftThreshold, OneUlpAboveItIsSafe)
{
    for_every_pulse_and_theory([](HardCase point) {
        point.amplitude = one_ulp_above;
        EXPECT_TRUE(is_safe(expect_right_verdicts(point).region)) << point;
    });
}

TEST(UpliftThreshold, AMillionthOfAMillionthAboveItIsSafe)
{
    for_every_pulse_and_theory([](HardCase point) {
        point.amplitude = 1 + 1e-12;
        EXPECT_TRUE(is_safe(expect_right_verdicts(point).region)) << point;
    });
}

TEST(UpliftThreshold, AMillionthAboveItIsSafe)
{
    for_every_pulse_and_theory([](HardCase point) {
        point.amplitude = 1 + 1e-6;
        EXPECT_TRUE(is_safe(expect_right_verdicts(point).region)) << point;
    });
}

TEST(UpliftThreshold, OneUlpAboveItOverturnsTheBlockIfThePushLastsLongEnough)
{
    // The tilt grows like 2^-52 alpha exp(tau): at tau = 314 the block has long overturned, and the
    // initial push is less than the round-off of the equation of motion.
    for (const Theory theory : {Theory::nonlinear, Theory::linear}) {
        const Truth truth = expect_right_verdicts({.pulse = PulseKind::rectangular,
                                                   .theory = theory,
                                                   .frequency = 0.01,
                                                   .amplitude = one_ulp_above});
        EXPECT_EQ(truth.region, Region::F_minus);
    }
}

TEST(UpliftThreshold, OneUlpAboveItIsSafeIfThePushIsShort)
{
    // The longest push that does not overturn the block lasts about ln(2^52) = 36 units of time.
    HardCase point{.pulse = PulseKind::rectangular, .amplitude = one_ulp_above};
    for (const double duration : {33.0, 34.0, 35.0, 36.0, 37.0, 38.0}) {
        point.frequency = std::acos(-1.0) / duration;
        expect_right_verdicts(point);
    }
}

TEST(UpliftThreshold, AThousandAndAMillionTimesItOverturnTheBlock)
{
    // At a million, a trial step of rk45 may reach 1e191 rad before it is rejected.
    const UntrappedFloatingPoint overflow_in_trial_steps;
    for_every_pulse_and_theory([](HardCase point) {
        for (const double amplitude : {1e3, 1e6}) {
            point.amplitude = amplitude;
            const Truth truth = expect_right_verdicts(point);
            EXPECT_TRUE(truth.settled) << point;
            EXPECT_TRUE(truth.fell) << point;
        }
    });
}

TEST(UpliftThreshold, AMillionTimesItHasLittleEffectIfThePulseIsShortEnough)
{
    for_every_pulse_and_theory([](HardCase point) {
        point.amplitude = 1e6;
        point.frequency = 1e7;
        expect_right_verdicts(point);
    });
}

} // namespace
} // namespace overturn
