#include "exact_end.hpp"

#include "overturn/integrate/more_digits.hpp"

namespace overturn {

namespace {

template <class T, Theory theory>
ExactEnd end_of(const GroundMotion<T>& motion, const PlanePoint& point)
{
    const Block<T> block{T(point.slenderness), T(point.restitution)};
    const ForcedEnd<T> end = run_in_more_digits<T, theory>(
        block,
        excitation_of<theory>(motion, block.slenderness, T(point.amplitude), T(point.frequency)));
    const double margin = double(margin_of<theory>(end, block));
    const double rounding = end.is_stopped() ? 0 : std::abs(margin) * 0x1p-53;
    const double error = double(end.error) + rounding;
    const bool in_doubt = !(error < std::abs(margin));
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
            .region = region_of<theory>(end, block),
            .margin = margin,
            .error = error};
}

} // namespace

template <class T>
ExactEnd exact_end(const Scene& scene, const PlanePoint& point)
{
    const GroundMotion<T> motion = ground_motion(scene.pulse, T(scene.window));
    return with_theory(scene.theory,
                       [&]<Theory theory>() { return end_of<T, theory>(motion, point); });
}

template ExactEnd exact_end<long double>(const Scene&, const PlanePoint&);
template ExactEnd exact_end<Digits50>(const Scene&, const PlanePoint&);

} // namespace overturn
