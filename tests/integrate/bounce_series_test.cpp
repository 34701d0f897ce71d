// Bounce series: in closed form if they die out, impact by impact if they do not.
#include "support/one_point.hpp"
#include "support/random_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace overturn {
namespace {

TEST(BounceSeries, OfABarelyLiftedBlockEndsInClosedForm)
{
    for (const double excess : {1e-15, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3}) {
        const auto end = forced_end<Theory::nonlinear>(
            PulseKind::one_sine, PulsePoint<double>{0.1745, 0.91, 2.0, 1 + excess}, 1e-9);
        EXPECT_TRUE(end.rested);
        // Two lobes lift it. Impact by impact, each series would continue until its speed is
        // round-off: 2 log(1e-16) / log(0.91) = 780 impacts.
        EXPECT_LE(end.impacts, 12) << "excess " << excess;
        EXPECT_LT(end.steps, 500) << "excess " << excess;
    }
}

TEST(BounceSeries, ABlockAtRestBetweenTheLobesIsIndependentOfTheFirst)
{
    // The second half of a one-sine pulse is a half-sine pulse in the opposite direction.
    const PulsePoint<double> point{0.2, 0.5, 1.0, 1.02};
    const auto both = forced_end<Theory::nonlinear>(PulseKind::one_sine, point, 1e-11);
    const auto second = forced_end<Theory::nonlinear>(PulseKind::half_sine, point, 1e-11);
    ASSERT_TRUE(both.rested);
    EXPECT_NEAR(both.state.tilt, second.state.tilt, 1e-9 * point.slenderness);
    EXPECT_NEAR(both.state.rate, second.state.rate, 1e-9 * point.slenderness);
}

TEST(BounceSeries, NearlyPlasticImpactsBringTheBlockToRestAtOnce)
{
    const auto end = forced_end<Theory::nonlinear>(PulseKind::one_sine,
                                                   PulsePoint<double>{0.2, 1e-12, 2.0, 1.05}, 1e-9);
    EXPECT_TRUE(end.rested);
    EXPECT_LE(end.impacts, 4);
}

TEST(BounceSeries, WithoutLossNeverComesToRest)
{
    const auto end = forced_end<Theory::nonlinear>(PulseKind::one_sine,
                                                   PulsePoint<double>{0.2, 1.0, 2.0, 1.01}, 1e-9);
    EXPECT_FALSE(end.rested);
    EXPECT_FALSE(end.capped);
    EXPECT_GT(end.impacts, 50);
}

/// A block that has just left the ground again, at a phase of the ground motion.
template <class Excitation>
struct AfterImpact {
    Block<double> block;
    Excitation excitation;
    double phase;
    double rate;
    double side;
};

AfterImpact<PulseExcitation<double>> random_impact(PulseKind pulse, std::mt19937_64& generator)
{
    std::uniform_real_distribution<double> uniform(0, 1);
    const double slenderness = 0.08 + 0.4 * uniform(generator);
    const double amplitude = 0.5 + 3 * uniform(generator) * uniform(generator);
    const double frequency = 0.2 + 5 * uniform(generator);
    const PulseMotion<double> motion = pulse_motion<double>(pulse);
    const double duration = motion.end - motion.begin;
    const double restitution = 0.05 + 0.85 * uniform(generator);
    // The series lasts between about a hundredth of a pulse and a pulse.
    const double lasts = std::pow(10, -2 + 2 * uniform(generator)) * duration / frequency;
    return {{slenderness, restitution},
            {motion, amplitude * std::tan(slenderness), frequency, {}},
            motion.begin + duration * uniform(generator),
            0.5 * lasts * slenderness * (1 - std::sqrt(restitution)),
            uniform(generator) < 0.5 ? -1.0 : 1.0};
}

/// Integrates the bounces impact by impact, and returns whether the speed falls to a thousandth
/// before the phase `end`, before the ground can lift the block and before the block has
/// overturned.
template <Theory theory, class Excitation>
bool bounces_on_to_rest(const AfterImpact<Excitation>& start, double end)
{
    const double alpha = start.block.slenderness;
    double phase = start.phase;
    double side = start.side;
    StepMotion<double> motion{0, start.rate, 0};
    const auto pull = [&](double tilt, double at, double on) {
        return Equations<theory>::acceleration(BlockSide{alpha}, tilt,
                                               on * start.excitation.ground(at));
    };
    while (motion.rate > 1e-3 * start.rate) {
        // Twenty steps per flight, but at most 0.1 each because motion grows e-fold in 1/p.
        const double h = 0.1 * std::min(motion.rate / alpha, 1.0);
        while (motion.position >= 0) {
            if (phase > end || motion.position > pi<double>() / 2 ||
                !(pull(0, phase, 1) < 0 && pull(0, phase, -1) < 0)) {
                return false;
            }
            motion.acceleration = pull(motion.position, phase, side);
            const auto step = runge_kutta_step(motion, h, [&](std::size_t stage, double tilt) {
                const double node = DormandPrince::node[stage].in<double>();
                return pull(tilt, phase + node * h * start.excitation.frequency, side);
            });
            motion = step.end;
            phase += h * start.excitation.frequency;
        }
        const auto impact = event_correction(motion);
        phase += start.excitation.frequency * impact.delay;
        motion = {0, std::sqrt(start.block.restitution) * impact.closing, 0};
        side = -side;
    }
    return true;
}

void expect_that_what_is_closed_dies_out(PulseKind pulse)
{
    std::mt19937_64 generator(9);
    int closed = 0;
    int die_out = 0;
    for (int i = 0; i < 1500; ++i) {
        const auto start = random_impact(pulse, generator);
        const bool dies_out =
            bounces_on_to_rest<Theory::nonlinear>(start, start.excitation.motion.end);
        die_out += dies_out;
        if (bounces_die_out<Theory::nonlinear>(start.block, start.excitation, start.phase,
                                               start.rate)) {
            ++closed;
            EXPECT_TRUE(dies_out) << "r " << start.block.restitution << ", phase " << start.phase
                                  << ", rate " << start.rate;
        }
    }
    // It may return false where the block would come to rest, but not usually.
    EXPECT_GT(closed, 0.3 * die_out);
    EXPECT_GT(die_out, 110);
    EXPECT_LT(die_out, 1390);
}

TEST(BounceSeries, IsClosedOnlyIfItWouldDieOut)
{
    expect_that_what_is_closed_dies_out(PulseKind::one_sine);
    expect_that_what_is_closed_dies_out(PulseKind::one_cosine);
    expect_that_what_is_closed_dies_out(PulseKind::symmetric_ricker);
    expect_that_what_is_closed_dies_out(PulseKind::antisymmetric_ricker);
}

/// Under two samples of accelerations that may change by more than gravity, up to slightly more
/// than what lifts the block. motion: of these samples.
template <Theory theory, Directions directions>
AfterImpact<RecordExcitation<double, directions>>
random_impact(const Accelerogram& record, double slenderness, std::mt19937_64& generator)
{
    std::uniform_real_distribution<double> uniform(0, 1);
    const double frequency = 0.2 + 5 * uniform(generator);
    const double restitution = 0.01 + 0.9 * uniform(generator);
    const double lasts = std::pow(10, -2 + 2 * uniform(generator)) / frequency;
    return {{slenderness, restitution},
            {record_motion<double>(record), 1, frequency,
             Equations<theory>::uplift_acceleration(BlockSide{slenderness}),
             Equations<theory>::uplift_acceleration(BlockSide{slenderness})},
            uniform(generator),
            0.5 * lasts * slenderness * uniform(generator) * (1 - std::sqrt(restitution)),
            uniform(generator) < 0.5 ? -1.0 : 1.0};
}

template <Theory theory, Directions directions>
void expect_that_what_is_closed_dies_out_within_an_interval()
{
    std::mt19937_64 generator(10);
    std::uniform_real_distribution<double> uniform(0, 1);
    int closed = 0;
    int die_out = 0;
    const int trials = 1500;
    for (int i = 0; i < trials; ++i) {
        const double slenderness = 0.08 + 0.4 * uniform(generator);
        std::vector<double> vertical;
        std::vector<double> horizontal;
        for (int sample = 0; sample < 2; ++sample) {
            const double v = directions == Directions::both ? -0.95 + 3 * uniform(generator) : 0;
            vertical.push_back(v);
            horizontal.push_back((1 + v) *
                                 Equations<theory>::uplift_acceleration(BlockSide{slenderness}) *
                                 (-1.1 + 2.2 * uniform(generator)));
        }
        const Accelerogram record = accelerogram(
            horizontal, directions == Directions::both ? vertical : std::vector<double>());
        const auto start = random_impact<theory, directions>(record, slenderness, generator);
        const bool dies_out = bounces_on_to_rest<theory>(start, 1);
        die_out += dies_out;
        if (bounces_die_out<theory>(start.block, start.excitation, start.phase, start.rate)) {
            ++closed;
            EXPECT_TRUE(dies_out) << "r " << start.block.restitution << ", phase " << start.phase
                                  << ", rate " << start.rate << ", trial " << i;
        }
    }
    // It may return false where the block would come to rest, but not usually.
    EXPECT_GT(closed, 0.3 * die_out);
    EXPECT_GT(die_out, 0.1 * trials);
    EXPECT_LT(die_out, 0.9 * trials);
}

TEST(BounceSeries, UnderARecordIsClosedOnlyIfItWouldDieOutBeforeTheNextSample)
{
    expect_that_what_is_closed_dies_out_within_an_interval<Theory::nonlinear,
                                                           Directions::horizontal>();
    expect_that_what_is_closed_dies_out_within_an_interval<Theory::linear,
                                                           Directions::horizontal>();
}

TEST(BounceSeries, UnderVerticalMotionIsClosedOnlyIfItWouldDieOutBeforeTheNextSample)
{
    expect_that_what_is_closed_dies_out_within_an_interval<Theory::nonlinear, Directions::both>();
    expect_that_what_is_closed_dies_out_within_an_interval<Theory::linear, Directions::both>();
}

} // namespace
} // namespace overturn
