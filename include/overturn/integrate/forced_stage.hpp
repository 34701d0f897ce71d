// The forced stage: a block from rest through uplift, rocking, impacts and rest to the end of the
// pulse or its fall (Eq. 47). The free stage is never integrated.
// Lanes run in lockstep, each with its own step size; a lane that is done is frozen.
#pragma once

#include "overturn/integrate/runge_kutta_stepper.hpp"
#include "overturn/integrate/taylor_stepper.hpp"
#include "overturn/mechanics/bounce_series.hpp"

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

/// Integrates one block per lane. Method: RungeKutta or Taylor<order>.
template <class Method, class Pulse, Theory theory, Records records, Number T>
class ForcedStage {
    using S = scalar_t<T>;
    using Mask = mask_t<T>;

public:
    ForcedStage(const Block<T>& block, const Excitation<Pulse, T>& excitation, const S& tolerance)
        : block_(block), excitation_(excitation), end_(excitation.end), zero_(S(0)),
          stepper_(block, excitation, tolerance), now_{T(excitation.begin), zero_, zero_, T(S(1))},
          active_(zero_ == zero_)
    {
        using std::sqrt;
        sqrt_restitution_ = sqrt(block.restitution);
        const Mask none = !active_;
        end_of_run_ = {.state = {zero_, zero_, T(S(1))},
                       .fell = none,
                       .rested = none,
                       .capped = none,
                       .not_finite = none,
                       .impacts = zero_,
                       .steps = zero_};
        wait_for_uplift(active_);
    }

    /// Whether a lane has still to go on.
    bool is_active() const { return any<T>(active_); }

    /// One step in every lane that is active; acts on the event at its end.
    void advance()
    {
        const StepEnd<T> step = straight_line<T>([&] { return stepper_.step(now_, active_); });
        count_step(step.broken);
        const Mask moved = active_ && step.moved;
        now_.phase = select<T>(moved, step.phase, now_.phase);
        now_.tilt = select<T>(moved, step.tilt, now_.tilt);
        now_.rate = select<T>(moved, step.rate, now_.rate);
        const Mask fell = moved && step.falls;
        const Mask strikes = moved && step.strikes;
        if (any<T>(fell || strikes)) {
            end_of_run_.fell = end_of_run_.fell || fell;
            finish(fell);
            strike(strikes);
        }
        const Mask over = active_ && moved && now_.phase >= end_;
        if (any<T>(over)) {
            finish(over);
        }
    }

    /// Where the lanes have ended, once none is active.
    const ForcedEnd<T>& end() const { return end_of_run_; }

private:
    /// Puts the lanes to rest until the ground lifts the block next; those that it lifts no more
    /// are done.
    void wait_for_uplift(const Mask& lanes)
    {
        const T never(std::numeric_limits<S>::infinity());
        T next = never;
        for (const T& uplift : excitation_.uplifts) {
            next = select<T>(uplift >= now_.phase && uplift < next, uplift, next);
        }
        const Mask lifted = lanes && next < end_;
        now_.tilt = select<T>(lanes, zero_, now_.tilt);
        now_.rate = select<T>(lanes, zero_, now_.rate);
        now_.phase = select<T>(lifted, next, now_.phase);
        const auto pushed_to_plus = excitation_.ground(now_.phase) < zero_;
        now_.side = select<T>(lifted, select<T>(pushed_to_plus, T(S(1)), T(S(-1))), now_.side);
        finish(lanes && !lifted);
        stepper_.lift(now_, lifted);
    }

    /// Freezes the lanes with the state that they have.
    void finish(const Mask& lanes)
    {
        State<T>& state = end_of_run_.state;
        const T tilt = select<T>(now_.tilt > zero_, now_.tilt, zero_);
        state.tilt = select<T>(lanes, tilt, state.tilt);
        state.rate = select<T>(lanes, now_.rate, state.rate);
        state.side = select<T>(lanes, now_.side, state.side);
        active_ = active_ && !lanes;
    }

    void count_step(const Mask& broken)
    {
        end_of_run_.steps = select<T>(active_, end_of_run_.steps + T(S(1)), end_of_run_.steps);
        const Mask too_many = active_ && end_of_run_.steps >= T(S(most_steps));
        const Mask not_finite = active_ && broken;
        if (any<T>(too_many || not_finite)) {
            end_of_run_.capped = end_of_run_.capped || too_many;
            end_of_run_.not_finite = end_of_run_.not_finite || not_finite;
            finish(too_many || not_finite);
        }
    }

    /// The lanes strike the ground.
    void strike(const Mask& lanes)
    {
        const State<T> after =
            state_after_impact<T>({zero_, now_.rate, now_.side}, sqrt_restitution_);
        now_.rate = select<T>(lanes, after.rate, now_.rate);
        now_.side = select<T>(lanes, after.side, now_.side);
        if constexpr (records.impacts) {
            T& impacts = end_of_run_.impacts;
            impacts = select<T>(lanes, impacts + T(S(1)), impacts);
        }
        const Mask rests =
            lanes && bounces_die_out<theory>(block_, excitation_, now_.phase, now_.rate);
        end_of_run_.rested = end_of_run_.rested || rests;
        if (any<T>(rests)) {
            wait_for_uplift(rests);
        }
        stepper_.turn(now_, lanes && active_);
    }

    const Block<T> block_;
    const Excitation<Pulse, T> excitation_;
    const T end_;
    const T zero_;
    T sqrt_restitution_;

    typename Method::template Stepper<Pulse, theory, T> stepper_;
    Rocking<T> now_;
    Mask active_;
    ForcedEnd<T> end_of_run_;
};

/// Steps every stage in turn until all are done.
template <class Stage, std::size_t count>
void run_in_turns(std::array<Stage, count>& stages)
{
    for (bool goes_on = true; goes_on;) {
        goes_on = false;
        for (Stage& stage : stages) {
            if (stage.is_active()) {
                stage.advance();
                goes_on = true;
            }
        }
    }
}

/// The forced stage of one block per lane; see ForcedStage. tolerance: largest local error per step
/// of tilt and rate, over the size of the motion, at most alpha [1].
template <class Method, class Pulse, Theory theory, Records records = Records{.impacts = true},
          Number T>
ForcedEnd<T> run_forced_stage(const Block<T>& block, const Excitation<Pulse, T>& excitation,
                              const scalar_t<T>& tolerance)
{
    ForcedStage<Method, Pulse, theory, records, T> stage(block, excitation, tolerance);
    while (stage.is_active()) {
        stage.advance();
    }
    return stage.end();
}

} // namespace overturn
