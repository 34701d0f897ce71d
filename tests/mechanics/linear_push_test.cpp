// The series of the motion under a push that is linear in time, with and without vertical motion.
#include "overturn/mechanics/theory/theories.hpp"
#include "overturn/number/digits50.hpp"
#include "support/observed_order.hpp"

#include <gtest/gtest.h>

#include <random>

namespace overturn {
namespace {

/// A block in motion, at the centre of the expansion; ramps over the time of the expansion.
template <class T>
struct PushStart {
    T tilt;        // [rad]
    T rate;        // [rad per unit]
    T slenderness; // [rad]
    T unit;        // of time [1/p]
    Ground<Ramp<T>> ground;
};

/// Blocks from upright to overturned under pushes from both sides.
std::vector<PushStart<double>> push_starts(int count)
{
    std::mt19937_64 generator(17);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(generator);
    };
    std::vector<PushStart<double>> starts;
    for (int i = 0; i < count; ++i) {
        starts.push_back(
            {.tilt = between(0, 1.57),
             .rate = between(-1, 1),
             .slenderness = between(0.05, 0.5),
             .unit = between(0.03, 1),
             .ground = {{between(-2, 2), between(-2, 2)}, {between(0.1, 2), between(-1, 1)}}});
    }
    return starts;
}

PushStart<Digits50> in_digits(const PushStart<double>& start)
{
    const auto ramp = [](const Ramp<double>& r) { return Ramp<Digits50>{r.start, r.slope}; };
    return {start.tilt,
            start.rate,
            start.slenderness,
            start.unit,
            {ramp(start.ground.horizontal), ramp(start.ground.gravity)}};
}

template <Theory theory, int order, class T, class Push>
RockingSeries<order, T> series_under(const Push& push, const PushStart<T>& start)
{
    return Equations<theory>::template series<order>(BlockSide{start.slenderness}, start.tilt,
                                                     start.rate, push, start.unit);
}

template <class T, std::size_t tilts, class Series>
void expect_same(const std::array<T, tilts>& tilt, const Series& theirs)
{
    for (std::size_t k = 0; k < tilts; ++k) {
        ASSERT_EQ(tilt[k], theirs.tilt[k]) << k;
    }
}

template <class Choice>
class SeriesUnderALinearPush : public testing::Test {};
template <Theory choice>
using InTheory = std::integral_constant<Theory, choice>;
struct TheoryName {
    template <class Choice>
    static std::string GetName(int)
    {
        return Choice::value == Theory::linear ? "linear" : "nonlinear";
    }
};
using EveryTheory = testing::Types<InTheory<Theory::nonlinear>, InTheory<Theory::linear>>;
TYPED_TEST_SUITE(SeriesUnderALinearPush, EveryTheory, TheoryName);

TYPED_TEST(SeriesUnderALinearPush, IsThatOfAnyPushWithoutFurtherTerms)
{
    constexpr Theory theory = TypeParam::value;
    for (const PushStart<double>& start : push_starts(200)) {
        const Ramp<double>& push = start.ground.horizontal;
        const Coefficients<20, double> all{push.start, push.slope};
        // The terms that are omitted add exact zeros: no bit may change.
        expect_same(series_under<theory, 20>(push, start).tilt,
                    series_under<theory, 20>(all, start));
    }
}

TYPED_TEST(SeriesUnderALinearPush, IsUnchangedByAConstantGravityOfOne)
{
    constexpr Theory theory = TypeParam::value;
    for (const PushStart<double>& start : push_starts(200)) {
        const Ramp<double>& push = start.ground.horizontal;
        const Ground<Ramp<double>> with_gravity{push, {1, 0}};
        // Products by 1 and 0 are exact: no bit may change.
        expect_same(series_under<theory, 20>(push, start).tilt,
                    series_under<theory, 20>(with_gravity, start));
    }
}

/// The sum of c[k] t^k, and of its slope.
template <std::size_t count>
std::array<Digits50, 2> value_and_slope(const std::array<Digits50, count>& c, const Digits50& t)
{
    std::array<Digits50, 2> sum{0, 0};
    for (std::size_t k = count; k-- > 0;) {
        sum = {sum[0] * t + c[k], sum[1] * t + sum[0]};
    }
    return sum;
}

/// The residual of the series in the equation of motion of block.hpp, at t.
template <Theory theory, int order>
Digits50 residual(const PushStart<Digits50>& start, const Digits50& t)
{
    const auto series = series_under<theory, order>(start.ground, start);
    return value_and_slope(series.rate, t)[1] -
           start.unit * start.unit *
               Equations<theory>::acceleration(BlockSide{start.slenderness},
                                               value_and_slope(series.tilt, t)[0],
                                               start.ground.at(t));
}

TYPED_TEST(SeriesUnderALinearPush, SolvesTheEquationWithVerticalMotionToItsOrder)
{
    constexpr Theory theory = TypeParam::value;
    const PushStart<Digits50> start = in_digits(push_starts(1)[0]);
    const auto order = [&]<int n>() {
        return observed_order({32, 64, 128}, [&](int parts) -> Digits50 {
            return abs(residual<theory, n>(start, Digits50(1) / parts));
        });
    };
    // The residual begins with t^order; a wrong coefficient k leaves one of order k - 1. The next
    // term changes the observed slope a little.
    EXPECT_NEAR(order.template operator()<8>(), 8, 0.3);
    EXPECT_NEAR(order.template operator()<12>(), 12, 0.3);
}

TYPED_TEST(SeriesUnderALinearPush, SolvesTheEquationWithVerticalMotionToManyDigits)
{
    constexpr Theory theory = TypeParam::value;
    for (const PushStart<double>& start : push_starts(20)) {
        for (const double t : {-0x1p-8, 0x1p-9, 0x1p-8}) {
            // The residual of order 20 is below 2^-160 = 7e-49. A product missing from one of the
            // first 16 coefficients is visible.
            EXPECT_LT(abs(residual<theory, 20>(in_digits(start), t)), 1e-46);
        }
    }
}

TYPED_TEST(SeriesUnderALinearPush, RatesAreTheSlopesOfTilts)
{
    constexpr Theory theory = TypeParam::value;
    for (const PushStart<double>& start : push_starts(200)) {
        const auto series = series_under<theory, 14>(start.ground, start);
        for (std::size_t k = 0; k < series.rate.size(); ++k) {
            // A product by 1 / (k + 1), rounded twice.
            EXPECT_NEAR(double(k + 1) * series.tilt[k + 1] / series.rate[k], 1, 1e-15) << k;
        }
    }
}

} // namespace
} // namespace overturn
