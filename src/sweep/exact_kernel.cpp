// Compiled once per pulse: OVERTURN_PULSE and OVERTURN_KERNEL come from CMake.
#include "exact_kernel.hpp"

#include "overturn/integrate/forced_stage.hpp"
#include "overturn/number/digits50.hpp"

#include <limits>

namespace overturn {

namespace {

using T = Digits50;
using Pulse = OVERTURN_PULSE;

/// Leaves 25 digits and more at the end of a pulse, in the time of a hundred steps or so.
using Method = Taylor<30>;
constexpr double tolerance = 1e-30;

template <Theory theory>
ExactEnd end_of(const PlanePoint& point)
{
    const T slenderness(point.slenderness);
    const Block<T> block{slenderness, T(point.restitution)};
    const T window(point.window);
    const Excitation<Pulse, T> excitation{
        .acceleration = T(point.amplitude) * uplift_acceleration<theory>(slenderness),
        .frequency = T(point.frequency),
        .uplifts = uplift_phases<Pulse>(T(point.amplitude), window),
        .begin = Pulse::begin(window),
        .end = Pulse::end(window)};
    ForcedStage<Method, Pulse, theory, Records{.impacts = true, .error = true}, T> stage(
        block, excitation, T(tolerance));
    for (int steps = 0; stage.is_active() && steps < most_exact_steps; ++steps) {
        stage.advance();
    }
    const ForcedEnd<T>& end = stage.end();
    const bool capped = stage.is_active() || end.capped;
    const T margin = end.fell ? margin_of_fall<theory>(end.state.rate, block)
                              : margin_after_pulse<theory>(end.state, block);
    const Region fallen = end.state.side > 0 ? Region::F_plus : Region::F_minus;
    return {.tilt = double(end.state.tilt),
            .rate = double(end.state.rate),
            .side = double(end.state.side),
            .flags = std::uint8_t(
                (end.fell ? end_flag::fell : 0) | (end.rested ? end_flag::rested : 0) |
                (capped ? end_flag::capped : 0) | (end.not_finite ? end_flag::not_finite : 0)),
            .impacts = double(end.impacts),
            .steps = double(end.steps),
            .region = end.fell ? fallen : region_after_pulse<theory>(end.state, block),
            .margin = double(margin),
            .error = capped ? std::numeric_limits<double>::infinity() : double(end.error)};
}

} // namespace

ExactEnd OVERTURN_KERNEL(Theory theory, const PlanePoint& point)
{
    return theory == Theory::linear ? end_of<Theory::linear>(point)
                                    : end_of<Theory::nonlinear>(point);
}

} // namespace overturn
