// Common types of the two steppers: the state of a rocking block and the end of a step.
// A stepper integrates the motion on one side; ForcedStage handles impacts, rest and uplift.
#pragma once

#include "overturn/integrate/error_growth.hpp"
#include "overturn/integrate/records.hpp"

namespace overturn {

/// The state of a rocking block during the pulse.
template <Number T>
struct Rocking {
    T phase; ///< of the pulse [rad]
    T tilt;  ///< |theta| [rad]
    T rate;  ///< d|theta| / d tau [rad]
    T side;  ///< +1 or -1: the sign of theta
};

/// The end of a step: after the step size chosen by the stepper, or at the first event before that.
template <Number T>
struct StepEnd {
    T phase;           ///< exactly the end of the pulse if that is reached [rad]
    T tilt;            ///< 0 at an impact, pi/2 at a fall [rad]
    T rate;            ///< [rad]
    mask_t<T> moved;   ///< false if the step was rejected and must be repeated
    mask_t<T> strikes; ///< the block strikes the ground at the speed -rate
    mask_t<T> falls;   ///< the tilt has reached pi/2
    mask_t<T> broken;  ///< a number is not finite, and would not be with any other step
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

/// The motion at one point of a step, as a function of the share of the step.
template <Number T>
struct MotionSample {
    T tilt;         ///< [rad]
    T rate;         ///< [rad per step]
    T acceleration; ///< [rad per step^2]
};

/// The largest tilt within a step [rad]. most: an upper bound of it; sample_at(share) returns a
/// MotionSample. Newton's method starts from the highest of the samples that divide the step into
/// eight parts and finds the zero of the rate.
template <Number T, class SampleAt>
T highest_tilt(const T& start, const T& end, const T& most, const SampleAt& sample_at)
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
        const T tilt = sample_at(share).tilt;
        best = select<T>(tilt > highest, share, best);
        highest = greater<T>(tilt, highest);
    }
    const T part(S(1) / parts);
    const T first = greater<T>(best - part, zero);
    const T last = lesser<T>(best + part, one);
    T share = best;
    for (int i = 0; i < 3; ++i) {
        const MotionSample<T> here = sample_at(share);
        const mask_t<T> bends = here.acceleration < zero;
        const T newton = share - here.rate / select<T>(bends, here.acceleration, -one);
        share = lesser<T>(greater<T>(newton, first), last);
    }
    return greater<T>(sample_at(share).tilt, highest);
}

/// The motion at the start or at the end of a step, in any unit of time.
template <Number T>
struct StepPoint {
    T rate;
    T acceleration;
};

/// The tilt where the rate changes its sign within a step of length h, if it may be near the ground
/// or pi/2; otherwise a tilt nearer to the ground or to pi/2 than the turn, as a conservative
/// substitute [rad]. If the rate has the same sign at both ends, the block may have turned twice:
/// then this is the lower turn. lowest, highest: bounds of the tilt within the step [rad];
/// tilt_at_turn(lanes, share) finds it in these lanes, starting from an estimate of its share of
/// the step.
template <Number T, class Find>
T turning_tilt(const T& slenderness, const StepPoint<T>& start, const StepPoint<T>& end, const T& h,
               const T& lowest, const T& highest, const Find& tilt_at_turn)
{
    using S = scalar_t<T>;
    const T zero(S(0));
    const T one(S(1));
    const T near_ground = slenderness * T(S(1) / 16);
    const T near_flat(pi<S>() / 2 - S(1) / 16);
    const mask_t<T> inward = start.rate < zero;
    const mask_t<T> turns = start.rate * end.rate < zero;
    // A second turn, after the start of a step that begins inward or before the end of one that
    // ends outward, where an outward acceleration would stop the block.
    const T speed = select<T>(inward, -start.rate, end.rate);
    const T stop = select<T>(inward, start.acceleration, end.acceleration) * h;
    const mask_t<T> dips = start.rate * end.rate > zero && speed < stop;
    const mask_t<T> suspect =
        (turns && (lowest < near_ground || highest > near_flat)) || (dips && lowest < near_ground);
    const T nearer = select<T>(turns && inward, near_ground, near_flat);
    if (!any<T>(suspect)) {
        return nearer;
    }
    const T stopped = speed / select<T>(dips, stop, one);
    const T share = select<T>(turns, start.rate / select<T>(turns, start.rate - end.rate, one),
                              select<T>(inward, stopped, one - stopped));
    return select<T>(suspect, tilt_at_turn(suspect, share), nearer);
}

} // namespace overturn
