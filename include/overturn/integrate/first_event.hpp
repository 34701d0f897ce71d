// The first impact or fall within a step, and the correction of a step that ends at one.
#pragma once

#include "overturn/integrate/first_root.hpp"
#include "overturn/integrate/power_series.hpp"
#include "overturn/integrate/stepper_types.hpp"
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
    const auto [tilt, rate, acceleration] = motion_at(series, share * h);
    return {tilt, rate * h, acceleration * h * h};
}

/// The zero of a gap near the end of a step.
template <Number T>
struct EventCorrection {
    T delay;        ///< time from the end of the step to the event; may be negative
    T closing;      ///< speed at which the gap closes at the event
    mask_t<T> hits; ///< false if the gap is open and its minimum is above zero
};

/// Newton's correction to second order, from the gap at the end of the step, its rate (negative if
/// it closes) and its acceleration:
///
///     gap + rate delay + acceleration delay^2 / 2 = 0,   closing^2 = rate^2 - 2 acceleration gap
template <Number T>
EventCorrection<T> event_correction(const StepMotion<T>& at_end)
{
    const auto& [gap, rate, acceleration] = at_end;
    const T square = fma(rate, rate, -(acceleration + acceleration) * gap);
    // With round-off, a closed gap may seem never to have been open; it then closes at its rate.
    const T closing = sqrt(select<T>(square > 0, square, rate * rate));
    const T denominator = closing - rate;
    const T delay = (gap + gap) / select<T>(denominator > 0, denominator, 1);
    return {select<T>(denominator > 0, delay, 0), closing, square >= 0 || gap <= 0};
}

/// The gap to the ground, or to pi/2 in the lanes in `falls`, of a block with this motion.
template <Number T>
StepMotion<T> gap_of(const StepMotion<T>& tilt, const mask_t<T>& falls)
{
    return {select<T>(falls, T(pi<scalar_t<T>>() / 2) - tilt.position, tilt.position),
            select<T>(falls, -tilt.rate, tilt.rate),
            select<T>(falls, -tilt.acceleration, tilt.acceleration)};
}

/// An event within a step.
template <Number T>
struct FirstEvent {
    T time; ///< the end of the step: at the event, or before an event that is not yet certain
    mask_t<T> strikes;
    mask_t<T> falls;
};

/// The motion at an event next to the end of a step.
template <Number T>
struct StepEvent {
    T time;  ///< of the end of the step
    T delay; ///< from there to the event; may be negative; 0 without an event
    T tilt;  ///< at time + delay: 0 at an impact, pi/2 at a fall [rad]
    T rate;
    mask_t<T> strikes;
    mask_t<T> falls;

    mask_t<T> happens() const { return strikes || falls; }
};

/// Corrects an event to the zero of the gap next to the end of the step, which has this motion.
template <Number T>
StepEvent<T> event_near(const FirstEvent<T>& event, const StepMotion<T>& end)
{
    const EventCorrection<T> found = event_correction(gap_of(end, event.falls));
    const mask_t<T> hits = (event.strikes || event.falls) && found.hits;
    const T tilt = select<T>(event.falls, pi<scalar_t<T>>() / 2, 0);
    const T rate = select<T>(event.falls, found.closing, -found.closing);
    return {event.time,
            select<T>(hits, found.delay, 0),
            select<T>(hits, tilt, end.position),
            select<T>(hits, rate, end.rate),
            event.strikes && found.hits,
            event.falls && found.hits};
}

/// Moves the end of a step to an event next to it, whose delay is in 1/p.
template <Number T>
void move_to(const StepEvent<T>& event, auto& end, const auto& excitation)
{
    const T delayed = end.phase + excitation.frequency * event.delay;
    end.phase = select<T>(event.happens(), lesser<T>(delayed, T(excitation.motion.end)), end.phase);
    end.tilt = event.tilt;
    end.rate = event.rate;
    end.strikes = event.strikes;
    end.falls = event.falls;
}

/// The lanes in which the block may strike the ground or reach pi/2 within the step.
/// tilt: encloses the tilt [rad]. noise: by how much round-off lowers a tilt of 0 [rad].
template <Number T>
mask_t<T> may_have_event(const Enclosure<T>& tilt, const T& noise)
{
    using S = scalar_t<T>;
    return lower_bound(tilt.lower()) < -noise ||
           T(pi<S>() / 2) - upper_bound(tilt.upper()) < -noise;
}

/// Where the bounds of a tilt first reach the ground or pi/2, in the lanes in `suspect`, see
/// may_have_event(); the time is the share of the step.
template <Number T>
FirstEvent<T> first_contact(const Enclosure<T>& tilt, const T& noise, const mask_t<T>& suspect)
{
    const auto first_fall = [&](const Quintic<T>& gap) -> T {
        const mask_t<T> may_close = suspect && lower_bound(gap) < -noise;
        return any<T>(may_close) ? first_fall_below_zero(gap, noise, may_close) : T(2);
    };
    const T ground = first_fall(tilt.lower());
    const T flat = first_fall(room_above(tilt.upper()));
    const T share = lesser<T>(flat, ground);
    const mask_t<T> within = suspect && share <= 1;
    return {share, within && !(flat < ground), within && flat < ground};
}

/// The first impact or fall within a step of length h. There is none before the first contact of
/// the bounds of the enclosure. From there on, a gap g that closes at the speed v with
/// |acceleration| <= M is certain to close, exactly once, if v^2 > 2 M g. The event is only
/// located if v^2 > 4 M g, so that its first approximation is close. Otherwise the step ends there,
/// and the next one has a tighter enclosure. Not inlined, because it is seldom called.
template <int order, Number T>
[[gnu::noinline]] FirstEvent<T> first_event(const RockingSeries<order, T>& series,
                                            const Enclosure<T>& bounds, const T& h, const T& noise,
                                            const mask_t<T>& suspect)
{
    return straight_line<T>([&]() -> FirstEvent<T> {
        using Mask = mask_t<T>;
        const FirstEvent<T> contact = first_contact(bounds, noise, suspect);
        const Mask near = contact.strikes || contact.falls;
        const T time = h * contact.time;

        const StepMotion<T> here = gap_of(motion_at(series, time), contact.falls);
        const T most = steepest(series.rate, h);
        const Mask stuck = contact.time < 0x1p-40;
        const Mask closes =
            here.rate <= 0 && (here.rate * here.rate > 4 * most * here.position || stuck);
        // Corrections of third order. Together with the one at the end of the step, three of them
        // are sufficient for doubles: an error of 0.2 of the time becomes less than 1e-18.
        T event_time = time + event_correction(here).delay;
        constexpr int more = std::numeric_limits<scalar_t<T>>::digits <= 53 ? 1 : 2;
        for (int i = 0; i < more; ++i) {
            const T somewhere = select<T>(near && closes, event_time, time); // within the step
            StepMotion<T> there = gap_of(motion_at(series, somewhere), contact.falls);
            there.acceleration = here.acceleration;
            event_time = event_time + event_correction(there).delay;
        }
        const Mask sure = near && closes && event_time <= h;
        const T end = select<T>(near, time, h);
        return {select<T>(sure, event_time, end), sure && contact.strikes, sure && contact.falls};
    });
}

} // namespace overturn
