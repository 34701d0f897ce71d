#include "reference.hpp"

#include "for_scene.hpp"

#include "support/one_point.hpp"

namespace overturn {

namespace {

using T = Digits50;

/// Leaves 25 digits and more at the end of a pulse.
constexpr double tolerance = 1e-30;

Point<T> in_digits(const HardCase& point)
{
    return {T(point.slenderness), T(point.restitution), T(point.frequency), T(point.amplitude)};
}

template <class Pulse, Theory theory>
Truth end_of(const HardCase& point, const Excitation<Pulse, T>& excitation, int step_limit)
{
    const Block<T> block{T(point.slenderness), T(point.restitution)};
    const ForcedEnd<T> end =
        run_in_more_digits<T, Pulse, theory>(block, excitation, tolerance, step_limit);
    if (end.capped || end.not_finite) {
        return {.steps = double(end.steps)};
    }
    const State<T>& state = end.state;
    const T margin = margin_of<theory>(end, in_digits(point));
    const T arc = separatrix_rate<theory>(state.tilt, block.slenderness);
    const Region fallen = state.side > 0 ? Region::F_plus : Region::F_minus;
    return {.region = end.fell ? fallen : region_after_pulse<theory>(state, block),
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

template <class Pulse, Theory theory>
Truth end_of(const HardCase& point, int step_limit)
{
    const auto excitation = excitation_of<Pulse, theory>(in_digits(point), point.window);
    return end_of<Pulse, theory>(point, excitation, step_limit);
}

} // namespace

Truth truth_of(const HardCase& point, int step_limit)
{
    return for_scene(point.pulse, point.theory, [&]<class Pulse, Theory theory>() {
        return end_of<Pulse, theory>(point, step_limit);
    });
}

double angle_at_second_uplift_value(const HardCase& point)
{
    Excitation<OneSine, T> excitation = excitation_of<OneSine, Theory::nonlinear>(in_digits(point));
    excitation.end = pi<T>() + asin(1 / T(point.amplitude));
    return end_of<OneSine, Theory::nonlinear>(point, excitation, steps_of_a_second).angle;
}

} // namespace overturn
