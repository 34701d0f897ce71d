// Records in a pack: every lane has the bits of a double. CMake defines OVERTURN_NUMBER.
#include "overturn/integrate/forced_stage.hpp"
#include "overturn/number/pack.hpp"
#include "support/random_record.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

namespace overturn {
namespace {

using Lanes = OVERTURN_NUMBER;
constexpr std::size_t lanes = lanes_v<Lanes>;

/// One block per lane, under the same record.
using Points = std::vector<RecordPoint>;

template <Directions directions>
Points random_points(std::mt19937_64& generator)
{
    const RecordPoint first = random_record_point(generator, 40, directions);
    Points points(lanes, first);
    for (RecordPoint& point : points) {
        point = random_record_point(generator, 40, directions);
        const double sign = generator() % 2 == 0 ? 1 : -1;
        point.scale = sign * std::min(point.scale, 0.9 * first.record.free_fall_scale());
        point.record = first.record;
    }
    return points;
}

/// member(point) of each lane.
template <class Member>
Lanes packed(const Points& points, const Member& member)
{
    std::array<double, lanes> numbers;
    for (std::size_t i = 0; i < lanes; ++i) {
        numbers[i] = member(points[i]);
    }
    return load<Lanes>(numbers.data());
}

double uplift_of(const RecordPoint& point)
{
    return Equations<Theory::nonlinear>::uplift_acceleration(point.block);
}

template <Directions directions>
RecordExcitation<Lanes, directions> excitation_of(const Points& points)
{
    return {.motion = record_motion<double>(points[0].record),
            .acceleration = packed(points, [](const RecordPoint& p) { return p.scale; }),
            .frequency = packed(points, [](const RecordPoint& p) { return p.frequency; }),
            .to_plus = packed(points, uplift_of),
            .to_minus = packed(points, uplift_of)};
}

template <Directions directions>
RecordExcitation<double, directions> excitation_of(const RecordPoint& point)
{
    return excitation_of<Theory::nonlinear, directions>(point);
}

void expect_bits(const Lanes& together, std::size_t lane, double alone)
{
    ASSERT_EQ(std::bit_cast<std::uint64_t>(lanes_of(together)[lane]),
              std::bit_cast<std::uint64_t>(alone))
        << lanes_of(together)[lane] << " in lane " << lane << ", " << alone << " alone";
}

template <Directions directions>
void expect_equal_uplifts()
{
    std::mt19937_64 generator(41);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 500; ++i) {
        const Points points = random_points<directions>(generator);
        const auto excitation = excitation_of<directions>(points);
        std::array<double, lanes> phases;
        std::array<double, lanes> latest;
        std::array<double, lanes> resting;
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            phases[lane] = uniform(generator) < 0.2 ? 0 : 39 * uniform(generator);
            latest[lane] = uniform(generator) < 0.5 ? -infinity : phases[lane];
            resting[lane] = uniform(generator) < 0.7 ? 1 : 0;
        }
        const Lanes phase = load<Lanes>(phases.data());
        const auto rests = load<Lanes>(resting.data()) > Lanes(0);
        const Lanes next = excitation.next_uplift(rests, phase, load<Lanes>(latest.data()));
        const auto ground = excitation.ground(phase);
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const auto alone = excitation_of<directions>(points[lane]);
            expect_bits(next, lane,
                        alone.next_uplift(resting[lane] == 1, phases[lane], latest[lane]));
            expect_bits(horizontal_of(ground), lane, horizontal_of(alone.ground(phases[lane])));
            if constexpr (directions == Directions::both) {
                expect_bits(ground.gravity, lane, alone.ground(phases[lane]).gravity);
            }
        }
    }
}

TEST(RecordInLanes, LiftsAsInADouble)
{
    expect_equal_uplifts<Directions::horizontal>();
    expect_equal_uplifts<Directions::both>();
}

template <Directions directions, Outputs outputs>
void expect_equal_ends()
{
    std::mt19937_64 generator(42);
    const auto run = []<class T>(const Block<T>& block, const auto& excitation) {
        return run_forced_stage<Taylor<14>, Theory::nonlinear, outputs>(block, excitation, 1e-9);
    };
    for (int i = 0; i < 20; ++i) {
        const Points points = random_points<directions>(generator);
        const Block<Lanes> block{
            packed(points, [](const RecordPoint& p) { return p.block.slenderness; }),
            packed(points, [](const RecordPoint& p) { return p.block.restitution; })};
        const auto together = run(block, excitation_of<directions>(points));
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const auto alone = run(points[lane].block, excitation_of<directions>(points[lane]));
            expect_bits(together.state.tilt, lane, alone.state.tilt);
            expect_bits(together.state.rate, lane, alone.state.rate);
            expect_bits(together.state.side, lane, alone.state.side);
            expect_bits(together.impacts, lane, alone.impacts);
            expect_bits(together.steps, lane, alone.steps);
            expect_bits(together.error, lane, alone.error);
            expect_bits(together.peak, lane, alone.peak);
        }
    }
}

/// The ground accelerates upwards with 2 g.
template <Number T>
struct SteadyUpwards {
    struct Motion {
        double end = 100;
        mask_t<T> is_monotone(const T& from, const T& to) const { return from <= to; }
    };
    Motion motion;
    T frequency = T(1);
    Ground<T> ground(const T&) const { return {T(0), T(3)}; }
};

TEST(RecordInLanes, EndsABounceSeriesAsInADouble)
{
    // The limit of a slow impact, alpha / sqrt(10) = 0.063, is below the limit of a low bounce
    // here, 3 sin(alpha) / sqrt(30) = 0.109: a fast impact must not depend on a slow one beside it.
    const auto die_out = []<class T>(const T& rate) {
        return select<T>(bounces_die_out<Theory::nonlinear>(Block<T>{T(0.2), T(0.01)},
                                                            SteadyUpwards<T>{}, T(0), rate),
                         T(1), T(0));
    };
    std::array<double, lanes> rates;
    rates.fill(0.0775);
    rates[0] = 0.01;
    const Lanes together = die_out(load<Lanes>(rates.data()));
    ASSERT_EQ(lanes_of(together)[0], 1);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        expect_bits(together, lane, die_out(rates[lane]));
    }
}

TEST(RecordInLanes, EndsAsInADouble)
{
    expect_equal_ends<Directions::horizontal, Outputs{.impacts = true, .error = true}>();
    expect_equal_ends<Directions::both, Outputs{.impacts = true, .error = true}>();
    expect_equal_ends<Directions::both, Outputs{.peak = true}>();
}

} // namespace
} // namespace overturn
