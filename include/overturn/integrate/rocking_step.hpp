// What the two steppers share: where a rocking block is, and where a step has brought it.
// A stepper follows the motion on one side; impacts, rest and uplift are the forced stage's.
#pragma once

#include "overturn/integrate/error_growth.hpp"
#include "overturn/integrate/records.hpp"

namespace overturn {

/// A block on its way through the pulse.
template <Number T>
struct Rocking {
    T phase; ///< of the pulse [rad]
    T tilt;  ///< |theta| [rad]
    T rate;  ///< d|theta| / d tau [rad]
    T side;  ///< +1 or -1: the sign of theta
};

/// The end of a step: after as long as the stepper dared, or at the first event on the way.
template <Number T>
struct StepEnd {
    T phase;           ///< exactly the pulse's last one where it is reached [rad]
    T tilt;            ///< 0 where it strikes, pi/2 where it falls [rad]
    T rate;            ///< [rad]
    mask_t<T> moved;   ///< elsewhere the step was given up, and is tried again
    mask_t<T> strikes; ///< the ground, with -rate
    mask_t<T> falls;   ///< tilt has reached pi/2
    mask_t<T> broken;  ///< a number is not finite, and no other step would be
};

/// A step whose errors are recorded.
template <Number T>
struct StepEndWithErrors : StepEnd<T> {
    StepErrors<T> errors;
};

/// A step whose peak is recorded.
template <Number T>
struct StepEndWithPeak : StepEnd<T> {
    T peak; ///< the largest tilt within the step [rad]
};

/// The motion at one point of a step, by its share of the step.
template <Number T>
struct MotionSample {
    T tilt;         ///< [rad]
    T rate;         ///< [rad per step]
    T acceleration; ///< [rad per step^2]
};

/// The largest tilt within a step [rad]. most: a bound of it; look(share) is a MotionSample. Of
/// eight parts of the step that are looked at, Newton's method goes on from the highest to where
/// the rate is zero.
template <Number T, class Look>
T highest_tilt(const T& start, const T& end, const T& most, const Look& look)
{
    using S = scalar_t<T>;
    const T zero(S(0));
    const T one(S(1));
    T highest = greater<T>(start, end);
    if (!any<T>(most > highest)) {
        return highest;
    }
    T best = select<T>(start > end, zero, one);
    constexpr int parts = 8;
    for (int i = 1; i < parts; ++i) {
        const T share(S(i) / parts);
        const T tilt = look(share).tilt;
        best = select<T>(tilt > highest, share, best);
        highest = greater<T>(tilt, highest);
    }
    const T part(S(1) / parts);
    const T first = greater<T>(best - part, zero);
    const T last = lesser<T>(best + part, one);
    T share = best;
    for (int i = 0; i < 3; ++i) {
        const MotionSample<T> here = look(share);
        const mask_t<T> bends = here.acceleration < zero;
        const T newton = share - here.rate / select<T>(bends, here.acceleration, -one);
        share = lesser<T>(greater<T>(newton, first), last);
    }
    return greater<T>(look(share).tilt, highest);
}

/// Where the rate changes its sign within a step: the tilt there, if the ground or pi/2 may be
/// near, and otherwise one that is nearer. lowest, highest: bounds of the tilt within the step
/// [rad]; tilt_at_turn(lanes) finds it in the lanes in which there is a turn.
template <Number T, class Find>
T turning_tilt(const T& slenderness, const T& start_rate, const T& end_rate, const T& lowest,
               const T& highest, const Find& tilt_at_turn)
{
    using S = scalar_t<T>;
    const T zero(S(0));
    const T near_ground = slenderness * T(S(1) / 16);
    const T near_flat(pi<S>() / 2 - S(1) / 16);
    const mask_t<T> turns = start_rate * end_rate < zero;
    const mask_t<T> suspect = turns && (lowest < near_ground || highest > near_flat);
    const T nearer = select<T>(start_rate < zero, near_ground, near_flat);
    return any<T>(suspect) ? select<T>(suspect, tilt_at_turn(turns), nearer) : nearer;
}

} // namespace overturn
