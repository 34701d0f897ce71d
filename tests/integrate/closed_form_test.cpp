// The forced stage compared with closed forms and with published numbers.
#include "support/every_method.hpp"
#include "support/one_point.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <gtest/gtest.h>

namespace overturn {
namespace {

template <class Method>
class ClosedForm : public testing::Test {};
TYPED_TEST_SUITE(ClosedForm, EveryMethod, MethodName);

const double digits = 1e-12; // tolerance of these runs

/// The uplift phase psi that solves `equation`, as an amplitude 1 / sin(psi).
template <class Equation>
double amplitude_of(const Equation& equation)
{
    std::uintmax_t iterations = 100;
    const auto bracket = boost::math::tools::toms748_solve(
        equation, 1e-3, pi<double>() / 2, boost::math::tools::eps_tolerance<double>(), iterations);
    return 1 / std::sin(bracket.first);
}

// The errors of these runs are about 1e-11 of the end state; the margin decreases with the
// amplitude with a slope of order 1. A formula with a wrong sign or a missing term is off in the
// first digits.
const double closed_form_error = 1e-10;

TYPED_TEST(ClosedForm, HalfSineLinearOverturnsFromTheAmplitudeOfMakrisAndRoussos)
{
    for (const double frequency : {0.5, 1.5, 3.0, 6.0}) {
        // Makris & Roussos (2000), eq. 27.
        const double exact = amplitude_of([&](double psi) {
            return frequency * std::sin(psi) - std::cos(psi) -
                   std::exp(-(pi<double>() - psi) / frequency);
        });
        const double ours = flip<Theory::linear, TypeParam>(
            PulseKind::half_sine, {0.2, 0.9, frequency, 0}, 1 + 1e-9, 2 * exact, digits);
        EXPECT_NEAR(ours / exact, 1, closed_form_error) << "frequency " << frequency;
    }
}

TYPED_TEST(ClosedForm, OneSineLinearOverturnsWithoutImpactFromTheAmplitudeOfZhangAndMakris)
{
    for (const double frequency : {3.0, 4.0, 5.0, 8.0}) {
        // Zhang & Makris (2001), eq. 47, sign corrected.
        const double exact = amplitude_of([&](double psi) {
            return frequency * std::sin(psi) - std::cos(psi) +
                   std::exp(-(2 * pi<double>() - psi) / frequency);
        });
        const double ours = flip<Theory::linear, TypeParam>(
            PulseKind::one_sine, {0.25, 0.81, frequency, 0}, 0.98 * exact, 1.02 * exact, digits);
        EXPECT_NEAR(ours / exact, 1, closed_form_error) << "frequency " << frequency;
    }
}

TYPED_TEST(ClosedForm, RectangularLinearOverturnsFromTheAmplitudeOfTheCorrectedHousnerProblem)
{
    for (const double frequency : {0.7, 2.0, 5.0}) {
        // p t1 = ln(A / (A - 1)), and the pulse lasts t1 = pi / (Omega p).
        const double exact = 1 / (1 - std::exp(-pi<double>() / frequency));
        const double ours = flip<Theory::linear, TypeParam>(
            PulseKind::rectangular, {0.2, 0.9, frequency, 0}, 1 + 1e-9, 3 * exact, digits);
        EXPECT_NEAR(ours / exact, 1, closed_form_error) << "frequency " << frequency;
    }
}

TYPED_TEST(ClosedForm, TriangularLinearOverturnsFromTheAmplitudeOfItsIntegral)
{
    for (const double frequency : {0.7, 2.0, 5.0}) {
        // Without impact a block overturns if the integral of A f exp(-(tau - tau0)) over tau >
        // tau0 exceeds alpha, where tau0 is the uplift. By pieces, with q = exp(-pi / (2 Omega)),
        // this is 1 - 2 q exp(tau0) + q^2 exp(tau0) > 0; the uplift is at the phase pi alpha / (2
        // A). A step across the kink would be off by the square of its length.
        const double q = std::exp(-pi<double>() / (2 * frequency));
        const double uplift = -frequency * std::log(q * (2 - q));
        const double exact = pi<double>() / (2 * uplift);
        const double ours = flip<Theory::linear, TypeParam>(
            PulseKind::triangular, {0.2, 0.9, frequency, 0}, 1 + 1e-9, 2 * exact, digits);
        EXPECT_NEAR(ours / exact, 1, closed_form_error) << "frequency " << frequency;
    }
}

TYPED_TEST(ClosedForm, RectangularLinearEndsInTheStateOfItsClosedForm)
{
    // y'' = y - A alpha from y = alpha: tilt = alpha (A - 1)(cosh tau - 1).
    const PulsePoint<double> point{0.2, 0.9, 2.5, 1.4};
    const auto end = forced_end<Theory::linear, TypeParam>(PulseKind::rectangular, point, digits);
    const double tau = pi<double>() / point.frequency;
    EXPECT_NEAR(end.state.tilt, 0.2 * 0.4 * (std::cosh(tau) - 1), 1e-11 * 0.2);
    EXPECT_NEAR(end.state.rate, 0.2 * 0.4 * std::sinh(tau), 1e-11 * 0.2);
    EXPECT_EQ(end.state.side, -1); // the ground accelerates to +, the block tips to -
    EXPECT_EQ(end.impacts, 0);
}

/// Half a unit of the last printed digit, and the error of the runs.
const double printed = 0.5e-6 + 1e-9;

TYPED_TEST(ClosedForm, OneSineLinearHasTheSafeStripOfZhangAndMakris)
{
    // p = 2.14, alpha = 0.25, velocity ratio 0.9, Omega = 5; printed there: 3.01, 6.32, 7.18.
    const PulsePoint<double> point{0.25, 0.81, 5, 0};
    EXPECT_NEAR((flip<Theory::linear, TypeParam>(PulseKind::one_sine, point, 2.9, 3.1, digits)),
                3.018600, printed);
    EXPECT_NEAR((flip<Theory::linear, TypeParam>(PulseKind::one_sine, point, 6.2, 6.5, digits)),
                6.318071, printed);
    EXPECT_NEAR((flip<Theory::linear, TypeParam>(PulseKind::one_sine, point, 7.0, 7.3, digits)),
                7.168129, printed);
}

TYPED_TEST(ClosedForm, OneSineNonlinearHasTheBoundariesOfThePapersBlock)
{
    const double alpha = papers_slenderness();
    const PulsePoint<double> point{alpha, largest_restitution(alpha), 3, 0};
    EXPECT_NEAR((flip<Theory::nonlinear, TypeParam>(PulseKind::one_sine, point, 1.3, 1.5, digits)),
                1.382896, printed);
    EXPECT_NEAR((flip<Theory::nonlinear, TypeParam>(PulseKind::one_sine, point, 3.5, 3.62, digits)),
                3.590936, printed);
    EXPECT_NEAR((flip<Theory::nonlinear, TypeParam>(PulseKind::one_sine, point, 3.62, 3.8, digits)),
                3.647522, printed);
}

TYPED_TEST(ClosedForm, OneSineNonlinearHasAWiderSafeStripWithLessRestitution)
{
    const double alpha = papers_slenderness();
    const PulsePoint<double> point{alpha, 0.7 * largest_restitution(alpha), 3, 0};
    EXPECT_NEAR((flip<Theory::nonlinear, TypeParam>(PulseKind::one_sine, point, 1.4, 1.5, digits)),
                1.458920, printed);
    EXPECT_NEAR((flip<Theory::nonlinear, TypeParam>(PulseKind::one_sine, point, 3.2, 3.4, digits)),
                3.276686, printed);
    EXPECT_NEAR((flip<Theory::nonlinear, TypeParam>(PulseKind::one_sine, point, 3.5, 3.8, digits)),
                3.647522, printed);
}

TYPED_TEST(ClosedForm, OneCosineNonlinearHasTheBoundariesOfThePapersBlock)
{
    const double alpha = papers_slenderness();
    const PulsePoint<double> point{alpha, largest_restitution(alpha), 3, 0};
    EXPECT_NEAR(
        (flip<Theory::nonlinear, TypeParam>(PulseKind::one_cosine, point, 1.7, 1.9, digits)),
        1.801257, printed);
    EXPECT_NEAR(
        (flip<Theory::nonlinear, TypeParam>(PulseKind::one_cosine, point, 6.7, 7.0, digits)),
        6.848654, printed);
    EXPECT_NEAR(
        (flip<Theory::nonlinear, TypeParam>(PulseKind::one_cosine, point, 11, 11.3, digits)),
        11.139644, printed);
}

} // namespace
} // namespace overturn
