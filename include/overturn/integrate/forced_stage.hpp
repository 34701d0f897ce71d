// The forced stage: a block from rest through uplift, rocking, impacts and rest to the end of the
// pulse or its fall (Eq. 47). The free stage is never integrated.
// Lanes run in lockstep, each with its own step size; a lane that is done is frozen.
#pragma once

#include "overturn/integrate/in_doubt.hpp"
#include "overturn/integrate/milestone.hpp"
#include "overturn/integrate/runge_kutta_stepper.hpp"
#include "overturn/integrate/taylor_stepper.hpp"
#include "overturn/mechanics/bounce_series.hpp"
#include "overturn/mechanics/region.hpp"

#include <type_traits>

namespace overturn {

/// What a run records beside the end state. Not asked for, not paid for.
struct Records {
    bool impacts = false;
    bool error = false;
    bool peak = false;       ///< not together with the error
    bool milestones = false; ///< of a single block only
};

constexpr Watch watch_for(const Records& records)
{
    return records.error ? Watch::errors : records.peak ? Watch::peak : Watch::nothing;
}

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
    T phase;              ///< of the pulse: its end, or less where it fell [rad]
    /// Only if asked for:
    T error;            ///< of the margin, at most, to first order; infinite where unknown
    mask_t<T> in_doubt; ///< the error is not smaller than the margin, or there is none
    T peak;             ///< the largest tilt [rad]
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
    /// in_doubt: matters only where errors are recorded.
    ForcedStage(const Block<T>& block, const Excitation<Pulse, T>& excitation, const S& tolerance,
                InDoubt in_doubt = InDoubt::goes_on)
        : block_(block), excitation_(excitation), end_(excitation.end), zero_(S(0)),
          stepper_(block, excitation, tolerance), now_{T(excitation.begin), zero_, zero_, T(S(1))},
          lifted_(-std::numeric_limits<S>::infinity()), active_(zero_ == zero_),
          doubtful_(!active_), in_doubt_(in_doubt)
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
                       .steps = zero_,
                       .phase = end_,
                       .error = zero_,
                       .in_doubt = none,
                       .peak = zero_};
        wait_for_uplift(active_);
    }

    /// What has happened so far, in order; only if asked for.
    const auto& milestones() const { return milestones_; }

    /// Whether a lane has still to go on.
    bool is_active() const { return any<T>(active_); }

    /// One step in every lane that is active; acts on the event at its end.
    void advance()
    {
        const auto step = straight_line<T>([&] { return stepper_.step(now_, active_); });
        count_step(step.broken);
        const Mask moved = active_ && step.moved;
        if constexpr (records.error) {
            pass_errors(step, moved);
        }
        if constexpr (records.peak) {
            T& peak = end_of_run_.peak;
            peak = select<T>(moved, greater<T>(step.peak, peak), peak);
        }
        now_.phase = select<T>(moved, step.phase, now_.phase);
        now_.tilt = select<T>(moved, step.tilt, now_.tilt);
        now_.rate = select<T>(moved, step.rate, now_.rate);
        if constexpr (records.milestones) {
            milestones_.note(Happening::step, now_, moved);
        }
        const Mask fell = moved && step.falls;
        const Mask strikes = moved && step.strikes;
        if (any<T>(fell || strikes)) {
            end_of_run_.fell = end_of_run_.fell || fell;
            end_of_run_.phase = select<T>(fell, now_.phase, end_of_run_.phase);
            finish(fell);
            strike(strikes);
        }
        const Mask over = active_ && moved && now_.phase >= end_;
        if (any<T>(over)) {
            finish(over);
        }
    }

    /// Where the lanes have ended, once none is active.
    ForcedEnd<T> end() const
    {
        ForcedEnd<T> end = end_of_run_;
        if constexpr (records.error) {
            tell_error(end);
        }
        return end;
    }

private:
    /// Puts the lanes to rest until the ground lifts the block next; those that it lifts no more
    /// are done.
    void wait_for_uplift(const Mask& lanes)
    {
        const T never(std::numeric_limits<S>::infinity());
        T next = never;
        for (const T& uplift : excitation_.uplifts) {
            next =
                select<T>(uplift >= now_.phase && uplift > lifted_ && uplift < next, uplift, next);
        }
        const Mask lifted = lanes && next < end_;
        now_.tilt = select<T>(lanes, zero_, now_.tilt);
        now_.rate = select<T>(lanes, zero_, now_.rate);
        now_.phase = select<T>(lifted, next, now_.phase);
        lifted_ = select<T>(lifted, next, lifted_);
        const auto pushed_to_plus = excitation_.ground(now_.phase) < zero_;
        now_.side = select<T>(lifted, select<T>(pushed_to_plus, T(S(1)), T(S(-1))), now_.side);
        if constexpr (records.milestones) {
            milestones_.note(Happening::uplift, now_, lifted);
        }
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
        Mask rests = lanes && bounces_die_out<theory>(block_, excitation_, now_.phase, after.rate);
        if constexpr (records.milestones) { // who looks wants to see the bounces, not their sum
            rests = rests && after.rate < T(S(1) / 1024) * block_.slenderness;
        }
        if constexpr (records.error) {
            pass_errors_over_impact(lanes, rests);
        }
        now_.rate = select<T>(lanes, after.rate, now_.rate);
        now_.side = select<T>(lanes, after.side, now_.side);
        if constexpr (records.impacts) {
            T& impacts = end_of_run_.impacts;
            impacts = select<T>(lanes, impacts + T(S(1)), impacts);
        }
        if constexpr (records.milestones) {
            milestones_.note(Happening::impact, now_, lanes);
            milestones_.note(Happening::rest, now_, rests);
        }
        end_of_run_.rested = end_of_run_.rested || rests;
        if (any<T>(rests)) {
            if constexpr (records.error) {
                growth_.forget(rests);
            }
            wait_for_uplift(rests);
        }
        stepper_.turn(now_, lanes && active_);
        if constexpr (records.error) {
            if (in_doubt_ == InDoubt::ends) {
                finish(active_ && doubtful_);
            }
        }
    }

    /// Errors grow over a step, and its own come on top.
    void pass_errors(const WatchedStepEnd<T>& step, const Mask& lanes)
    {
        using arithmetic::fma;
        using std::abs;
        const T rounding(std::numeric_limits<S>::epsilon());
        const T rate = abs(now_.rate) + abs(step.rate);
        const T acceleration = abs(excitation_.acceleration) + block_.slenderness; // at most
        // What is wrong by a rounding all the time, such as the peak of the pulse, adds up; that of
        // the phase and the state is random.
        const T duration = (step.phase - now_.phase) / excitation_.frequency;
        const T late = abs(step.phase) / excitation_.frequency;
        growth_.pass(step.errors.variation, lanes);
        growth_.add(fma(rounding * duration, rate, step.errors.tilt),
                    fma(rounding * duration, acceleration + acceleration, step.errors.rate), lanes);
        growth_.add_round_off(T(rounding * step.tilt), T(rounding * rate), T(rounding * late),
                              step.rate, step.errors.acceleration, lanes);

        // A block that turned nearer to the ground, or to pi/2, than its error may have met it.
        const Mask inward = lanes && now_.rate < zero_ && step.rate > zero_ && !step.falls;
        const Mask outward = lanes && now_.rate > zero_ && step.rate < zero_ && !step.strikes;
        if (any<T>(inward || outward)) {
            const T radius = growth_.bound(T(S(1)), zero_);
            const T turn = step.errors.turning_tilt;
            const Mask met =
                (inward && !(turn > radius)) || (outward && !(T(pi<S>() / 2) - turn > radius));
            doubtful_ = doubtful_ || met;
        }
    }

    /// What is known to first order is trusted as long as the square of the speed is known to a
    /// quarter of itself; that a series of bounces dies out, to a 64th. A block that stood on its
    /// edge for long before it came back may as well have overturned: its distance from the top has
    /// grown since, like its error, which must still be small beside alpha.
    void pass_errors_over_impact(const Mask& lanes, const Mask& rests)
    {
        const T push = now_.side * excitation_.ground(now_.phase);
        const T before = rocking_acceleration<theory>(zero_, block_.slenderness, push);
        const T after = rocking_acceleration<theory>(zero_, block_.slenderness, T(-push));
        const T speed = select<T>(lanes && now_.rate < zero_, -now_.rate, T(S(1)));
        const T square_error = growth_.bound(T(before + before), T(speed + speed));
        const T share = select<T>(rests, T(S(64)), T(S(4)));
        const T radius = growth_.bound(T(S(1)), zero_);
        const Mask known =
            share * square_error < speed * speed && T(S(4)) * radius < block_.slenderness;
        doubtful_ = doubtful_ || (lanes && !(known && now_.rate < zero_));
        growth_.forget(doubtful_); // it would only grow to numbers that are too large
        growth_.pass(variation_over_impact<T>(sqrt_restitution_, speed, before, after), lanes);
    }

    /// Bound of the error of the margin where the lanes are, and whether it could turn the verdict.
    void tell_error(ForcedEnd<T>& end) const
    {
        using arithmetic::fma;
        using std::abs;
        using std::sqrt;
        const State<T> state{now_.tilt, now_.rate, now_.side};
        const T radius = growth_.bound(T(S(1)), zero_);
        const T largest = separatrix_rate<theory>(zero_, block_.slenderness);
        const T roundings(8 * std::numeric_limits<S>::epsilon());

        // The margin is the smaller of two distances, and either may turn out smaller than it
        // looks. The lower one is convex in c, so its gradient is largest at one end of what c may
        // be.
        const SafeRates<T> safe = safe_rates<theory>(state.tilt, block_);
        const T slope = separatrix_slope<theory>(state.tilt, block_.slenderness);
        const auto round_off = [&](const T& limit) -> T {
            return roundings * (abs(state.rate) + abs(limit)) / largest;
        };
        const auto below_gradient = [&](const T& c) -> T {
            const T inward = sqrt(fma(c, c, safe.minus_q_min));
            return c / select<T>(inward > zero_, inward, largest);
        };
        const T one(S(1));
        const T above = (safe.outward - state.rate) / largest;
        const T below = (state.rate + safe.inward) / largest;
        const T above_error = growth_.bound(slope, -one) / largest + round_off(safe.outward);
        const T below_error =
            greater<T>(growth_.bound(T(slope * below_gradient(safe.outward - radius)), one),
                       growth_.bound(T(slope * below_gradient(safe.outward + radius)), one)) /
                largest +
            round_off(safe.inward);
        const T margin = lesser<T>(above, below);
        const T standing =
            greater<T>(below_error - (below - margin), above_error - (above - margin));
        // Just before an impact and just after, the margin differs by sqrt r.
        const T jump = abs(margin) * (one / sqrt_restitution_ - one);
        const T near_impact = select<T>(state.tilt < radius, jump, zero_);

        // On its way to pi/2, at the acceleration a, the square of its speed v changes by
        // 2 v d(rate) - 2 a d(tilt).
        const T push = now_.side * excitation_.ground(now_.phase);
        const T pull = -rocking_acceleration<theory>(now_.tilt, block_.slenderness, push);
        const T lying = (growth_.bound(T(pull + pull), T(now_.rate + now_.rate)) +
                         roundings * now_.rate * now_.rate) /
                        (largest * largest);
        // Whether it lies before the pulse ends.
        const T left = (end_ - now_.phase) / excitation_.frequency;
        const Mask& fell = end_of_run_.fell;
        const Mask either =
            (fell && left * now_.rate < radius) || (!fell && T(pi<S>() / 2) - now_.tilt < radius);
        // Nor whether it lies at all, unless it comes down with some energy. That is bounded away
        // from zero, its distance from the separatrix is not: that distance has grown like the
        // error, which must be a small share of it.
        const Mask barely = fell && !(T(S(4)) * standing < abs(margin) &&
                                      lying * largest * largest < now_.rate * now_.rate);
        const T error = select<T>(fell, lying, standing + near_impact);
        const Mask known = growth_.bound(T(S(1)), T(S(1))) < T(unknown_error<S> * S(0x1p-100));
        const Mask unknown = doubtful_ || end_of_run_.capped || end_of_run_.not_finite || either ||
                             barely || !known || !(error == error);
        end.error = select<T>(unknown, T(std::numeric_limits<S>::infinity()), error);
        end.in_doubt =
            !(end.error < abs(select<T>(fell, margin_of_fall<theory>(now_.rate, block_), margin)));
    }

    const Block<T> block_;
    const Excitation<Pulse, T> excitation_;
    const T end_;
    const T zero_;
    T sqrt_restitution_;

    typename Method::template Stepper<Pulse, theory, T, watch_for(records)> stepper_;
    Rocking<T> now_;
    T lifted_; // phase of the latest uplift: no flank of a lobe lifts a block twice
    Mask active_;
    ForcedEnd<T> end_of_run_;

    struct NoGrowth {};
    struct NoMilestones {};
    [[no_unique_address]] std::conditional_t<records.error, ErrorGrowth<T>, NoGrowth> growth_;
    [[no_unique_address]] std::conditional_t<records.milestones, Milestones<T>, NoMilestones>
        milestones_;
    Mask doubtful_; // an event may or may not have happened
    InDoubt in_doubt_;
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
