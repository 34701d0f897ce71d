// The forced stage under sums of sines: closed forms of the linear theory.
#include "support/every_method.hpp"
#include "support/one_point.hpp"

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <gtest/gtest.h>

namespace overturn {
namespace {

template <class Method>
class UnderSines : public testing::Test {};
TYPED_TEST_SUITE(UnderSines, EveryMethod, MethodName);

const double tolerance_of_runs = 1e-12;

/// weight sin(speed phase + shift)
struct Sine {
    double weight, speed, shift;
};

/// A sum of sines that ends at a phase.
struct SumOfSines {
    std::vector<Sine> sines;
    double end;

    double at(double phase) const
    {
        double sum = 0;
        for (const Sine& sine : sines) {
            sum += sine.weight * std::sin(sine.speed * phase + sine.shift);
        }
        return sum;
    }
    /// The integral of f exp(-(tau - tau0)) over tau = phase / frequency, from tau0 to the end.
    double tail(double phase, double frequency) const
    {
        const double b = 1 / frequency;
        const auto integral = [&](double x) {
            double sum = 0;
            for (const auto& [weight, speed, shift] : sines) {
                const double angle = speed * x + shift;
                sum -= weight * (b * std::sin(angle) + speed * std::cos(angle)) /
                       (b * b + speed * speed);
            }
            return sum;
        };
        return b * (integral(end) * std::exp(-b * (end - phase)) - integral(phase));
    }
    /// Without impact, the block overturns if the tail from the uplift exceeds |f| there: the
    /// amplitude at which both are equal. The uplift is between `low` and `high`; the largest |f|
    /// is within 0.1 of `peak`.
    double critical_amplitude(double frequency, double low, double high, double peak) const
    {
        using namespace boost::math::tools;
        const auto depth = [&](double phase) { return -std::abs(at(phase)); };
        const double deepest =
            brent_find_minima(depth, peak - 0.1, peak + 0.1, std::numeric_limits<double>::digits)
                .second;
        std::uintmax_t iterations = 100;
        const auto bracket =
            toms748_solve([&](double phase) { return tail(phase, frequency) - at(phase); }, low,
                          high, eps_tolerance<double>(), iterations);
        return -deepest / std::abs(at(bracket.first));
    }
};

/// The amplitude within a percent of `exact` from which the block overturns without impact, over
/// `exact`. With impacts, it may overturn on either side of it.
template <class Method>
double found_over_exact(PulseKind pulse, const PulseShape& shape, double frequency, double exact)
{
    double low = 0.99 * exact;
    double high = 1.01 * exact;
    for (int i = 0; i < 60; ++i) {
        const PulsePoint<double> point{0.25, 0.81, frequency, (low + high) / 2};
        const auto end = forced_end<Theory::linear, Method>(pulse, point, tolerance_of_runs, shape);
        const Region region = region_of<Theory::linear>(end, point.block());
        const bool overturns = is_unsafe(region) && region != Region::U1_plus &&
                               region != Region::U1_minus && end.impacts == 0;
        (overturns ? high : low) = point.amplitude;
    }
    return low / exact;
}

// As in closed_form_test.cpp.
const double error_of_runs = 1e-10;

TYPED_TEST(UnderSines, TwoCyclesOverturnWithoutImpactFromTheAmplitudeOfTheirIntegral)
{
    const SumOfSines sine{{{1, 1, 0}}, 4 * pi<double>()};
    for (const double frequency : {3.0, 4.0, 5.0, 8.0}) {
        const double exact = sine.critical_amplitude(frequency, 1e-3, 1.5, 1.57);
        EXPECT_NEAR(found_over_exact<TypeParam>(PulseKind::sine, {.cycles = 2}, frequency, exact),
                    1, error_of_runs)
            << "frequency " << frequency;
    }
}

TYPED_TEST(UnderSines, MavroeidisPapageorgiouOverturnsFromTheAmplitudeOfItsIntegral)
{
    struct Case {
        double gamma, nu, frequency, low, high, peak;
    };
    for (const auto& [gamma, nu, frequency, low, high, peak] :
         {Case{1.5, 0.5, 1, -2.7, -1.51, 0.784}, Case{1.5, 0.5, 2, -2.7, -1.51, 0.784},
          Case{2, 0, 1, -3, -1.29, -1.281}, Case{3, 1.2, 1, -4, -2.5, 0.335}}) {
        // The derivative of (1 + cos(phase / gamma)) cos(phase + nu) / 2.
        const double q = 1 / gamma;
        const SumOfSines pulse{
            {{-0.5, 1, nu}, {-(1 + q) / 4, 1 + q, nu}, {-(1 - q) / 4, 1 - q, nu}},
            gamma * pi<double>()};
        const double exact = pulse.critical_amplitude(frequency, low, high, peak);
        EXPECT_NEAR(found_over_exact<TypeParam>(PulseKind::mavroeidis_papageorgiou,
                                                {.gamma = gamma, .nu = nu}, frequency, exact),
                    1, error_of_runs)
            << "gamma " << gamma << ", frequency " << frequency;
    }
}

TYPED_TEST(UnderSines, OneCycleIsTheOneSine)
{
    for (const double amplitude : {1.2, 2.0, 3.0, 3.6, 5.0, 9.0}) {
        const PulsePoint<double> point{0.17, 0.9, 3, amplitude};
        const auto one = forced_end<Theory::nonlinear, TypeParam>(PulseKind::one_sine, point, 1e-9);
        const auto cycles =
            forced_end<Theory::nonlinear, TypeParam>(PulseKind::sine, point, 1e-9, {.cycles = 1});
        // Only the uplift phase, which is found by a search, may be off by some units in the last
        // place; the motion amplifies this by up to exp(2 pi / 3) and more at impacts.
        EXPECT_NEAR(one.state.tilt, cycles.state.tilt, 1e-12) << amplitude;
        EXPECT_NEAR(one.state.rate, cycles.state.rate, 1e-12) << amplitude;
        EXPECT_EQ(one.impacts, cycles.impacts);
    }
}

} // namespace
} // namespace overturn
