// The forced stage: a block from rest through uplift, rocking, impacts and rest to the end of the
// pulse or its fall (Eq. 47). The free stage is never integrated.
// Lanes run in lockstep, each with its own step size; a lane that is done is frozen.
#pragma once

#include "overturn/integrate/crossing.hpp"
#include "overturn/integrate/step.hpp"
#include "overturn/integrate/step_size.hpp"
#include "overturn/mechanics/block.hpp"
#include "overturn/mechanics/pulse.hpp"

namespace overturn {

/// What shakes the ground under one block; dimensionless.
template <class Pulse, Number T>
struct Excitation {
    T acceleration;                      ///< a_p / g [1]
    T frequency;                         ///< Omega = omega_p / p [1]
    std::array<T, Pulse::lobes> uplifts; ///< from uplift_phases() [rad]
    scalar_t<T> begin;                   ///< phase at which the pulse begins and ends [rad]
    scalar_t<T> end;
};

/// What a run records beside the end state. Not asked for, not paid for.
struct Records {
    bool impacts = false;
};

/// The end of the forced stage. Counts are whole numbers held in T.
template <Number T>
struct ForcedEnd {
    State<T> state;       ///< at the end of the pulse, or where |theta| reached pi/2
    mask_t<T> fell;       ///< |theta| reached pi/2
    mask_t<T> rested;     ///< came to rest after a bounce series
    mask_t<T> capped;     ///< stopped after too many steps: the state means nothing
    mask_t<T> not_finite; ///< stopped at a number that is not finite: likewise
    T impacts;            ///< counted only if asked for; a bounce series that died out is not
    T steps;              ///< steps tried
};

/// Trial steps after which a point is given up: a tolerance of 1e-14 over thousands of periods of
/// 1/p takes some 1e5, a bounce series without loss (r = 1) at most as many impacts.
inline constexpr double most_steps = 1 << 20;

/// Integrates one block per lane. tolerance: largest local error per step of tilt and rate, over
/// the slenderness [1].
template <class Pulse, Theory theory, Records records, Number T>
class ForcedStage {
    using S = scalar_t<T>;
    using Mask = mask_t<T>;

public:
    ForcedStage(const Block<T>& block, const Excitation<Pulse, T>& excitation, const S& tolerance)
        : block_(block), excitation_(excitation), sqrt_restitution_(root(block.restitution)),
          end_(excitation.end), zero_(S(0)), tolerance_(tolerance)
    {
        const T frequency = excitation.frequency;
        const T fastest = select<T>(frequency > T(S(1)), frequency, T(S(1)));
        first_step_ = step_error_power(T(tolerance)) / fastest;
    }

    ForcedEnd<T> run()
    {
        phase_ = T(excitation_.begin);
        const Mask all_lanes = phase_ == phase_;
        const Mask none = all_lanes && !all_lanes;
        active_ = all_lanes;
        landing_ = none;
        end_of_run_ = {.state = {zero_, zero_, T(S(1))},
                       .fell = none,
                       .rested = none,
                       .capped = none,
                       .not_finite = none,
                       .impacts = zero_,
                       .steps = zero_};
        motion_ = {zero_, zero_, zero_};
        step_size_ = first_step_;
        landing_step_ = zero_;
        towards_fall_ = zero_;
        wait_for_uplift(all_lanes);
        while (any<T>(active_)) {
            advance();
        }
        return end_of_run_;
    }

private:
    static T root(const T& x)
    {
        using std::sqrt;
        return sqrt(x);
    }

    /// Acceleration of the ground over g [1].
    T ground(const T& phase) const { return excitation_.acceleration * Pulse::value(phase); }

    T& side() { return end_of_run_.state.side; }

    void restart(const Mask& lanes)
    {
        const T push = side() * ground(phase_);
        const T acceleration =
            rocking_acceleration<theory>(motion_.position, block_.slenderness, push);
        motion_.acceleration = select<T>(lanes, acceleration, motion_.acceleration);
    }

    /// Puts the lanes to rest until the ground lifts the block next; those that it lifts no more
    /// are done.
    void wait_for_uplift(const Mask& lanes)
    {
        const T never(std::numeric_limits<S>::infinity());
        T next = never;
        for (const T& uplift : excitation_.uplifts) {
            next = select<T>(uplift >= phase_ && uplift < next, uplift, next);
        }
        const Mask lifted = lanes && next < end_;
        motion_.position = select<T>(lanes, zero_, motion_.position);
        motion_.rate = select<T>(lanes, zero_, motion_.rate);
        phase_ = select<T>(lifted, next, phase_);
        const auto pushed_to_plus = ground(phase_) < zero_;
        side() = select<T>(lifted, select<T>(pushed_to_plus, T(S(1)), T(S(-1))), side());
        step_size_ = select<T>(lifted, first_step_, step_size_);
        finish(lanes && !lifted);
        restart(lifted);
    }

    /// Freezes the lanes with the state that they have.
    void finish(const Mask& lanes)
    {
        State<T>& state = end_of_run_.state;
        const T tilt = select<T>(motion_.position > zero_, motion_.position, zero_);
        state.tilt = select<T>(lanes, tilt, state.tilt);
        state.rate = select<T>(lanes, motion_.rate, state.rate);
        active_ = active_ && !lanes;
    }

    /// Whether the bounces that follow an impact at phase_, with the outward rate v, surely die
    /// out before the pulse ends and before the ground can lift the block.
    ///
    /// Let g(t) be the pull towards the ground on one side, sin(alpha) +- A cos(alpha), A = ground
    /// acceleration / g. Between two extrema of the pulse one side's pull rises and the other's
    /// falls. A flight under a falling pull ends no faster than it began, one under a rising pull
    /// faster by at most sqrt(g(end) / g(begin)); so after n impacts the speed is at most
    /// v r^(n/2) sqrt(rise(t) / rise(0)), and the flights, each 2 speed / g at most, last
    ///
    ///     2 v / (1 - sqrt r) max(1 / rise(0), sqrt(rise(D) / rise(0)) / fall(D))
    ///
    /// in all if that is at most D. D is 3 v / (1 - sqrt r) over the weaker pull: 1 1/2 times the
    /// sum under constant pulls. The pull changes with the tilt, too, which stays below v^2 / 2g:
    /// by less than a twentieth.
    Mask bounces_die_out(const T& rate) const
    {
        using std::abs;
        const T two(S(2));
        const auto pull = [&](const T& push) -> T {
            return -rocking_acceleration<theory>(zero_, block_.slenderness, push);
        };
        const T ground_now = ground(phase_);
        const T plus = pull(ground_now);
        const T minus = pull(-ground_now);
        const T weaker = select<T>(plus < minus, plus, minus);
        const T series = rate / (T(S(1)) - sqrt_restitution_); // v (1 + sqrt r + r + ...)
        const T duration = T(S(3)) * series / weaker;
        const T over = phase_ + duration * excitation_.frequency;
        Mask in_time = over <= end_;
        for (const Flank<S>& flank : Pulse::template flanks<S>()) {
            const T extremum(flank.peak);
            in_time = in_time && !(phase_ < extremum && extremum < over);
        }
        const T ground_then = ground(select<T>(in_time, over, phase_));
        const T plus_then = pull(ground_then);
        const T minus_then = pull(-ground_then);
        const Mask plus_rises = plus_then >= plus;
        const T rise = select<T>(plus_rises, plus, minus);
        const T rise_then = select<T>(plus_rises, plus_then, minus_then);
        const T fall_then = select<T>(plus_rises, minus_then, plus_then);
        const Mask short_enough =
            two * series <= duration * rise &&
            two * series * root(select<T>(rise > zero_, rise_then / rise, zero_)) <=
                duration * fall_then;
        const Mask low = T(S(10)) * rate * rate * (T(S(1)) + abs(ground_now)) <= weaker * weaker;
        return weaker > zero_ && ((in_time && short_enough && low) || rate == zero_);
    }

    /// Newton's correction, to second order, of a landing: where `gap` vanishes exactly.
    struct Landing {
        T delay;   ///< time from the end of the step to the event, either sign
        T closing; ///< speed there, towards it
        Mask hits; ///< not so if the gap is open and has its minimum above zero
    };
    static Landing land(const T& gap, const T& rate, const T& acceleration)
    {
        using std::fma;
        const T zero(S(0));
        const T square = fma(rate, rate, -(acceleration + acceleration) * gap);
        // Within round-off a closed gap may seem never to have been open: then it closes as it is.
        const T speed = root(select<T>(square > zero, square, rate * rate));
        const T denominator = speed - rate;
        const T delay = (gap + gap) / select<T>(denominator > zero, denominator, T(S(1)));
        return {select<T>(denominator > zero, delay, zero), speed, square >= zero || gap <= zero};
    }

    /// One trial step in every lane: accept or reject it, look for events in it, act on them.
    void advance()
    {
        const T left = (end_ - phase_) / excitation_.frequency;
        const Mask last = !landing_ && step_size_ >= left;
        const T h = select<T>(landing_, landing_step_, select<T>(last, left, step_size_));
        const T phase_step = h * excitation_.frequency;
        const auto acceleration = [&](const S& node, const T& tilt) {
            using std::fma;
            const T push = side() * ground(fma(T(node), phase_step, phase_));
            return rocking_acceleration<theory>(tilt, block_.slenderness, push);
        };
        const Step<T> step = runge_kutta_step(motion_, h, acceleration);
        const T error = relative_error(step, h);
        const Mask accepted = error <= T(S(1));
        count_step(step, h);

        const Mask looked_at = active_ && accepted && !landing_;
        const Mask event = looked_at && find_event(step, h, looked_at);
        const Mask moved = active_ && accepted && !event;
        motion_.position = select<T>(moved, step.end.position, motion_.position);
        motion_.rate = select<T>(moved, step.end.rate, motion_.rate);
        motion_.acceleration = select<T>(moved, step.end.acceleration, motion_.acceleration);
        phase_ = select<T>(moved, select<T>(last, end_, phase_ + phase_step), phase_);
        // A landing step says nothing of how long a step may be.
        const T resized = h * step_size_factor(error);
        const Mask resize = active_ && !event && !(landing_ && accepted);
        step_size_ = select<T>(resize && !(last && accepted), resized, step_size_);

        const Mask landed = moved && landing_;
        landing_ = event;
        if (any<T>(landed)) {
            act_on_event(landed);
        }
        const Mask over = active_ && moved && phase_ >= end_;
        if (any<T>(over)) {
            finish(over);
        }
    }

    /// Local error in units of what is allowed: the tolerance times the size of the motion, at
    /// most alpha, and round-off on top: of the motion, and of an acceleration of order alpha over
    /// the step. Were it alpha throughout, a block lifted by a millionth
    /// of alpha would come down 1e-6 beside its true speed at a tolerance of 1e-10, and a series of
    /// bounces would carry that on.
    T relative_error(const Step<T>& step, const T& h) const
    {
        using std::abs;
        using std::fma;
        const T& alpha = block_.slenderness;
        const T tilt = abs(step.end.position);
        const T rate = abs(step.end.rate);
        const T size = select<T>(tilt + rate < alpha, tilt + rate, alpha);
        const T round_off = T(16 * std::numeric_limits<S>::epsilon()) * fma(alpha, h, tilt + rate);
        const T allowed = fma(T(tolerance_), size, round_off);
        const T position_error = abs(step.position_error);
        const T rate_error = abs(step.rate_error);
        // Written so that an error that is not a number stays one.
        const T error = select<T>(position_error < rate_error, rate_error,
                                  position_error + (rate_error - rate_error));
        return error / allowed;
    }

    void count_step(const Step<T>& step, const T& h)
    {
        end_of_run_.steps = select<T>(active_, end_of_run_.steps + T(S(1)), end_of_run_.steps);
        const Mask too_many = active_ && end_of_run_.steps >= T(S(most_steps));
        const Mask finite = h * (step.end.position - step.end.position) == zero_;
        const Mask too_short = active_ && !finite && h < first_step_ * T(S(0x1p-60));
        if (any<T>(too_many || too_short)) {
            end_of_run_.capped = end_of_run_.capped || too_many;
            end_of_run_.not_finite = end_of_run_.not_finite || too_short;
            finish(too_many || too_short);
        }
    }

    /// Finds the first impact or fall within an accepted step, and sets the lanes that have one to
    /// land on it with their next step.
    Mask find_event(const Step<T>& step, const T& h, const Mask& lanes)
    {
        // A dip that the round-off of an acceleration of order alpha can make is none.
        const T noise = block_.slenderness * h * h * T(8 * std::numeric_limits<S>::epsilon());
        const Quintic<T> tilt = dense_output(motion_, step.end, h);
        Quintic<T> room = tilt; // up to pi/2
        for (T& c : room) {
            c = T(pi<S>() / 2) - c;
        }
        const T lowest =
            select<T>(lower_bound(tilt) < lower_bound(room), lower_bound(tilt), lower_bound(room));
        const Mask suspect = lanes && lowest < -noise;
        if (!any<T>(suspect)) {
            return suspect;
        }
        const T impact = first_fall_below_zero(tilt, noise, suspect);
        const T fall = first_fall_below_zero(room, noise, suspect);
        const T first = select<T>(fall < impact, fall, impact);
        const Mask event = suspect && first <= T(S(1));
        landing_step_ = select<T>(event, h * first, landing_step_);
        towards_fall_ = select<T>(event, select<T>(fall < impact, T(S(1)), zero_), towards_fall_);
        return event;
    }

    /// The lanes have landed: on the ground, or flat.
    void act_on_event(const Mask& lanes)
    {
        const Mask falls = towards_fall_ > zero_;
        const T gap = select<T>(falls, T(pi<S>() / 2) - motion_.position, motion_.position);
        const T gap_rate = select<T>(falls, -motion_.rate, motion_.rate);
        const T gap_acceleration = select<T>(falls, -motion_.acceleration, motion_.acceleration);
        const Landing landing = land(gap, gap_rate, gap_acceleration);
        const Mask hits = lanes && landing.hits;
        const T delayed = phase_ + excitation_.frequency * landing.delay;
        phase_ = select<T>(hits, select<T>(delayed < end_, delayed, end_), phase_);

        const Mask fell = hits && falls;
        motion_.position = select<T>(fell, T(pi<S>() / 2), motion_.position);
        motion_.rate = select<T>(fell, landing.closing, motion_.rate);
        end_of_run_.fell = end_of_run_.fell || fell;
        finish(fell);

        const Mask impact = hits && !falls;
        const State<T> after =
            state_after_impact<T>({zero_, -landing.closing, side()}, sqrt_restitution_);
        motion_.position = select<T>(impact, after.tilt, motion_.position);
        motion_.rate = select<T>(impact, after.rate, motion_.rate);
        side() = select<T>(impact, after.side, side());
        if constexpr (records.impacts) {
            T& impacts = end_of_run_.impacts;
            impacts = select<T>(impact, impacts + T(S(1)), impacts);
        }
        const Mask rests = impact && bounces_die_out(after.rate);
        end_of_run_.rested = end_of_run_.rested || rests;
        if (any<T>(rests)) {
            wait_for_uplift(rests);
        }
        restart(impact && active_);
    }

    Block<T> block_;
    Excitation<Pulse, T> excitation_;
    T sqrt_restitution_;
    T end_;
    T zero_;
    S tolerance_;
    T first_step_;

    T phase_;          // of the pulse [rad]
    Motion<T> motion_; // tilt, its rate and acceleration
    T step_size_;      // the next step, unless it lands or ends the pulse [1/p]
    T landing_step_;   // the step that ends at an event found before [1/p]
    T towards_fall_;   // 1 if that event is the fall, 0 if it is an impact
    Mask landing_;
    Mask active_;
    ForcedEnd<T> end_of_run_;
};

/// The forced stage of one block per lane; see ForcedStage.
template <class Pulse, Theory theory, Records records = Records{.impacts = true}, Number T>
ForcedEnd<T> run_forced_stage(const Block<T>& block, const Excitation<Pulse, T>& excitation,
                              const scalar_t<T>& tolerance)
{
    return ForcedStage<Pulse, theory, records, T>(block, excitation, tolerance).run();
}

} // namespace overturn
