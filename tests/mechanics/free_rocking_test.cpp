#include "overturn/mechanics/energy_criteria.hpp"
#include "overturn/mechanics/free_rocking.hpp"
#include "support/free_motion.hpp"
#include "support/free_stage.hpp"

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <gtest/gtest.h>

#include <random>
#include <set>

namespace overturn {
namespace {

struct RockingStart {
    State<double> state;
    Block<double> block;
};

/// Blocks of every kind in states of every region.
std::vector<RockingStart> rocking_starts(int count)
{
    std::mt19937_64 generator(21);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<RockingStart> starts;
    for (int i = 0; i < count; ++i) {
        const double slenderness = 0.01 + 1.2 * uniform(generator) * uniform(generator);
        const double tilt = std::min(2.2 * slenderness, 1.57) * uniform(generator);
        const double rate = 2.2 * slenderness * (2 * uniform(generator) - 1);
        starts.push_back({{tilt, rate, uniform(generator) < 0.5 ? -1.0 : 1.0},
                          {slenderness, 0.3 + 0.7 * uniform(generator)}});
    }
    return starts;
}

/// States whose rate is within 1e-12 of the separatrix, or of the limit at which the block just
/// does not overturn after its impact.
std::vector<RockingStart> starts_next_to_a_boundary(int count)
{
    std::mt19937_64 generator(22);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<RockingStart> starts = rocking_starts(count);
    for (std::size_t i = 0; i < starts.size(); ++i) {
        State<double>& state = starts[i].state;
        const SafeRates<double> safe = safe_rates<Theory::nonlinear>(state.tilt, starts[i].block);
        const double limits[]{safe.outward, -safe.outward, -safe.inward().limit};
        state.rate = limits[i % 3] + 1e-12 * uniform(generator);
    }
    return starts;
}

State<Digits50> in_digits(const State<double>& state)
{
    return {state.tilt, state.rate, state.side};
}

/// Difference of the closed form in doubles and the integrated motion, over the size of the motion.
template <Theory theory>
class AgainstIntegration {
public:
    explicit AgainstIntegration(const RockingStart& start)
        : alpha_(start.block.slenderness), restitution_(start.block.restitution),
          rocking_(start.state, start.block),
          motion_(in_digits(start.state), start.block.slenderness)
    {}

    /// Three instants of each arc, and its end, until the block overturns or the arcs end.
    void compare(int arcs)
    {
        for (; arcs > 0; --arcs) {
            const double begin = rocking_.begin();
            const double impact = rocking_.impact_time();
            const double fall = rocking_.fall_time();
            const double end = std::min({impact, fall, begin + 40});
            for (const double share : {0.0, 0.3, 0.8}) {
                const double time = begin + share * (end - begin);
                motion_.go_on_until(time);
                const State<double> found = rocking_.arc().at(time - begin);
                note(found.tilt - motion_.state().tilt, alpha_);
                note(found.rate - motion_.state().rate, alpha_);
            }
            if (end < impact) {
                if (end == fall) {
                    motion_.go_on_to_tilt(boost::math::constants::half_pi<Digits50>());
                    note(fall - motion_.time(), fall);
                }
                return;
            }
            motion_.go_on_to_tilt(0);
            note(impact - motion_.time(), impact);
            note(rocking_.arc().impact_speed() + motion_.state().rate, alpha_);
            motion_.strike(restitution_);
            rocking_.strike();
            EXPECT_EQ(rocking_.arc().side(), double(motion_.state().side));
        }
    }

    double largest_error() const { return largest_; }

private:
    void note(const Digits50& error, double size)
    {
        largest_ = std::max(largest_, double(abs(error)) / size);
    }

    double alpha_;
    double restitution_;
    FreeRocking<theory, double> rocking_;
    FreeMotion<theory> motion_;
    double largest_ = 0;
};

template <Theory theory>
double largest_error(const std::vector<RockingStart>& starts)
{
    double largest = 0;
    for (const RockingStart& start : starts) {
        AgainstIntegration<theory> against(start);
        against.compare(3);
        largest = std::max(largest, against.largest_error());
    }
    return largest;
}

TEST(FreeRocking, EqualsTheIntegratedMotionFromEveryRegion)
{
    const std::vector<RockingStart> starts = rocking_starts(150);
    std::set<Region> seen;
    for (const RockingStart& start : starts) {
        seen.insert(region_after_pulse<Theory::nonlinear>(start.state, start.block));
    }
    ASSERT_EQ(seen.size(), 7u);
    EXPECT_LT(largest_error<Theory::nonlinear>(starts), 1e-13);
    EXPECT_LT(largest_error<Theory::linear>(starts), 1e-13);
}

TEST(FreeRocking, EqualsTheIntegratedMotionNextToTheSeparatrix)
{
    // The block stays on its edge for about 28/p. With q computed from doubles, which has a
    // relative accuracy of 1e-4 there, the time of overturning would have the same error.
    EXPECT_LT(largest_error<Theory::nonlinear>(starts_next_to_a_boundary(45)), 1e-13);
}

TEST(FreeRocking, ObeysItsEquationAndConservesQ)
{
    // By differences in 50 digits, with an error of h^2 / 12 times a derivative below 10.
    const Digits50 h = 1e-12;
    for (const RockingStart& start : rocking_starts(50)) {
        const Digits50 alpha = start.block.slenderness;
        const State<Digits50> begin = in_digits(start.state);
        const Digits50 q = conserved_q<Theory::nonlinear>(begin, BlockSide{alpha});
        const RockingArc<Theory::nonlinear, Digits50> arc(begin, BlockSide{alpha}, q);
        const Digits50 ends = std::min<Digits50>(arc.time_to_impact(), arc.time_to_fall());
        const Digits50 time = std::min<Digits50>(ends, 5) / 3 + 2 * h;
        const State<Digits50> before = arc.at(Digits50(time - h));
        const State<Digits50> now = arc.at(time);
        const State<Digits50> after = arc.at(Digits50(time + h));
        EXPECT_LT(abs(before.tilt - 2 * now.tilt + after.tilt + h * h * sin(alpha - now.tilt)),
                  h * h * 1e-20);
        EXPECT_LT(abs((after.tilt - before.tilt) / (2 * h) - now.rate), 1e-20);
        EXPECT_LT(abs(conserved_q<Theory::nonlinear>(now, BlockSide{alpha}) - q), 1e-40);
    }
}

TEST(RockingArc, EqualsThePapersInJacobiFunctionsOfARealModulus)
{
    // y = sin((alpha - theta) / 2) obeys y'^2 = (1 - y^2) (y^2 - q/4) (Eq. 27): from a turn on it
    // is kappa nd(tau), kappa^2 = q/4, of modulus sqrt(1 - kappa^2).
    using boost::math::ellint_1;
    using boost::math::jacobi_nd;
    const Digits50 alpha("0.3");
    for (const char* tilt : {"0.01", "0.2", "0.29", "0.2999999"}) {
        const State<Digits50> turned{Digits50(tilt), 0, 1};
        const Digits50 kappa = sin((alpha - turned.tilt) / 2);
        // Relative accuracy of the distance of the modulus from 1 in the digits of the modulus.
        const Digits50 modulus = sqrt(1 - kappa * kappa);
        const Digits50 tolerance = 1e-48 / (kappa * kappa);
        const RockingArc<Theory::nonlinear, Digits50> arc(turned, BlockSide{alpha},
                                                          4 * kappa * kappa);
        for (const char* share : {"0.1", "0.5", "0.99"}) {
            const Digits50 time = Digits50(share) * arc.time_to_impact();
            EXPECT_LT(abs(sin((alpha - arc.at(time).tilt) / 2) - kappa * jacobi_nd(modulus, time)),
                      tolerance);
        }
        // Half of Eq. 42: F of the angle whose sine is sn.
        const Digits50 y = sin(alpha / 2);
        const Digits50 sn = sqrt((y * y - kappa * kappa)) / (y * modulus);
        EXPECT_LT(abs(arc.time_to_impact() - ellint_1(modulus, Digits50(asin(sn)))), tolerance);
    }
}

TEST(RockingArc, OfTheLinearTheoryHasTheHalfPeriodOfAHyperbolicTangent)
{
    for (const double v : {1e-8, 0.1, 0.29}) {
        const State<double> upright{0, v, 1};
        const RockingArc<Theory::linear, double> arc(
            upright, BlockSide{0.3}, double(conserved_q<Theory::linear>(upright, BlockSide{0.3})));
        const double half_period =
            2 * std::atanh(v / 0.3); // of a closed form, at x / (1 - x^2) eps
        EXPECT_NEAR(arc.time_to_impact(), half_period, 1e-14 * half_period);
    }
}

TEST(RockingArc, IsAParabolaIfTheBlockHardlyRises)
{
    // The relative change of the restoring acceleration is less than v / sin(alpha).
    const double v = 1e-12;
    const State<double> upright{0, v, 1};
    const RockingArc<Theory::nonlinear, double> arc(
        upright, BlockSide{0.3}, double(conserved_q<Theory::nonlinear>(upright, BlockSide{0.3})));
    const double pull = std::sin(0.3);
    EXPECT_NEAR(arc.time_to_impact(), 2 * v / pull, 1e-11 * v);
    for (const double share : {0.1, 0.5, 0.9}) {
        const double time = share * arc.time_to_impact();
        const double height = v * time - pull * time * time / 2;
        EXPECT_NEAR(arc.at(time).tilt, height, 1e-11 * height);
    }
}

TEST(RockingArc, StaysOnTheEdgeForeverOnTheSeparatrix)
{
    const Digits50 alpha("0.3");
    const Digits50 tilt("0.1");
    const State<Digits50> rising{tilt, 2 * sin((alpha - tilt) / 2), 1};
    const RockingArc<Theory::nonlinear, Digits50> arc(rising, BlockSide{alpha}, 0);
    EXPECT_TRUE(isinf(arc.time_to_impact()));
    EXPECT_TRUE(isinf(arc.time_to_fall()));
    EXPECT_LT(abs(arc.at(Digits50(80)).tilt - alpha), 1e-34); // exp(-80)
    // It is the limit from both sides. After 3/p, the effect of q is about q e^3 / 4.
    for (const double q : {1e-30, -1e-30}) {
        const RockingArc<Theory::nonlinear, Digits50> beside(rising, BlockSide{alpha}, q);
        EXPECT_LT(abs(beside.at(Digits50(3)).tilt - arc.at(Digits50(3)).tilt), 1e-28);
        EXPECT_NE(isinf(beside.time_to_impact()), isinf(beside.time_to_fall()));
    }
    // Away from the edge, on either side, it strikes the ground or overturns in a finite time.
    const State<Digits50> sinking{tilt, -rising.rate, 1};
    EXPECT_LT(
        (RockingArc<Theory::nonlinear, Digits50>(sinking, BlockSide{alpha}, 0).time_to_impact()),
        2);
    const State<Digits50> beyond{Digits50("0.5"), 2 * sin((Digits50("0.5") - alpha) / 2), 1};
    EXPECT_LT((RockingArc<Theory::nonlinear, Digits50>(beyond, BlockSide{alpha}, 0).time_to_fall()),
              4);
}

TEST(FreeRocking, HasTheOutcomeOfTheRegion)
{
    for (const RockingStart& start : rocking_starts(20000)) {
        const Region region = region_after_pulse<Theory::nonlinear>(start.state, start.block);
        FreeRocking<Theory::nonlinear, double> rocking(start.state, start.block);
        while (rocking.impacts() < 3 && std::isfinite(rocking.impact_time())) {
            rocking.strike();
        }
        EXPECT_EQ(std::isfinite(rocking.fall_time()), is_unsafe(region));
        if (is_unsafe(region)) {
            const bool without = region == Region::U0_plus || region == Region::U0_minus;
            const bool to_plus = region == Region::U0_plus || region == Region::U1_plus;
            EXPECT_EQ(rocking.impacts(), without ? 0 : 1);
            EXPECT_EQ(rocking.arc().side(), to_plus ? 1 : -1);
        }
    }
}

template <Theory theory>
void expect_the_sum_of_all_half_periods(double restitution)
{
    const Block<double> block{0.3, restitution};
    const State<double> begin{0.2, 0.05, -1};
    FreeRocking<theory, double> rocking(begin, block);
    while (rocking.arc().impact_speed() > 1e-16) {
        rocking.strike();
    }
    // Each of the n summed terms is rounded to half an epsilon of the sum.
    EXPECT_NEAR(time_of_rest<theory>(begin, block), rocking.begin(),
                rocking.impacts() * rocking.begin() * 0x1p-53);
}

TEST(TimeOfRest, IsTheLimitOfTheImpacts)
{
    for (const double restitution : {1e-12, 0.1, 0.8, 0.99}) {
        expect_the_sum_of_all_half_periods<Theory::nonlinear>(restitution);
        expect_the_sum_of_all_half_periods<Theory::linear>(restitution);
    }
}

TEST(TimeOfRest, OfABlockWithHardlyAnyLossIsFoundWithoutAllItsImpacts)
{
    // With 1 - r = d, the half period T(v) at v^2 = z q_max is followed by z (1 - d): the sum tends
    // to the integral of T dz / (z d), here with T = 2 artanh(sqrt z), up to half a T: in the
    // linear theory 2/d (Li2(x) - Li2(-x)), x = v / alpha.
    const auto dilogarithm = [](double x) {
        double sum = 0;
        for (int k = 400; k > 0; --k) {
            sum += std::pow(x, k) / (double(k) * k);
        }
        return sum;
    };
    const double d = 1e-8;
    const double tilt = 0.05;
    const double x = std::sqrt(tilt * (0.6 - tilt)) / 0.3;
    const double integral = 2 / d * (dilogarithm(x) - dilogarithm(-x));
    EXPECT_NEAR((time_of_rest<Theory::linear, double>({tilt, 0, 1}, {0.3, 1 - d})), integral,
                1e-7 * integral);
}

TEST(TimeOfRest, OfABlockNextToTheSeparatrixWithHardlyAnyLossIsAnIntegral)
{
    // As above, with x next to 1: Li2(x) = pi^2 / 6 - log x log(1 - x) - Li2(1 - x), and
    // Li2(-1 + y) = -pi^2 / 12 + y log 2 to first order.
    const double d = 1e-14;
    const Block<double> block{0.3, 1 - d};
    const State<double> begin{0.3 - 1e-9, 0, 1}; // q = 1e-18: x = 1 - q / 2 alpha^2
    const double y = 1e-18 / (2 * 0.3 * 0.3);
    const double pi_square = pi<double>() * pi<double>();
    const double half_first = std::log(2 / y) / 2; // T(v) / 2, far below 1/d
    const double expected = 2 / d * (pi_square / 6 + pi_square / 12 + y * std::log(y)) + half_first;
    // r itself is rounded to half an epsilon of d / 1.1e-16: a hundredth.
    const double rounded = 1 - block.restitution;
    EXPECT_NEAR((time_of_rest<Theory::linear, double>(begin, block)), expected * (d / rounded),
                1e-9 * expected);
    EXPECT_TRUE(std::isfinite(time_of_rest<Theory::nonlinear, double>(begin, block)));
}

TEST(TimeOfRest, IsInfiniteForABlockThatOverturnsOrHasNoLoss)
{
    EXPECT_TRUE(std::isinf(time_of_rest<Theory::nonlinear, double>({0.1, 1, 1}, {0.3, 0.8})));
    EXPECT_TRUE(std::isinf(time_of_rest<Theory::nonlinear, double>({0.1, -1, 1}, {0.3, 0.8})));
    EXPECT_TRUE(std::isinf(time_of_rest<Theory::nonlinear, double>({0.1, 0, 1}, {0.3, 1})));
    EXPECT_EQ((time_of_rest<Theory::nonlinear, double>({0, 0, 1}, {0.3, 0.8})), 0);
}

} // namespace
} // namespace overturn
