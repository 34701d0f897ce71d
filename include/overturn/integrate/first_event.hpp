// The first impact or fall within a step of a Taylor series.
#pragma once

#include "overturn/integrate/event_correction.hpp"
#include "overturn/integrate/first_root.hpp"
#include "overturn/integrate/power_series.hpp"
#include "overturn/mechanics/rocking_series.hpp"

namespace overturn {

/// The motion at a time, both in units of the series.
template <int order, Number T>
StepMotion<T> motion_at(const RockingSeries<order, T>& series, const T& time)
{
    return {value_of_series(series.tilt, time), value_of_series(series.rate, time),
            slope_of_series(series.rate, time)};
}

/// The motion [per step] at a share of a step of length h.
template <int order, Number T>
StepMotion<T> motion_at(const RockingSeries<order, T>& series, const T& h, const T& share)
{
    const auto [tilt, rate, acceleration] = motion_at(series, T(share * h));
    return {tilt, rate * h, acceleration * h * h};
}

template <Number T>
struct FirstEvent {
    T time; ///< the end of the step: at the event, or before an event that is not yet certain
    mask_t<T> strikes;
    mask_t<T> falls;
};

/// The lanes in which the block may strike the ground or reach pi/2 within the step.
/// tilt: encloses the tilt [rad]. noise: by how much round-off lowers a tilt of 0 [rad].
template <Number T>
mask_t<T> may_meet(const Enclosure<T>& tilt, const T& noise)
{
    using S = scalar_t<T>;
    return lower_bound(tilt.lower()) < -noise ||
           T(pi<S>() / 2) - upper_bound(tilt.upper()) < -noise;
}

/// The first impact or fall within a step of length h. There is none before the first zero of the
/// bound of the enclosure. From there on, a gap g that closes at the speed v with
/// |acceleration| <= M is certain to close, exactly once, if v^2 > 2 M g. The event is only
/// located if v^2 > 4 M g, so that its first approximation is close. Otherwise the step ends there,
/// and the next one has a tighter enclosure.
template <int order, Number T>
FirstEvent<T> first_event(const RockingSeries<order, T>& series, const Enclosure<T>& bounds,
                          const T& h, const T& noise, const mask_t<T>& suspect)
{
    using Mask = mask_t<T>;
    const auto first_fall = [&](const Quintic<T>& gap) -> T {
        const Mask may_close = suspect && lower_bound(gap) < -noise;
        return any<T>(may_close) ? first_fall_below_zero(gap, noise, may_close) : T(2);
    };
    const T ground = first_fall(bounds.lower());
    const T flat = first_fall(room_above(bounds.upper()));
    const Mask falls = flat < ground;
    const T share = select<T>(falls, flat, ground);
    const Mask near = suspect && share <= 1;
    const T time = h * share;

    const StepMotion<T> here = gap_of(motion_at(series, time), falls);
    const T most = steepest(series.rate, h);
    const Mask stuck = share < 0x1p-40;
    const Mask closes =
        here.rate <= 0 && (here.rate * here.rate > 4 * most * here.position || stuck);
    // Corrections of third order. Together with the one at the end of the step, three of them
    // are sufficient for doubles: an error of 0.2 of the time becomes less than 1e-18.
    T event_time = time + event_correction(here).delay;
    constexpr int more = std::numeric_limits<scalar_t<T>>::digits <= 53 ? 1 : 2;
    for (int i = 0; i < more; ++i) {
        const T somewhere = select<T>(near && closes, event_time, time); // within the step
        StepMotion<T> there = gap_of(motion_at(series, somewhere), falls);
        there.acceleration = here.acceleration;
        event_time = event_time + event_correction(there).delay;
    }
    const Mask sure = near && closes && event_time <= h;
    const T end = select<T>(near, time, h);
    return {select<T>(sure, event_time, end), sure && !falls, sure && falls};
}

} // namespace overturn
