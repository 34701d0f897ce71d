// Finds an impact or a fall within a step: a first guess from the quintic through both ends of the
// step, refined with the state that the solver computes at the guess, either by a step from the
// same beginning or by its dense output.
#pragma once

#include "rocking_point.hpp"

#include <cmath>

namespace overturn::benchmarks {

/// A gap that closes at an event: the tilt for an impact, pi/2 - tilt for the fall.
template <class S>
struct Gap {
    S width, rate, acceleration;
};

/// Position of the event within a step, 0 to 1, by the quintic that matches value, rate and
/// acceleration of the gap at both ends of a step h; more than 1 if it stays open. Also finds gaps
/// that close and open again within the step.
template <class S>
S guessed_event(const Gap<S>& before, const Gap<S>& after, const S& h)
{
    const bool dips = before.rate < 0 && after.rate > 0;
    if (after.width >= 0 && !dips) {
        return 2;
    }
    const S b0 = h * before.rate, b1 = h * after.rate;
    const S a0 = h * h * before.acceleration, a1 = h * h * after.acceleration;
    const S d = after.width - before.width;
    const std::array<S, 6> c{before.width,
                             b0,
                             a0 / 2,
                             10 * d - 6 * b0 - 4 * b1 - (3 * a0 - a1) / 2,
                             -15 * d + 8 * b0 + 7 * b1 + (3 * a0 - 2 * a1) / 2,
                             6 * d - 3 * (b0 + b1) - (a0 - a1) / 2};
    const auto value = [&](const S& s) {
        return c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * (c[4] + s * c[5]))));
    };
    const auto slope = [&](const S& s) {
        return c[1] + s * (2 * c[2] + s * (3 * c[3] + s * (4 * c[4] + s * 5 * c[5])));
    };
    S low = 0, high = 1;
    if (after.width >= 0) { // check whether the lowest point of the dip is below zero
        // At 1/1024 of the step from the lowest point, the gap is higher by 1e-6 of its bend.
        while (high - low > S(1) / 1024) {
            const S middle = (low + high) / 2;
            (slope(middle) < 0 ? low : high) = middle;
        }
        if (value(high) >= 0) {
            return 2;
        }
        low = 0;
    }
    S s = high;
    for (int i = 0; i < 60 && high - low > std::numeric_limits<S>::epsilon(); ++i) {
        const S now = value(s);
        (now < 0 ? high : low) = s;
        const S newton = s - now / slope(s);
        const S next = newton > low && newton < high ? newton : (low + high) / 2;
        // The caller corrects the guess to second order.
        if (std::abs(next - s) < S(1) / 65536) {
            return next;
        }
        s = next;
    }
    return s;
}

template <class S>
struct StepEvent {
    Outcome outcome; ///< impact or fall; pulse_end if there is no event
    Moment<S> moment;
};

/// Finds the first event in the step from `before` to `after`. `step_to(h)` returns the state after
/// a step h from `before`. The time of the event is accurate to about `sharpness`, as a share of
/// the step.
template <class S, Sines sines, class StepTo>
StepEvent<S> event_in_step(const Rocking<S, sines>& rocking, const Moment<S>& before,
                           const Moment<S>& after, const S& sharpness, StepTo&& step_to)
{
    const S h = after.time - before.time;
    const S flat = pi<S>() / 2;
    const auto gap = [&](const Moment<S>& moment, bool fall) -> Gap<S> {
        const S acceleration = rocking.acceleration(moment.state[0], moment.time);
        return fall ? Gap<S>{flat - moment.state[0], -moment.state[1], -acceleration}
                    : Gap<S>{moment.state[0], moment.state[1], acceleration};
    };
    const bool fall = after.state[0] > flat;
    if (!fall && after.state[0] >= 0 && !(before.state[1] < 0 && after.state[1] > 0)) {
        return {Outcome::pulse_end, after};
    }
    S share = guessed_event(gap(before, fall), gap(after, fall), h);
    if (share > 1) {
        return {Outcome::pulse_end, after};
    }
    Moment<S> moment = before;
    for (int i = 0; i < 10; ++i) {
        moment = {before.time + share * h, step_to(share * h)};
        // gap + rate delay + acceleration delay^2 / 2 = 0, with an error of third order.
        const Gap<S> here = gap(moment, fall);
        const S square = here.rate * here.rate - 2 * here.acceleration * here.width;
        const S closing = square > 0 ? std::sqrt(square) : std::abs(here.rate);
        if (!(closing - here.rate > 0)) {
            break;
        }
        const S delay = 2 * here.width / (closing - here.rate);
        moment.time += delay;
        moment.state = {fall ? flat : S(0), fall ? closing : -closing};
        share += delay / h;
        const S missed = delay / h;
        if (std::abs(missed * missed * missed) < sharpness) {
            break;
        }
    }
    return {fall ? Outcome::fall : Outcome::impact, moment};
}

} // namespace overturn::benchmarks
