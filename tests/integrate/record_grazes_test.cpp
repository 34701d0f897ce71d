// Motions that graze the ground within one interval of a record, planted at a known distance: the
// series of the motion about its lowest point, in 50 digits, gives the state at the beginning.
#include "overturn/integrate/record_stepper.hpp"
#include "overturn/number/digits50.hpp"
#include "support/random_record.hpp"

#include <gtest/gtest.h>

#include <random>

namespace overturn {
namespace {

struct Graze {
    double slenderness = 0.2;
    double frequency = 20; ///< samples per 1/p
    double excess = 0.1;   ///< of the push over the pull of gravity at the lowest point [1]
    double change = 0;     ///< of the ground acceleration over the interval [1]
    double when = 0.5;     ///< phase of the lowest point
    double distance = 0;   ///< tilt at the lowest point, over alpha
};

/// The motion with its lowest point at the graze, at a phase of the interval.
template <Theory theory>
Rocking<double> motion_at(double phase, const Graze& graze)
{
    const Digits50 alpha(graze.slenderness);
    const Digits50 threshold = theory == Theory::linear ? alpha : Digits50(tan(alpha));
    const Digits50 frequency(graze.frequency);
    const Ramp<Digits50> push{-(threshold + Digits50(graze.excess)),
                              Digits50(graze.change) * frequency};
    const auto series = Equations<theory>::template series<30>(
        BlockSide{alpha}, Digits50(Digits50(graze.distance) * alpha), Digits50(0), push,
        Digits50(1));
    const Digits50 time = (Digits50(phase) - Digits50(graze.when)) / frequency;
    return {phase, double(value_of_series(series.tilt, time)),
            double(value_of_series(series.rate, time)), 1};
}

/// The record of one interval. The accelerations are rounded to doubles.
template <Theory theory>
RecordPoint point_of(const Graze& graze)
{
    const double threshold =
        theory == Theory::linear ? graze.slenderness : std::tan(graze.slenderness);
    const double lowest = -(threshold + graze.excess);
    return {.record = accelerogram(
                {lowest - graze.change * graze.when, lowest + graze.change * (1 - graze.when)}),
            .block = {graze.slenderness, 0.9},
            .scale = 1,
            .frequency = graze.frequency};
}

/// The phase of the first impact from `start` on; 2 if the interval ends without one.
template <int order, Theory theory>
double first_impact(const RecordPoint& point, Rocking<double> now)
{
    const auto excitation = excitation_of<theory, Directions::horizontal>(point);
    const RecordStepper<order, theory, double, Outputs{}, std::remove_const_t<decltype(excitation)>>
        stepper(point.block, excitation, 1e-12);
    for (int steps = 0; steps < 200 && now.phase < 1; ++steps) {
        const auto end = stepper.step(now, true, 0, 0);
        EXPECT_FALSE(end.falls || end.broken);
        if (end.strikes) {
            return end.phase;
        }
        now = {end.phase, end.tilt, end.rate, 1};
    }
    EXPECT_EQ(now.phase, 1);
    return 2;
}

template <int order, Theory theory>
void expect_grazes_are_seen()
{
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    int struck = 0;
    for (int i = 0; i < 300; ++i) {
        Graze graze{.slenderness = 0.05 + 0.4 * uniform(generator),
                    .frequency = std::pow(10, 0.3 + 1.7 * uniform(generator)),
                    .excess = std::pow(10, -2 + 2 * uniform(generator)),
                    .when = uniform(generator)};
        graze.change = graze.excess * (2 * uniform(generator) - 1); // the push lifts throughout
        if (i % 3 > 0) {
            graze.when = i % 3 == 1 ? 1e-3 * graze.when : 1 - 1e-3 * graze.when;
        }
        // Round-off of the accelerations, of the state and of each step moves the lowest point by a
        // few epsilon of the largest tilt of the interval, u^2 times the acceleration.
        for (const double distance : {1e-3, 1e-6, 1e-9, 1e-12}) {
            for (const double sign : {-1, 1}) {
                graze.distance = sign * distance;
                const Rocking<double> start = motion_at<theory>(0, graze);
                if (!(start.tilt > 0)) {
                    continue; // it has passed the ground before the interval
                }
                const double impact = first_impact<order, theory>(point_of<theory>(graze), start);
                const bool strikes = impact <= graze.when;
                EXPECT_EQ(strikes, sign < 0)
                    << "alpha " << graze.slenderness << ", frequency " << graze.frequency
                    << ", excess " << graze.excess << ", change " << graze.change << ", when "
                    << graze.when << ", distance " << graze.distance << ", impact " << impact;
                struck += strikes;
                if (strikes) {
                    EXPECT_LT(std::abs(motion_at<theory>(impact, graze).tilt),
                              1e-14 * graze.slenderness);
                }
            }
        }
    }
    EXPECT_GT(struck, 500);
}

TEST(GrazeUnderARecord, IsAnImpactIfAndOnlyIfItReachesTheGround)
{
    expect_grazes_are_seen<8, Theory::nonlinear>();
    expect_grazes_are_seen<8, Theory::linear>();
    expect_grazes_are_seen<10, Theory::nonlinear>();
}

} // namespace
} // namespace overturn
