// The forced stage under records, compared with closed forms.
#include "support/linear_reference.hpp"
#include "support/record_point.hpp"
#include "support/special_values.hpp"

#include "overturn/integrate/forced_stage.hpp"
#include "overturn/mechanics/free_rocking.hpp"
#include "overturn/number/digits50.hpp"
#include "overturn/number/double_double.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace overturn {
namespace {

double exact_margin(const LinearEnd& end, const RecordPoint& point)
{
    const Block<Digits50> block{point.block.slenderness, point.block.restitution};
    const State<Digits50> state{end.tilt, end.rate, end.side};
    return double(end.fell ? margin_of_fall<Theory::linear>(state.rate, block)
                           : margin_after_pulse<Theory::linear>(state, block));
}

TEST(RecordInLinearTheory, EndsInTheStateOfItsClosedForm)
{
    std::mt19937_64 generator(21);
    const int runs = 600;
    int known = 0;
    int fell = 0;
    int rested = 0;
    int stood_after_impacts = 0;
    for (int i = 0; i < runs; ++i) {
        const RecordPoint point = random_record_point(generator, 40, Directions::horizontal);
        const double alpha = point.block.slenderness;
        const auto end = run_record<Theory::linear, Directions::horizontal>(point, 1e-12);
        if (!(end.error < infinity)) {
            continue;
        }
        ++known;
        const LinearEnd exact = LinearReference(point).run();
        fell += exact.fell;
        rested += exact.rested;
        stood_after_impacts += !exact.fell && exact.impacts > 2;
        ASSERT_EQ(end.fell, exact.fell) << i;
        EXPECT_EQ(end.rested, exact.rested) << i;
        EXPECT_NEAR(margin_of<Theory::linear>(end, point.block), exact_margin(exact, point),
                    end.error)
            << i;
        // Errors of at most 1e-12 alpha per step grow e-fold in 1/p, 2 to 15 of them, and at slow
        // impacts. A push that is off by a part in a million would be visible in most runs.
        EXPECT_LT(end.error, 1e-3) << i;
        if (!exact.fell) {
            // The error of the margin is that of tilt + rate, or tilt - rate, over alpha. Across
            // these directions the error of a state is smaller; in 60000 other runs, its largest
            // component was 1.6 times the bound.
            EXPECT_NEAR(end.state.tilt, double(exact.tilt), 4 * end.error * alpha) << i;
            EXPECT_NEAR(end.state.rate, double(exact.rate), 4 * end.error * alpha) << i;
        }
    }
    EXPECT_GT(known, 0.95 * runs);
    EXPECT_GT(fell, 0.1 * runs);
    EXPECT_GT(rested, 0.1 * runs);
    EXPECT_GT(stood_after_impacts, 0.1 * runs);
}

TEST(RecordInLinearTheory, ErrorOfThousandsOfStepsStaysWithinItsBound)
{
    std::mt19937_64 generator(25);
    for (int i = 0; i < 100; ++i) {
        const RecordPoint point =
            refined(random_record_point(generator, 40, Directions::horizontal), 64);
        const auto end = run_record<Theory::linear, Directions::horizontal>(point, 1e-12);
        const LinearEnd exact = LinearReference(point).run();
        if (end.error < infinity) {
            // Each step rounds; if it always rounded in the same direction, errors would be up to
            // three times as large as their bounds.
            EXPECT_NEAR(margin_of<Theory::linear>(end, point.block), exact_margin(exact, point),
                        end.error)
                << i;
        }
    }
}

TEST(RecordInLinearTheory, PeakIsThatOfItsClosedForm)
{
    std::mt19937_64 generator(22);
    for (int i = 0; i < 400; ++i) {
        const RecordPoint point = random_record_point(generator, 40, Directions::horizontal);
        const auto end = run_record<Theory::linear, Directions::horizontal>(point, 1e-12);
        const double peak = peak_under_record<Theory::linear, Directions::horizontal>(point, 1e-12);
        const LinearEnd exact = LinearReference(point).run();
        // Errors grow: until the peak they are at most as large as at the end. A peak at a sample
        // of the motion instead of between samples would be off by 1e-3.
        EXPECT_NEAR(peak, double(exact.peak), (4 * end.error + 1e-11) * point.block.slenderness)
            << i;
    }
}

/// The margin under a record, and its error bound, in 50 digits.
template <class Method, class T>
std::array<Digits50, 2> margin_in(const RecordPoint& point, double tolerance)
{
    constexpr Theory theory = Theory::nonlinear;
    constexpr Outputs outputs{.impacts = true, .error = true, .peak = true};
    const Block<T> block = block_in<T>(point.block);
    const auto end = run_forced_stage<Method, theory, outputs>(
        block, record_excitation<theory>(point.record, block, T(point.scale), T(point.frequency)),
        T(tolerance));
    const auto exactly = [](const T& x) -> Digits50 {
        if constexpr (std::same_as<T, Digits31>) {
            return Digits50(x.high()) + x.low();
        } else {
            return x;
        }
    };
    return {exactly(margin_of<theory>(end, block)), exactly(end.error)};
}

TEST(RecordIn31Digits, HasTheMarginOf50DigitsWithinItsError)
{
    std::mt19937_64 generator(24);
    std::vector<double> errors;
    for (int i = 0; i < 40; ++i) {
        const RecordPoint point = random_record_point(
            generator, 25, i % 2 == 0 ? Directions::horizontal : Directions::both);
        const auto [exact, rest] = margin_in<Taylor<20>, Digits50>(point, 1e-36);
        const auto [margin, error] = margin_in<Taylor<20>, Digits31>(point, 1e-29);
        errors.push_back(double(error));
        if (errors.back() < infinity) {
            EXPECT_LE(double(abs(margin - exact)), double(error + rest)) << i;
        }
    }
    std::ranges::sort(errors);
    EXPECT_LT(errors[20], 1e-25); // as in 31 digits, after growing with exp(p t) and at impacts
    EXPECT_LT(errors[36], infinity);
}

/// A constant acceleration, horizontal a and upwards v, turns the direction of gravity:
///
///     y'' = G sin(y + phi),   G = sqrt((1 + v)^2 + a^2),   phi = atan2(side a, 1 + v)
///
/// linear theory: y'' = G (y + phi), G = 1 + v, phi = side a / G. This is free rocking of a block
/// of the slenderness alpha + phi, negative if the ground lifts the block, in the time
/// sqrt(G) tau. In 50 digits.
template <Theory theory>
class TurnedGravity {
public:
    TurnedGravity(const Block<double>& block, double a, double v)
        : alpha_(block.slenderness), restitution_(block.restitution), a_(a), down_(1 + Digits50(v))
    {
        const bool linear = theory == Theory::linear;
        root_ = sqrt(linear ? down_ : Digits50(sqrt(down_ * down_ + a_ * a_)));
    }

    struct End {
        State<Digits50> state;
        int impacts;
        Digits50 speed = 1; ///< of the impact [rad p]
    };

    /// The state a time tau after this one; at most one impact is followed.
    End after(const Digits50& tau, const State<Digits50>& begin) const
    {
        const Digits50 time = tau * root_;
        const State<Digits50> scaled{begin.tilt, begin.rate / root_, begin.side};
        const auto arc = arc_from(scaled);
        const Digits50 impact = arc.time_to_impact();
        if (!(impact < time)) {
            return {unscaled(arc.at(time)), 0};
        }
        const State<Digits50> upright{0, sqrt(restitution_) * arc.impact_speed(), -begin.side};
        const auto next = arc_from(upright);
        const bool again = next.time_to_impact() < time - impact;
        return {again ? upright : unscaled(next.at(time - impact)), again ? 2 : 1,
                arc.impact_speed() * root_};
    }

private:
    RockingArc<theory, Digits50> arc_from(const State<Digits50>& state) const
    {
        const Digits50 turned =
            alpha_ + (theory == Theory::linear ? Digits50(state.side * a_ / down_)
                                               : Digits50(atan2(state.side * a_, down_)));
        return RockingArc<theory, Digits50>(state, BlockSide{turned},
                                            conserved_q<theory>(state, BlockSide{turned}));
    }

    State<Digits50> unscaled(const State<Digits50>& state) const
    {
        return {state.tilt, state.rate * root_, state.side};
    }

    Digits50 alpha_, restitution_, a_, down_, root_;
};

/// The end state of a run of order 20, with its error: local errors of 1e-14 alpha in fewer than
/// 100 steps, which grow e-fold in 1 / (p sqrt(G)), at most e^6, and at an impact by its speed.
void expect_state(const State<double>& ours, const State<Digits50>& exact, double growth)
{
    const double tolerance = 1e-12 * growth;
    EXPECT_NEAR(ours.tilt, double(exact.tilt), tolerance);
    EXPECT_NEAR(ours.rate, double(exact.rate), tolerance);
    EXPECT_EQ(ours.side, double(exact.side));
}

template <Theory theory>
void expect_uplift_by_turned_gravity()
{
    std::mt19937_64 generator(23);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 100; ++i) {
        const double alpha = 0.08 + 0.37 * uniform(generator);
        const double v = -0.7 + 1.5 * uniform(generator);
        const double side = i % 2 == 0 ? 1 : -1;
        const double a = -side * (1 + v) * std::tan(alpha) * (1.01 + uniform(generator));
        const std::size_t samples = 2 + std::size_t(i % 5);
        const Block<double> block{alpha, 0.9};
        const RecordPoint point{
            accelerogram(std::vector<double>(samples, a), std::vector<double>(samples, v)), block,
            1, double(samples - 1) / (0.2 + 1.5 * uniform(generator))};
        const auto end = run_record<theory, Directions::both, 20>(point, 1e-14);
        const auto exact = TurnedGravity<theory>(block, a, v)
                               .after(Digits50(samples - 1) / point.frequency, {0, 0, side});
        if (exact.state.tilt < 1.5) {
            ASSERT_FALSE(end.fell);
            expect_state(end.state, exact.state, 1);
        }
    }
}

TEST(ConstantAcceleration, LiftsABlockIntoThePendulumOfTurnedGravity)
{
    expect_uplift_by_turned_gravity<Theory::nonlinear>();
    expect_uplift_by_turned_gravity<Theory::linear>();
}

template <Theory theory>
void expect_impact_by_turned_gravity()
{
    std::mt19937_64 generator(24);
    std::uniform_real_distribution<double> uniform(0, 1);
    int without = 0;
    int with_impact = 0;
    for (int i = 0; i < 1500; ++i) {
        // A block is lifted and then left to a constant acceleration.
        RecordPoint point = random_record_point(generator, 12, Directions::both);
        std::vector<double> horizontal = point.record.horizontal();
        std::vector<double> upwards = point.record.upwards();
        const double a = horizontal[6] / 4;
        const double v = upwards[6];
        std::fill(horizontal.begin() + 6, horizontal.end(), a);
        std::fill(upwards.begin() + 6, upwards.end(), v);
        RecordPoint before = point;
        before.record = accelerogram({horizontal.begin(), horizontal.begin() + 7},
                                     {upwards.begin(), upwards.begin() + 7});
        point.record = accelerogram(horizontal, upwards);
        point.frequency = before.frequency = 3 + 7 * uniform(generator);

        const auto start = run_record<theory, Directions::both, 20>(before, 1e-14);
        const auto end = run_record<theory, Directions::both, 20>(point, 1e-14);
        if (!(start.state.tilt > 0) || start.fell || end.fell) {
            continue;
        }
        const State<Digits50> begin{start.state.tilt, start.state.rate, start.state.side};
        const auto exact = TurnedGravity<theory>(point.block, point.scale * a, point.scale * v)
                               .after(5 / Digits50(point.frequency), begin);
        const double speed = double(exact.speed) / point.block.slenderness;
        if (exact.impacts > 1 || speed < 0.01) {
            continue;
        }
        ASSERT_EQ(end.impacts, start.impacts + exact.impacts);
        expect_state(end.state, exact.state, 1 / std::min(speed, 1.0));
        ++(exact.impacts == 0 ? without : with_impact);
    }
    EXPECT_GT(without, 100);
    EXPECT_GT(with_impact, 100);
}

TEST(ConstantAcceleration, CarriesABlockThroughAnImpactByTurnedGravity)
{
    expect_impact_by_turned_gravity<Theory::nonlinear>();
    expect_impact_by_turned_gravity<Theory::linear>();
}

} // namespace
} // namespace overturn
