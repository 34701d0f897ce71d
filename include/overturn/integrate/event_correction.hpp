// The final correction of a step that ends at an event.
#pragma once

#include "overturn/integrate/rocking_step.hpp"
#include "overturn/mechanics/pulse_excitation.hpp"

namespace overturn {

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

/// Moves the end of a step to the event next to it: to the ground in the lanes in `strikes`, to
/// pi/2 in those in `falls`. acceleration: d^2|theta| / d tau^2 at the end of the step. Returns the
/// delay of the end, which may be negative [1/p].
template <Number T>
T move_to_event(StepEnd<T>& end, const mask_t<T>& strikes, const mask_t<T>& falls,
                const T& acceleration, const auto& excitation)
{
    const EventCorrection<T> correction =
        event_correction(gap_of<T>({end.tilt, end.rate, acceleration}, falls));
    end.strikes = strikes && correction.hits;
    end.falls = falls && correction.hits;
    const mask_t<T> hits = end.strikes || end.falls;
    const T last(excitation.motion.end);
    const T delayed = end.phase + excitation.frequency * correction.delay;
    end.phase = select<T>(hits, lesser<T>(delayed, last), end.phase);
    end.tilt = select<T>(hits, select<T>(falls, pi<scalar_t<T>>() / 2, 0), end.tilt);
    end.rate = select<T>(hits, select<T>(falls, correction.closing, -correction.closing), end.rate);
    return select<T>(hits, correction.delay, 0);
}

} // namespace overturn
