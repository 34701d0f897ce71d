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

/// Whether a gap may close and open again within a step h at whose ends it is open: it narrows and
/// widens, or its rate changes its sign twice. In the latter case the rates exceed the mean rate:
/// for a cubic, their sum is more than 3 times the mean rate. The lower limit used here allows for
/// the neglected terms.
template <class S>
bool may_dip(const S& width, const S& rate, const S& width_after, const S& rate_after, const S& h)
{
    const S sum = h * (rate + rate_after);
    const S excess = sum - S(2.75) * (width_after - width);
    return (rate < 0 && rate_after > 0) || (rate > 0 && rate_after > 0 && excess > 0) ||
           (rate < 0 && rate_after < 0 && excess < 0);
}

/// Position of the event within a step, 0 to 1, by the quintic that matches value, rate and
/// acceleration of the gap at both ends of a step h; more than 1 if it stays open. Also finds gaps
/// that close and open again within the step.
template <class S>
S guessed_event(const Gap<S>& before, const Gap<S>& after, const S& h)
{
    const bool dips = may_dip(before.width, before.rate, after.width, after.rate, h);
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
    const auto bend = [&](const S& s) {
        return 2 * c[2] + s * (6 * c[3] + s * (12 * c[4] + s * 20 * c[5]));
    };
    // Where the function changes its sign, accurate to 1/1024 of the step: at this distance from
    // the lowest point of a dip, the gap exceeds its minimum by 1e-6 of its second derivative.
    // rises: whether it changes from negative to positive.
    const auto root = [](const auto& function, S low, S high, bool rises) {
        while (high - low > S(1) / 1024) {
            const S middle = (low + high) / 2;
            ((function(middle) < 0) == rises ? low : high) = middle;
        }
        return high;
    };
    S low = 0, high = 1;
    if (dips) { // check whether the lowest point of the dip is below zero
        S first = 0, last = 1;
        if (b0 > 0) {
            first = root(bend, S(0), S(1), true); // the least rate
        } else if (b1 < 0) {
            last = root(bend, S(0), S(1), false); // the largest rate
        }
        const bool is_a_dip = (first == 0 || slope(first) < 0) && (last == 1 || slope(last) > 0);
        const S lowest = is_a_dip ? root(slope, first, last, true) : S(1);
        if (is_a_dip && value(lowest) < 0) {
            high = lowest;
        } else if (after.width >= 0) {
            return 2;
        }
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
    Outcome outcome; ///< impact or fall; piece_end if there is no event
    Moment<S> moment;
};

/// Finds the first event in the step from `before` to `after`. `step_to(h)` returns the state after
/// a step h from `before`. The time of the event is accurate to about `sharpness`, as a share of
/// the step.
template <class S, class StepTo>
StepEvent<S> event_in_step(const auto& rocking, const Moment<S>& before, const Moment<S>& after,
                           const S& sharpness, StepTo&& step_to)
{
    const S h = after.time - before.time;
    const S flat = pi<S>() / 2;
    const auto gap = [&](const Moment<S>& moment, bool fall) -> Gap<S> {
        const S acceleration = rocking.acceleration(moment.state[0], moment.time);
        return fall ? Gap<S>{flat - moment.state[0], -moment.state[1], -acceleration}
                    : Gap<S>{moment.state[0], moment.state[1], acceleration};
    };
    const bool fall = after.state[0] > flat;
    if (!fall && after.state[0] >= 0 &&
        !may_dip(before.state[0], before.state[1], after.state[0], after.state[1], h)) {
        return {Outcome::piece_end, after};
    }
    S share = guessed_event(gap(before, fall), gap(after, fall), h);
    if (share > 1) {
        return {Outcome::piece_end, after};
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
