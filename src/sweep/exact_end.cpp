#include "exact_end.hpp"

#include "for_scene.hpp"

#include "overturn/integrate/fifty_digits.hpp"

namespace overturn {

namespace {

using T = Digits50;

/// Leaves 25 digits and more at the end of a pulse, in the time of a hundred steps or so.
constexpr double tolerance = 1e-30;

template <class Pulse, Theory theory>
ExactEnd exact_end(const PlanePoint& point, const T& window)
{
    const T slenderness(point.slenderness);
    const Block<T> block{slenderness, T(point.restitution)};
    const Excitation<Pulse, T> excitation{
        .acceleration = T(point.amplitude) * uplift_acceleration<theory>(slenderness),
        .frequency = T(point.frequency),
        .uplifts = uplift_phases<Pulse>(T(point.amplitude), window),
        .begin = Pulse::begin(window),
        .end = Pulse::end(window)};
    const ForcedEnd<T> end = run_in_fifty_digits<Pulse, theory>(block, excitation, tolerance);
    const T margin = end.fell ? margin_of_fall<theory>(end.state.rate, block)
                              : margin_after_pulse<theory>(end.state, block);
    const Region fallen = end.state.side > 0 ? Region::F_plus : Region::F_minus;
    return {.tilt = double(end.state.tilt),
            .rate = double(end.state.rate),
            .side = double(end.state.side),
            .flags = std::uint8_t(
                (end.fell ? end_flag::fell : 0) | (end.rested ? end_flag::rested : 0) |
                (end.capped ? end_flag::capped : 0) | (end.not_finite ? end_flag::not_finite : 0)),
            .impacts = double(end.impacts),
            .steps = double(end.steps),
            .region = end.fell ? fallen : region_after_pulse<theory>(end.state, block),
            .margin = double(margin),
            .error = double(end.error)};
}

} // namespace

ExactEnd exact_end(const Scene& scene, const PlanePoint& point)
{
    return for_scene(scene.pulse, scene.theory, [&]<class Pulse, Theory theory>() {
        return exact_end<Pulse, theory>(point, T(scene.window));
    });
}

} // namespace overturn
