// The forced stage: a block from rest through uplift, rocking, impacts and rest to the end of the
// pulse or its fall (Eq. 47). The free stage is never integrated.
// Lanes run in lockstep, each with its own step size; a lane that is done is frozen.
#pragma once

#include "overturn/integrate/crossing.hpp"
#include "overturn/integrate/landing.hpp"
#include "overturn/integrate/step.hpp"
#include "overturn/integrate/step_size.hpp"
#include "overturn/mechanics/block.hpp"
#include "overturn/mechanics/bounce_series.hpp"
#include "overturn/mechanics/excitation.hpp"

namespace overturn {

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

/// Trial steps after which a point is given up: half a million impacts, or a tolerance of 1e-14
/// over thousands of periods of 1/p. A block lifted by less than 1e-4 of the threshold makes more
/// impacts than that if it hardly loses energy (r within 1e-5 of 1), and stays undecided.
inline constexpr double most_steps = 1 << 20;

/// Integrates one block per lane. tolerance: largest local error per step of tilt and rate, over
/// the slenderness [1].
template <class Pulse, Theory theory, Records records, Number T>
class ForcedStage {
    using S = scalar_t<T>;
    using Mask = mask_t<T>;

public:
    ForcedStage(const Block<T>& block, const Excitation<Pulse, T>& excitation, const S& tolerance)
        : block_(block), excitation_(excitation), tolerance_(tolerance), end_(excitation.end),
          zero_(S(0)), phase_(excitation.begin), motion_{zero_, zero_, zero_}, landing_step_(zero_),
          towards_fall_(zero_), active_(zero_ == zero_), landing_(zero_ != zero_)
    {
        using std::sqrt;
        sqrt_restitution_ = sqrt(block.restitution);
        const T frequency = excitation.frequency;
        const T fastest = select<T>(frequency > T(S(1)), frequency, T(S(1)));
        first_step_ = step_error_power(T(tolerance)) / fastest;
        step_size_ = first_step_;
        const Mask none = landing_;
        end_of_run_ = {.state = {zero_, zero_, T(S(1))},
                       .fell = none,
                       .rested = none,
                       .capped = none,
                       .not_finite = none,
                       .impacts = zero_,
                       .steps = zero_};
    }

    ForcedEnd<T> run()
    {
        wait_for_uplift(active_);
        while (any<T>(active_)) {
            advance();
        }
        return end_of_run_;
    }

private:
    T& side() { return end_of_run_.state.side; }

    void restart(const Mask& lanes)
    {
        const T push = side() * excitation_.ground(phase_);
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
        const auto pushed_to_plus = excitation_.ground(phase_) < zero_;
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

    /// One trial step in every lane: accept or reject it, look for events in it, act on them.
    void advance()
    {
        const T left = (end_ - phase_) / excitation_.frequency;
        const Mask last = !landing_ && step_size_ >= left;
        const T h = select<T>(landing_, landing_step_, select<T>(last, left, step_size_));
        const T phase_step = h * excitation_.frequency;
        const auto acceleration = [&](const S& node, const T& tilt) {
            using std::fma;
            const T push = side() * excitation_.ground(fma(T(node), phase_step, phase_));
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
        const Landing<T> landing = land(gap, gap_rate, gap_acceleration);
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
        const Mask rests =
            impact && bounces_die_out<theory>(block_, excitation_, phase_, after.rate);
        end_of_run_.rested = end_of_run_.rested || rests;
        if (any<T>(rests)) {
            wait_for_uplift(rests);
        }
        restart(impact && active_);
    }

    const Block<T> block_;
    const Excitation<Pulse, T> excitation_;
    const S tolerance_;
    const T end_;
    const T zero_;
    T sqrt_restitution_;
    T first_step_;

    T phase_;          // of the pulse [rad]
    Motion<T> motion_; // tilt, its rate and acceleration
    T step_size_;      // the next step, unless it lands or ends the pulse [1/p]
    T landing_step_;   // the step that ends at an event found before [1/p]
    T towards_fall_;   // 1 if that event is the fall, 0 if it is an impact
    Mask active_;
    Mask landing_;
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
