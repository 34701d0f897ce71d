// Common types of the steppers, each of which integrates the motion on one side; ForcedStage
// handles impacts, rest and uplift. set_side(): the blocks rock on other sides, of which these are
// the properties. lift(), turn(): a block was lifted, or continues about its other corner. step():
// one trial step in every lane; the results of inactive lanes are meaningless. so_far: the
// StepExtremes of previous steps, if they are outputs; observe(end, lanes, step): called with the
// step for the contact, see ObservedStep, if the contact is an output.
#pragma once

#include "overturn/integrate/error_growth.hpp"
#include "overturn/integrate/outputs.hpp"
#include "overturn/integrate/runge_kutta_step.hpp"

#include <limits>
#include <type_traits>

namespace overturn {

/// The state of a rocking block during the pulse.
template <Number T>
struct Rocking {
    T phase; ///< of the pulse [rad]; of a record [samples]
    T tilt;  ///< |theta| [rad]
    T rate;  ///< d|theta| / d tau [rad]
    T side;  ///< +1 or -1: the sign of theta
};

template <class Part>
struct Without {
    Without() = default;
    explicit Without(const auto&) {}
};
/// A part that exists only if it is wanted.
template <bool wanted, class Part>
using OnlyIf = std::conditional_t<wanted, Part, Without<Part>>;

/// The extremes of the tilt within a step [rad].
template <Number T>
struct StepExtremes {
    T peak;        ///< the largest tilt
    T lowest_turn; ///< the tilt at which the block turns outward without an impact; infinite if
                   ///< it does not turn
};

/// The end of a step: after the step size chosen by the stepper, or at the first event before that.
template <Number T, Outputs outputs = Outputs{}>
struct StepEnd {
    T phase;           ///< exactly the end of the motion if that is reached [rad or samples]
    T tilt;            ///< 0 at an impact, pi/2 at a fall [rad]
    T rate;            ///< [rad]
    mask_t<T> moved;   ///< false if the step was rejected and must be repeated
    mask_t<T> strikes; ///< the block strikes the ground at the speed -rate
    mask_t<T> falls;   ///< the tilt has reached pi/2
    mask_t<T> broken;  ///< a number is not finite, and would not be with any other step

    [[no_unique_address]] OnlyIf<outputs.error, StepErrors<T>> errors;
    [[no_unique_address]] OnlyIf<outputs.peak, StepExtremes<T>> extremes;
};

/// The largest tilt within a step, or a smaller one if it is not above `so_far` [rad]. most: an
/// upper bound of it; motion_at(share) returns a StepMotion [per step]. Newton's method starts from
/// the highest of the samples that divide the step into eight parts and finds the zero of the rate.
template <Number T, class MotionAt>
T highest_tilt(const T& start, const T& end, const T& most, const T& so_far,
               const MotionAt& motion_at)
{
    using S = scalar_t<T>;
    T highest = greater<T>(start, end);
    if (!any<T>(most > highest && most > so_far)) {
        return highest;
    }
    T best = select<T>(start > end, 0, 1);
    constexpr int parts = 8;
    for (int i = 1; i < parts; ++i) {
        const T share(S(i) / parts);
        const T tilt = motion_at(share).position;
        best = select<T>(tilt > highest, share, best);
        highest = greater<T>(tilt, highest);
    }
    const T part(S(1) / parts);
    const T first = greater<T>(best - part, 0);
    const T last = lesser<T>(best + part, 1);
    T share = best;
    for (int i = 0; i < 3; ++i) {
        const StepMotion<T> here = motion_at(share);
        const mask_t<T> bends = here.acceleration < 0;
        const T newton = share - here.rate / select<T>(bends, here.acceleration, -1);
        share = lesser<T>(greater<T>(newton, first), last);
    }
    return greater<T>(motion_at(share).position, highest);
}

/// Where the rate may change its sign within a step of length h.
template <Number T>
struct TurnsInStep {
    using S = scalar_t<T>;

    TurnsInStep(const StepMotion<T>& start, const StepMotion<T>& end, const T& h)
        : start_rate(start.rate), end_rate(end.rate), inward(start.rate < 0),
          once(start.rate * end.rate < 0), speed(select<T>(inward, -start.rate, end.rate)),
          stop(select<T>(inward, start.acceleration, end.acceleration) * h),
          twice(start.rate * end.rate > 0 && speed < stop)
    {}

    /// An estimate of the share of the step at which the rate changes its sign; if it does so
    /// twice, at the lower turn.
    T share() const
    {
        const T stopped = speed / select<T>(twice, stop, 1);
        return select<T>(once, start_rate / select<T>(once, start_rate - end_rate, 1),
                         select<T>(inward, stopped, 1 - stopped));
    }

    T start_rate;
    T end_rate;
    mask_t<T> inward; ///< at the start
    mask_t<T> once;
    T speed;
    T stop; ///< the change of the rate over the step by the acceleration below
    /// The rate has the same sign at both ends but may change it twice in between: the acceleration
    /// at the start (inward) or at the end (outward) would change the rate by more than its size
    /// within the step.
    mask_t<T> twice;
};

/// The tilt at which the block turns outward within a step; infinite if it does not, or above
/// `so_far` [rad]. turns: per step; least: a lower bound of the tilt. See highest_tilt().
template <Number T, class MotionAt>
T lowest_turn(const TurnsInStep<T>& turns, const T& least, const T& so_far, const mask_t<T>& lanes,
              const MotionAt& motion_at)
{
    const T none(std::numeric_limits<scalar_t<T>>::infinity());
    const mask_t<T> suspect =
        lanes && ((turns.once && turns.inward) || turns.twice) && least < so_far;
    if (!any<T>(suspect)) {
        return none;
    }
    T share = select<T>(suspect, turns.share(), 0);
    StepMotion<T> here = motion_at(share);
    for (int i = 0; i < 4; ++i) { // Newton's method: the last digits of the tilt are correct
        const mask_t<T> bends = here.acceleration > 0;
        const T newton = share - here.rate / select<T>(bends, here.acceleration, 1);
        share = lesser<T>(greater<T>(newton, 0), 1);
        here = motion_at(share);
    }
    // If the block does not turn twice, there is no zero to be found.
    const mask_t<T> found = turns.once || abs(here.rate) < turns.speed * 0x1p-10;
    return select<T>(suspect && found && here.acceleration > 0, here.position, none);
}

/// The tilt where the rate changes its sign within a step, if it may be near the ground
/// or pi/2; otherwise a tilt nearer to the ground or to pi/2 than the turn, as a conservative
/// substitute [rad]. If the rate has the same sign at both ends, the block may have turned twice:
/// then this is the lower turn. lowest, highest: bounds of the tilt within the step [rad];
/// tilt_at_turn(lanes, share) finds it in these lanes, starting from an estimate of its share of
/// the step.
template <Number T, class Find>
T turning_tilt(const T& slenderness, const TurnsInStep<T>& turns, const T& lowest, const T& highest,
               const Find& tilt_at_turn)
{
    using S = scalar_t<T>;
    const T near_ground = slenderness * T(S(1) / 16);
    const T near_flat(pi<S>() / 2 - S(1) / 16);
    const mask_t<T> suspect = (turns.once && (lowest < near_ground || highest > near_flat)) ||
                              (turns.twice && lowest < near_ground);
    T nearer = select<T>(turns.once && turns.inward, near_ground, near_flat);
    if (!any<T>(suspect)) {
        return nearer;
    }
    return select<T>(suspect, tilt_at_turn(suspect, turns.share()), nearer);
}

} // namespace overturn
