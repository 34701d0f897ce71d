#include "overturn/mechanics/free_contact.hpp"
#include "overturn/mechanics/free_rocking.hpp"
#include "overturn/number/digits50.hpp"
#include "support/special_values.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include <random>

namespace overturn {
namespace {

using Numbers = std::uniform_real_distribution<double>;

/// Any block with two sides.
template <class T = double>
Block<T> random_block(std::mt19937_64& generator)
{
    Numbers uniform(0, 1);
    const auto side = [&] {
        return BlockSide<T>{T(0.1 + 0.6 * uniform(generator)), T(0.9 + 0.2 * uniform(generator)),
                            T(0.5 + uniform(generator))};
    };
    const BlockSide<T> here = side();
    const T restitution(0.3 + 0.7 * uniform(generator));
    return {here, restitution, side()};
}

template <class T>
ContactSide<T> random_side(std::mt19937_64& generator)
{
    return ContactSides<T>(random_block<T>(generator), T(0.2 + Numbers(0, 1)(generator))).plus;
}

template <class T>
using Moving = MovingBlock<T, Ground<T>>;

template <class T>
Moving<T> random_motion(std::mt19937_64& generator)
{
    Numbers uniform(-1, 1);
    const auto any = [&] { return T(uniform(generator)); };
    return {T(0.5) + any() / 2, any(), {any(), T(1) + any() / 2}, {any(), any()}};
}

double radius_of_box_gyration()
{
    return std::sqrt(1.0 / 3);
}

TEST(ContactForce, IsThatOfTheSecondDerivativeOfThePlaceOfTheCentreOfMass)
{
    using T = Digits50;
    std::mt19937_64 generator(1);
    for (int i = 0; i < 100; ++i) {
        const ContactSide<T> level{random_side<T>(generator).inertia, 1, 0};
        const T slenderness = 0.4;
        const Moving<T> now = random_motion<T>(generator);
        const T h(1e-12);
        const T pull =
            Equations<Theory::nonlinear>::acceleration(BlockSide{slenderness}, now.tilt, now.push);
        const auto y_at = [&](const T& time) -> T {
            return slenderness - (now.tilt + now.rate * time + pull * time * time / 2);
        };
        const auto second = [&](const auto& function) -> T {
            return (function(y_at(h)) - 2 * function(y_at(0)) + function(y_at(-h))) / (h * h);
        };
        const T outward = second([](const T& y) -> T { return -sin(y); });
        const T upward = second([](const T& y) -> T { return cos(y); });
        const auto force = force_while_rocking(level, slenderness, now);
        EXPECT_LT(abs(force.along - (now.push.horizontal + level.inertia * outward)), 1e-20);
        EXPECT_LT(abs(force.normal - (now.push.gravity + level.inertia * upward)), 1e-20);
    }
}

TEST(ContactForce, HasTheDerivativesOfItsDifferenceQuotients)
{
    using T = Digits50;
    std::mt19937_64 generator(2);
    for (int i = 0; i < 100; ++i) {
        const ContactSide<T> side = random_side<T>(generator);
        const T slenderness = 0.3;
        const Moving<T> now = random_motion<T>(generator);
        const T pull =
            Equations<Theory::nonlinear>::acceleration(BlockSide{slenderness}, now.tilt, now.push);
        const auto at = [&](const T& time) {
            Moving<T> then = now;
            then.tilt += now.rate * time;
            then.rate += pull * time;
            then.push.horizontal += now.push_slope.horizontal * time;
            then.push.gravity += now.push_slope.gravity * time;
            return force_while_rocking(side, slenderness, then);
        };
        const T h(1e-15);
        const auto force = at(0);
        EXPECT_LT(abs(force.along_slope - (at(h).along - at(-h).along) / (2 * h)), 1e-25);
        EXPECT_LT(abs(force.normal_slope - (at(h).normal - at(-h).normal) / (2 * h)), 1e-25);

        const T q = 0.1 * T(i % 7 - 3);
        const T y = T(0.01) * T(i);
        const auto arc = [&](const T& place) {
            return force_on_arc(side, q, sine_and_cosine(place));
        };
        EXPECT_LT(abs(arc(y).along_slope - (arc(y + h).along - arc(y - h).along) / (2 * h)), 1e-25);
        EXPECT_LT(abs(arc(y).normal_slope - (arc(y + h).normal - arc(y - h).normal) / (2 * h)),
                  1e-25);
    }
}

TEST(ContactForce, HasAFourthDerivativeBelowItsBound)
{
    using T = Digits50;
    std::mt19937_64 generator(9);
    Numbers uniform(0, 1);
    double closest = 0;
    for (int i = 0; i < 300; ++i) {
        const ContactSide<T> side = random_side<T>(generator);
        const T slenderness(0.1 + 0.6 * uniform(generator));
        const T tilt(uniform(generator));
        const T rate(2 * uniform(generator) - 1);
        const T size(2 * uniform(generator) * uniform(generator));
        const T frequency(4 * uniform(generator) * uniform(generator));
        const T phase(6 * uniform(generator));
        // The push is size sin(phase + frequency tau).
        constexpr int order = 14;
        const auto push = harmonic_series<order>(
            {T(size * sin(phase)), T(size * frequency * cos(phase))}, frequency);
        const auto motion = Equations<Theory::nonlinear>::series<order>(BlockSide{slenderness},
                                                                        tilt, rate, push, T(1));
        const auto force_at = [&](const T& time) {
            const auto sum = [&](const auto& series) -> T {
                T value(0);
                for (std::size_t k = series.size(); k-- > 0;) {
                    value = value * time + series[k];
                }
                return value;
            };
            return force_while_rocking(
                side, slenderness,
                MovingBlock<T, T>{sum(motion.tilt), sum(motion.rate), sum(push), T(0)});
        };
        const T h(1e-8); // the difference has an error of h^2, and a round-off of 1e-50 / h^4
        const auto difference = [&](T ContactForce<T>::*part) -> T {
            const auto at = [&](int k) -> T { return force_at(k * h).*part; };
            return (at(-2) - 4 * at(-1) + 6 * at(0) - 4 * at(1) + at(2)) / (h * h * h * h);
        };
        const T along = difference(&ContactForce<T>::along);
        const T normal = difference(&ContactForce<T>::normal);
        const T square = frequency * frequency;
        const T bound =
            fourth_derivative_of_force<T>(side.inertia, abs(rate),
                                          {sqrt(1 + size * size), size * frequency, size * square,
                                           size * square * frequency, size * square * square});
        const double share(sqrt(along * along + normal * normal) / bound);
        EXPECT_LT(share, 1) << i;
        closest = std::max(closest, share);
    }
    // Where all terms have the same sign the bound is close; one without a term would be exceeded.
    EXPECT_GT(closest, 0.2);
}

TEST(ContactForce, AtUpliftIsDirectedAtTheCentreOfMassWhateverTheIncline)
{
    std::mt19937_64 generator(3);
    for (int i = 0; i < 200; ++i) {
        const Block<double> block = random_block(generator);
        const ContactSide<double> side = contact_side(block, 0.5, block.size);
        const double push = -std::tan(block.slenderness);
        // Of the foot of the centre of mass on the base, which passes through both corners.
        const double up = block.size * std::cos(block.slenderness) -
                          block.other.size * std::cos(block.other.slenderness);
        const double across = block.size * std::sin(block.slenderness) +
                              block.other.size * std::sin(block.other.slenderness);
        const double turned = block.slenderness + std::atan2(up, across);
        const double ratio = std::tan(turned); // b / h
        const auto rocking = force_while_rocking(side, block.slenderness,
                                                 MovingBlock<double, double>{0, 0, push, 0});
        EXPECT_NEAR(rocking.along / rocking.normal, -ratio, 1e-13 * (1 + std::abs(ratio)));
        const auto resting = force_at_rest(side, push, 0.0);
        EXPECT_NEAR(resting.along, rocking.along, 1e-14);
        EXPECT_NEAR(resting.normal, rocking.normal, 1e-14);
    }
}

TEST(ContactForce, OfABoxUnderASuddenAccelerationIsThatOfShenton)
{
    const double expected[] = {0.25, 0.3098592, 0.4155844}; // k = h / b = 4
    const double accelerations[] = {0.25, 0.5, 1};
    const Block<double> block{std::atan(0.25), 0.9};
    const ContactSide<double> side = contact_side(block, radius_of_box_gyration(), 1.0);
    EXPECT_NEAR(side.inertia, 0.75, 1e-15);
    for (int i = 0; i < 3; ++i) {
        const double a = accelerations[i];
        const double k = 4;
        const auto force =
            force_while_rocking(side, block.slenderness, MovingBlock<double, double>{0, 0, -a, 0});
        EXPECT_NEAR(force.friction(), (a * (4 + k * k) + 3 * k) / (4 * k * k + 1 + 3 * k * a),
                    1e-14);
        EXPECT_NEAR(force.friction(), expected[i], 5e-8);
    }
}

TEST(FrictionOfAnImpact, OfABoxAtTheLargestRestitutionHasAClosedForm)
{
    for (const double alpha : {0.05, 0.2, 0.5}) {
        const Block<double> block{alpha, largest_restitution(alpha)};
        const ContactSides<double> sides(block, radius_of_box_gyration());
        const double s = std::sin(alpha);
        EXPECT_NEAR(friction_of_impact(block, sides.plus, sides.minus),
                    3 * s * std::cos(alpha) / (4 - 3 * s * s), 1e-15);
    }
    const Block<double> block{0.2, largest_restitution(0.2)};
    const ContactSides<double> sides(block, radius_of_box_gyration());
    EXPECT_NEAR(friction_of_impact(block, sides.plus, sides.minus), 0.1504866, 5e-8);
}

TEST(FrictionOfAnImpact, IsThatOfTheChangeOfMomentum)
{
    std::mt19937_64 generator(7);
    int pulling = 0;
    int outside = 0;
    for (int i = 0; i < 200; ++i) {
        Block<double> block = random_block(generator);
        if (i % 2 == 1) { // steeply inclined: the foot is often outside the base
            block.size *= 0.6;
        }
        const ContactSides<double> sides(block, 0.5);
        // Velocities of the centre of mass before and after, along the base towards the corner j
        // and upwards: omega times the distances from the corners.
        const auto here = foot_of_centre(sides.plus, block.slenderness);
        const auto there = foot_of_centre(sides.minus, block.other.slenderness);
        EXPECT_NEAR(block.size * here.height, block.other.size * there.height, 1e-14); // one base
        const double before = 1 * block.frequency_parameter;
        const double after = block.rate_ratio() * block.other.frequency_parameter;
        const double along = block.size * here.height * (before - after);
        const double upward =
            block.other.size * there.distance * after + block.size * here.distance * before;
        pulling += upward <= 0;
        outside += here.distance < 0;
        if (upward > 0) {
            // The relative rounding of the difference `along` and of `upward`.
            const double expected = std::abs(along) / upward;
            EXPECT_NEAR(friction_of_impact(block, sides.plus, sides.minus), expected,
                        1e-14 * (1 + expected) * (1 + before / upward));
        } else {
            EXPECT_EQ(friction_of_impact(block, sides.plus, sides.minus),
                      std::numeric_limits<double>::infinity());
        }
        EXPECT_NEAR(friction_to_lift(sides.plus, block.slenderness),
                    std::abs(here.distance) / here.height, 1e-15);
    }
    EXPECT_GE(pulling, 3);
    EXPECT_GE(outside, 20);
}

TEST(ContactForce, OnAnArcIsThatOfTheSameMotion)
{
    std::mt19937_64 generator(4);
    Numbers uniform(0, 1);
    for (int i = 0; i < 1000; ++i) {
        const ContactSide<double> side = random_side<double>(generator);
        const double slenderness = 0.1 + 0.5 * uniform(generator);
        const double tilt = 1.2 * uniform(generator);
        const double rate = 2 * uniform(generator) - 1;
        const double c =
            Equations<Theory::nonlinear>::separatrix_rate(BlockSide{slenderness}, tilt);
        const auto arc =
            force_on_arc(side, (c - rate) * (c + rate), sine_and_cosine(slenderness - tilt));
        const auto force =
            force_while_rocking(side, slenderness, MovingBlock<double, double>{tilt, rate, 0, 0});
        EXPECT_NEAR(arc.along, force.along, 1e-14);
        EXPECT_NEAR(arc.normal, force.normal, 1e-14);
        EXPECT_NEAR(force.along_slope, -rate * arc.along_slope, 1e-14); // y' = -rate
        EXPECT_NEAR(force.normal_slope, -rate * arc.normal_slope, 1e-14);
    }
}

/// Over m g R, the energy of the motion of the centre of mass is lambda rate^2 / 2 + cos y, with y
/// the angle between the line to the corner and the vertical.
TEST(ContactForce, DoesTheWorkThatChangesTheEnergyOfTheCentreOfMass)
{
    std::mt19937_64 generator(8);
    Numbers uniform(-1, 1);
    double largest = 0;
    for (int i = 0; i < 200; ++i) {
        const Block<double> block(0.1 + 0.25 * (1 + uniform(generator)), 0.8);
        const ContactSide<double> side{0.6 + 0.2 * uniform(generator), 1, 0};
        const double alpha = block.slenderness;
        const State<double> start{alpha * (0.5 + uniform(generator) / 2),
                                  alpha * uniform(generator), 1};
        const FreeRocking<Theory::nonlinear, double> rocking(start, block);
        const double end = std::min({rocking.impact_time(), rocking.fall_time(), 2.0});
        const auto power = [&](double time) {
            const State<double> at = rocking.at(time);
            const double y = alpha - at.tilt;
            const auto force = force_while_rocking(
                side, alpha, MovingBlock<double, double>{at.tilt, at.rate, 0, 0});
            return at.rate * (force.along * std::cos(y) + force.normal * std::sin(y));
        };
        const auto energy = [&](double time) {
            const State<double> at = rocking.at(time);
            return side.inertia * at.rate * at.rate / 2 + std::cos(alpha - at.tilt);
        };
        const double last = std::nextafter(end, 0.0); // before an impact
        double work = 0;
        constexpr int panels = 8; // of at most a quarter of 1/p, to rounding
        for (int k = 0; k < panels; ++k) {
            work += boost::math::quadrature::gauss<double, 15>::integrate(power, last * k / panels,
                                                                          last * (k + 1) / panels);
        }
        EXPECT_NEAR(work, energy(last) - energy(0), 1e-13) << i;
        largest = std::max(largest, std::abs(work));
    }
    EXPECT_GT(largest, 0.01);
}

TEST(ContactDemand, OnAnArcIsThatOfTheExtremesWithin)
{
    std::mt19937_64 generator(5);
    Numbers uniform(0, 1);
    int both = 0;
    for (int i = 0; i < 400; ++i) {
        const ContactSide<double> side = random_side<double>(generator);
        const double q = 0.6 * (uniform(generator) - 0.5);
        const double first = -1.5 + uniform(generator);
        const double last = 1.5 - uniform(generator);
        const SineAndCosine<double> low = sine_and_cosine(first);
        const SineAndCosine<double> high = sine_and_cosine(last);
        const auto found = demand_on_arc(side, q, low, high);
        double friction = 0;
        double normal = 2;
        constexpr int samples = 1000;
        for (int k = 0; k <= samples; ++k) {
            const auto force =
                force_on_arc(side, q, sine_and_cosine(first + (last - first) * k / samples));
            friction = std::max(friction, force.friction());
            normal = std::min(normal, force.normal);
        }
        // The samples miss an extreme by at most the curvature times `missed`. The parts of the
        // force are less than 3, their slopes than 6 and their curvatures than 9; the curvature of
        // the friction is less than 600 over the cube of the normal force.
        const double missed = std::pow((last - first) / (2 * samples), 2) / 2;
        EXPECT_LE(found.normal, normal + 1e-14) << i;
        EXPECT_GE(found.normal, normal - 9 * missed) << i;
        if (normal > 0.1) {
            EXPECT_GE(found.friction, friction * (1 - 1e-13)) << i;
            EXPECT_LE(found.friction, friction + 600 * missed / std::pow(normal, 3)) << i;
        } else if (normal < 0) {
            EXPECT_EQ(found.friction, infinity) << i;
        }
        const auto places = places_of_least_normal(side, q, low.sine, high.sine);
        both += !std::isnan(places[0]) && !std::isnan(places[1]);
    }
    EXPECT_GT(both, 10);
}

/// The extremes of many samples of a free motion until the block last passes alpha.
ContactDemand<double> sampled(const State<double>& state, const Block<double>& block,
                              const ContactSides<double>& sides, int arcs, int samples)
{
    ContactDemand<double> kept;
    ContactDemand<double> beyond;
    FreeRocking<Theory::nonlinear, double> rocking(state, block);
    for (int arc = 0; arc < arcs; ++arc) {
        const bool falls = std::isfinite(rocking.fall_time());
        const double end = falls ? rocking.fall_time() : rocking.impact_time();
        if (!std::isfinite(end)) {
            break;
        }
        for (int k = 0; k <= samples; ++k) {
            const double share = double(k) / samples;
            const State<double> at = rocking.at(rocking.begin() + share * (end - rocking.begin()));
            const double alpha = rocking.block().slenderness;
            const auto demand =
                demand_of(force_while_rocking(sides.seen_from(at.side), alpha,
                                              MovingBlock<double, double>{at.tilt, at.rate, 0, 0}));
            if (at.tilt > alpha) {
                beyond.include(demand, true);
            } else {
                kept.include(beyond, true);
                beyond.forget(true);
                kept.include(demand, true);
            }
        }
        if (falls) {
            break;
        }
        kept.include(beyond, true);
        beyond.forget(true);
        rocking.strike();
    }
    return kept;
}

/// With --gtest_shuffle, other states in each repetition.
TEST(FreeContact, IsThatOfFineSamplesOfTheMotion)
{
    const bool varies = GTEST_FLAG_GET(shuffle);
    std::mt19937_64 generator(6 + (varies ? testing::UnitTest::GetInstance()->random_seed() : 0));
    Numbers uniform(0, 1);
    int overturned = 0;
    for (int i = 0; i < 1500; ++i) {
        Block<double> block = random_block(generator);
        if (i % 2 == 0) {
            block = {block.slenderness, block.restitution};
        }
        const ContactSides<double> sides(block, 0.3 + 0.5 * uniform(generator));
        const double tilt = 2 * block.slenderness * uniform(generator);
        const double rate = 2.5 * block.slenderness * (2 * uniform(generator) - 1);
        const State<double> state{tilt, rate, 1};
        const auto found = free_contact(state, block, sides, true);
        // Where the block passes alpha, the last sample is up to one interval before.
        constexpr int samples = 500;
        const auto seen = sampled(state, block, sides, 12, samples);
        overturned += std::isfinite(time_to_lie_flat<Theory::nonlinear, double>(state, block));
        if (std::isfinite(found.friction)) {
            // Both forces have round-off of some 1e-14.
            EXPECT_GE(found.friction, seen.friction * (1 - 1e-13 / seen.normal) - 1e-13) << i;
            EXPECT_GE(found.normal, 0) << i;
        }
        EXPECT_LE(found.normal, seen.normal + 1e-10) << i;
        EXPECT_GE(found.normal, seen.normal - 5.0 / samples) << i;
        if (seen.normal > 0.05) {
            // Beyond the samples, only the limit of many arcs is larger.
            double limit = 0;
            for (const double side : {1.0, -1.0}) {
                limit = std::max(
                    limit,
                    standing_contact(seen_from(side, block), sides.seen_from(side)).friction);
            }
            EXPECT_LE(found.friction, std::max(seen.friction, limit) * (1 + 5.0 / samples)) << i;
        }
    }
    EXPECT_GT(overturned, 250);
}

} // namespace
} // namespace overturn
