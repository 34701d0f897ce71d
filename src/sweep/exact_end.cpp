#include "exact_end.hpp"

#include "for_scene.hpp"

#include "overturn/integrate/more_digits.hpp"

namespace overturn {

namespace {

template <class T, class Pulse, Theory theory>
ExactEnd end_of(const PlanePoint& point, const T& window)
{
    const T slenderness(point.slenderness);
    const Block<T> block{slenderness, T(point.restitution)};
    const Excitation<Pulse, T> excitation{
        .acceleration = T(point.amplitude) * uplift_acceleration<theory>(slenderness),
        .frequency = T(point.frequency),
        .uplifts = uplift_phases<Pulse>(T(point.amplitude), window),
        .begin = Pulse::begin(window),
        .end = Pulse::end(window)};
    const ForcedEnd<T> end = run_in_more_digits<T, Pulse, theory>(block, excitation);
    const T margin = end.fell ? margin_of_fall<theory>(end.state.rate, block)
                              : margin_after_pulse<theory>(end.state, block);
    const double error = double(end.error) + std::abs(double(margin)) * 0x1p-53; // it is rounded
    const bool in_doubt = !(error < std::abs(double(margin)));
    const Region fallen = end.state.side > 0 ? Region::F_plus : Region::F_minus;
    return {.tilt = double(end.state.tilt),
            .rate = double(end.state.rate),
            .side = double(end.state.side),
            .flags = std::uint8_t(
                (end.fell ? end_flag::fell : 0) | (end.rested ? end_flag::rested : 0) |
                (end.capped ? end_flag::capped : 0) | (end.not_finite ? end_flag::not_finite : 0) |
                (in_doubt ? end_flag::in_doubt : 0)),
            .impacts = double(end.impacts),
            .steps = double(end.steps),
            .phase = double(end.phase),
            .region = end.fell ? fallen : region_after_pulse<theory>(end.state, block),
            .margin = double(margin),
            .error = error};
}

} // namespace

template <class T>
ExactEnd exact_end(const Scene& scene, const PlanePoint& point)
{
    return for_scene(scene.pulse, scene.theory, [&]<class Pulse, Theory theory>() {
        return end_of<T, Pulse, theory>(point, T(scene.window));
    });
}

template ExactEnd exact_end<long double>(const Scene&, const PlanePoint&);
template ExactEnd exact_end<Digits50>(const Scene&, const PlanePoint&);

} // namespace overturn
