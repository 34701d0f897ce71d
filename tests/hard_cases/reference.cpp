#include "reference.hpp"

#include "support/one_point.hpp"

namespace overturn {

namespace {

using T = Digits50;

/// Gives at least 25 correct digits at the end of a pulse.
constexpr double tolerance = 1e-30;

PulsePoint<T> in_digits(const HardCase& point)
{
    return {T(point.slenderness), T(point.restitution), T(point.frequency), T(point.amplitude)};
}

template <Theory theory>
Truth end_of(const HardCase& point, const PulseExcitation<T>& excitation, int step_limit)
{
    const Block<T> block{T(point.slenderness), T(point.restitution)};
    const ForcedEnd<T> end =
        run_in_more_digits<T, theory>(block, excitation, nullptr, tolerance, step_limit);
    if (end.is_stopped()) {
        return {.steps = double(end.steps)};
    }
    const State<T>& state = end.state;
    const T margin = margin_of<theory>(end, block);
    const T arc = Equations<theory>::separatrix_rate(block, state.tilt);
    return {.region = region_of<theory>(end, block),
            .settled = end.error < abs(margin),
            .fell = end.fell,
            .rested = end.rested,
            .impacts = double(end.impacts),
            .steps = double(end.steps),
            .angle = double(state.side * state.tilt),
            .velocity = double(state.side * state.rate),
            .margin = double(margin),
            .below_top = double(block.slenderness - state.tilt),
            .within_arc = double(arc - abs(state.rate))};
}

} // namespace

Truth truth_of(const HardCase& point, int step_limit)
{
    return with_theory(point.theory, [&]<Theory theory>() {
        return end_of<theory>(
            point, excitation_of<theory>(point.pulse, in_digits(point), {.window = point.window}),
            step_limit);
    });
}

double angle_at_second_uplift_value(const HardCase& point)
{
    PulseExcitation<T> excitation =
        excitation_of<Theory::nonlinear>(PulseKind::one_sine, in_digits(point));
    excitation.motion = cut_at<T>(pi<T>() + asin(1 / T(point.amplitude)), excitation.motion);
    return end_of<Theory::nonlinear>(point, excitation, steps_of_a_second).angle;
}

} // namespace overturn
