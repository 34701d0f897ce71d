// The two methods compared with each other and with 50 digits, at the most difficult points.
#include "support/one_point.hpp"
#include "support/random_point.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace overturn {
namespace {

constexpr double reference_tolerance = 1e-25;

template <class S>
Digits50 difference(const ForcedEnd<Digits50>& exact, const ForcedEnd<S>& end)
{
    const Digits50 angle = exact.state.side * exact.state.tilt - end.state.side * end.state.tilt;
    const Digits50 rate = exact.state.side * exact.state.rate - end.state.side * end.state.rate;
    return std::max(Digits50(abs(angle)), Digits50(abs(rate)));
}

/// The effect of a small relative change in the ground motion on the end state, over alpha.
template <Theory theory>
double sensitivity(PulseKind pulse, const PulsePoint<double>& point,
                   const ForcedEnd<Digits50>& exact)
{
    const Digits50 change = 1e-15;
    double sum = 0;
    for (const auto coordinate :
         {&PulsePoint<Digits50>::frequency, &PulsePoint<Digits50>::amplitude}) {
        PulsePoint<Digits50> beside = in_digits(point);
        beside.*coordinate *= 1 + change;
        const auto end = forced_end<theory>(pulse, beside, reference_tolerance);
        sum += double(difference(exact, end) / change) / point.slenderness;
    }
    return sum;
}

template <Theory theory, class Method>
void expect_what_the_tolerance_promises(PulseKind pulse, const PulsePoint<double>& point,
                                        const ForcedEnd<Digits50>& exact, double amplification,
                                        double tolerance)
{
    const auto end = forced_end<theory, Method>(pulse, point, tolerance);
    EXPECT_EQ(end.fell, exact.fell);
    EXPECT_EQ(end.impacts, double(exact.impacts));
    EXPECT_EQ(end.state.side, double(exact.state.side));
    // Each step may be off by the tolerance times alpha, and propagates it like any other small
    // change, plus a few rounding errors per step. A missed impact is off by alpha.
    const double per_step = tolerance + 4 * std::numeric_limits<double>::epsilon();
    EXPECT_LE(double(difference(exact, end)),
              per_step * end.steps * amplification * point.slenderness)
        << "tolerance " << tolerance << ", alpha " << point.slenderness << ", r "
        << point.restitution << ", Omega " << point.frequency << ", a " << point.amplitude;
}

TEST(Methods, AgreeWithFiftyDigitsWithinTheirTolerances)
{
    std::mt19937_64 generator(5);
    for_every_scene([&]<Theory theory>(PulseKind pulse) {
        for (int i = 0; i < 9; ++i) {
            const PulsePoint<double> point = random_point(generator);
            const auto exact = forced_end<theory>(pulse, in_digits(point), reference_tolerance);
            const double amplification = 1 + sensitivity<theory>(pulse, point, exact);
            const auto check = [&]<class Method>(std::initializer_list<double> tolerances) {
                for (const double tolerance : tolerances) {
                    expect_what_the_tolerance_promises<theory, Method>(pulse, point, exact,
                                                                       amplification, tolerance);
                }
            };
            check.template operator()<RungeKutta>({1e-6, 1e-9, 1e-12});
            check.template operator()<Taylor<14>>({1e-6, 1e-7});
            check.template operator()<Taylor<20>>({1e-9, 1e-12, 1e-14});
        }
    });
}

TEST(Methods, AgreeWithEachOtherInFiftyDigits)
{
    // Ensures that the reference above is not an error of one method.
    std::mt19937_64 generator(6);
    for_every_scene([&]<Theory theory>(PulseKind pulse) {
        const PulsePoint<double> point = random_point(generator);
        const auto exact = forced_end<theory>(pulse, in_digits(point), reference_tolerance);
        const auto other = run_forced_stage<RungeKutta, theory>(
            in_digits(point).block(), excitation_of<theory>(pulse, in_digits(point)), 1e-13);
        const double amplification = 1 + sensitivity<theory>(pulse, point, exact);
        EXPECT_EQ(exact.impacts, other.impacts);
        EXPECT_LE(double(difference(exact, other)),
                  1e-13 * double(other.steps) * amplification * point.slenderness);
    });
}

TEST(TaylorMethod, ErrorDecreasesWithTheTolerance)
{
    std::mt19937_64 generator(7);
    double log_ratio = 0;
    const int points = 100;
    for (int i = 0; i < points; ++i) {
        const PulsePoint<double> point = random_point(generator);
        const auto exact = forced_end<Theory::nonlinear>(PulseKind::one_sine, in_digits(point),
                                                         reference_tolerance);
        const auto error = [&](double tolerance) {
            const auto end =
                forced_end<Theory::nonlinear, Taylor<20>>(PulseKind::one_sine, point, tolerance);
            return double(difference(exact, end)) + 1e-16;
        };
        log_ratio += std::log10(error(1e-7) / error(1e-11)) / points;
    }
    // The truncation error begins with the term of order 21 and falls with this power of the step,
    // while the tolerance limits the k-th term, 17 <= k <= 20: four decades become 4 * 21 / k, 4.2
    // to 4.9, or more where several of these terms are small by chance. Without step control: none.
    EXPECT_NEAR(log_ratio, 4.6, 0.6);
}

/// A line of amplitudes along which the number of impacts changes between two neighbours.
struct PulseGraze {
    PulsePoint<double> point;
    double low, high; ///< amplitudes on both sides of the change, a relative 1e-13 apart
};

/// Finds changes of the number of impacts along random lines: a block that just touches the ground
/// during its motion, or strikes it just before the pulse ends.
template <Theory theory>
std::vector<PulseGraze> grazes(PulseKind pulse, std::mt19937_64& generator, std::size_t wanted)
{
    std::vector<PulseGraze> found;
    while (found.size() < wanted) {
        PulsePoint<double> point = random_point(generator);
        const auto impacts_at = [&](double amplitude) {
            point.amplitude = amplitude;
            const auto end = forced_end<theory, Taylor<20>>(pulse, point, 1e-13);
            return end.rested || end.fell ? -1 : end.impacts;
        };
        double low = 1.02;
        for (double high = low * 1.02; high < 15 && found.size() < wanted; high *= 1.02) {
            const double below = impacts_at(low);
            const double above = impacts_at(high);
            if (below >= 0 && above >= 0 && below != above) {
                double left = low;
                double right = high;
                while (right - left > 1e-13 * right) {
                    const double middle = (left + right) / 2;
                    (impacts_at(middle) == below ? left : right) = middle;
                }
                found.push_back({point, left, right});
            }
            low = high;
        }
    }
    return found;
}

template <Theory theory, class Method>
void expect_impacts_of_fifty_digits(PulseKind pulse, const PulsePoint<double>& point, double exact,
                                    double tolerance)
{
    EXPECT_EQ((forced_end<theory, Method>(pulse, point, tolerance).impacts), exact)
        << "Omega " << point.frequency << ", a " << point.amplitude << ", alpha "
        << point.slenderness << ", tolerance " << tolerance;
}

TEST(Methods, MissNoImpactNextToAGraze)
{
    std::mt19937_64 generator(11);
    for_every_scene([&]<Theory theory>(PulseKind pulse) {
        if (traits_of(pulse).half_turns == 1) {
            return; // a push to one side only: no block comes down before it ends
        }
        for (const PulseGraze& graze : grazes<theory>(pulse, generator, 4)) {
            for (const double offset : {1e-3, 1e-5, 1e-7}) {
                for (const double amplitude :
                     {graze.low * (1 - offset), graze.high * (1 + offset)}) {
                    PulsePoint<double> point = graze.point;
                    point.amplitude = amplitude;
                    const double exact =
                        double(forced_end<theory>(pulse, in_digits(point), 1e-20).impacts);
                    // The graze itself moves by the error of a run: far less than the offset.
                    expect_impacts_of_fifty_digits<theory, RungeKutta>(pulse, point, exact,
                                                                       1e-4 * offset);
                    expect_impacts_of_fifty_digits<theory, Taylor<14>>(pulse, point, exact,
                                                                       1e-4 * offset);
                    expect_impacts_of_fifty_digits<theory, Taylor<20>>(pulse, point, exact,
                                                                       1e-4 * offset);
                }
            }
        }
    });
}

} // namespace
} // namespace overturn
