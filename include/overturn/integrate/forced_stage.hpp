// The forced stage: uplift, rocking, impacts and rest of a block until the end of the pulse or its
// fall (Eq. 47). The free stage is never integrated.
// Lanes run in lockstep, each with its own step size; a finished lane is frozen.
#pragma once

#include "overturn/integrate/observers/contact_observer.hpp"
#include "overturn/integrate/observers/observers.hpp"
#include "overturn/integrate/record_stepper.hpp"
#include "overturn/integrate/runge_kutta_stepper.hpp"
#include "overturn/integrate/taylor_stepper.hpp"
#include "overturn/mechanics/bounce_series.hpp"

#include <optional>

namespace overturn {

/// The largest number of trial steps of a point. It allows half a million impacts, or a tolerance
/// of 1e-14 over thousands of periods of 1/p. An amplitude less than 1e-4 above the uplift
/// threshold causes more impacts if the block loses little energy (r within 1e-5 of 1); the point
/// remains undecided. One step per interval of a record is added.
inline constexpr double most_steps = 1 << 20;

/// Selects Dormand-Prince 5(4), only for pulses.
struct RungeKutta {
    template <Theory theory, Number T, Outputs outputs, class Excitation>
        requires(!Excitation::is_recorded)
    using Stepper = RungeKuttaStepper<theory, T, outputs>;
};

/// Selects Taylor series of this order.
template <int order>
struct Taylor {
    template <Theory theory, Number T, Outputs outputs, class Excitation>
    using Stepper = std::conditional_t<Excitation::is_recorded,
                                       RecordStepper<order, theory, T, outputs, Excitation>,
                                       TaylorStepper<order, theory, T, outputs>>;
};

/// Integrates one block per lane. Method: RungeKutta or Taylor<order>. Excitation: PulseExcitation
/// or RecordExcitation.
template <class Method, Theory theory, Outputs outputs, Number T,
          class Excitation = PulseExcitation<T>>
class ForcedStage {
    static_assert(RockingTheory<theory>);
    using S = scalar_t<T>;
    using E = estimate_t<T>;
    using Mask = mask_t<T>;
    static_assert(!outputs.contact || Equations<theory>::has_contact_forces);

public:
    /// uncertain_impact: used only if the error is an output. contact: only if it is an output.
    ForcedStage(const Block<T>& block, const Excitation& excitation, const S& tolerance,
                UncertainImpact uncertain_impact = UncertainImpact::go_on,
                [[maybe_unused]] const std::optional<ContactSides<E>>& contact = {})
        : block_(block), excitation_(excitation), end_(excitation.motion.end),
          step_limit_(S(most_steps) + excitation.motion.pieces()),
          stepper_(block, excitation, tolerance),
          now_{T(excitation.motion.begin), T(0), T(0), T(1)},
          lifted_(-std::numeric_limits<S>::infinity()), active_(T(0) == T(0)),
          is_two_sided_(any<T>(!block.is_symmetric())), from_plus_(block),
          frequency_(excitation.frequency), rate_ratio_(block.rate_ratio()),
          fastest_series_(fastest_bounce_series(block, excitation)),
          uncertain_impact_(uncertain_impact)
    {
        const Mask none = !active_;
        end_of_run_ = {.state = {T(0), T(0), T(1)},
                       .fell = none,
                       .rested = none,
                       .capped = none,
                       .not_finite = none,
                       .steps = T(0),
                       .phase = end_};
        if constexpr (outputs.contact) {
            followed_ = none;
            if (contact) {
                contact_.emplace(*contact);
                set_side_of_contact();
            }
        }
        if (is_two_sided_) {
            side_at_rest_ = side_of_higher_barrier(block);
        }
        wait_for_uplift(active_);
    }

    /// The events so far, in order; only if they are an output.
    const auto& events() const { return observers_.events.all; }

    /// As seen from the side on which it rocks, or rocked at the end.
    const Block<T>& block() const { return block_; }

    /// Whether any lane is still active.
    bool is_active() const { return any<T>(active_); }

    /// Takes one step in every active lane and handles the event at its end.
    void advance()
    {
        const auto observe = [&]<int halvings>(const auto& end, const Mask& lanes,
                                               const auto& step) {
            with_contact([&](auto& contact) {
                contact.template pass_step<halvings>({estimate_of(now_.tilt),
                                                      estimate_of(now_.rate), estimate_of(end.tilt),
                                                      estimate_of(end.rate)},
                                                     active_, active_ && lanes, step);
            });
        };
        const auto step = straight_line<T>(
            [&] { return stepper_.step(now_, active_, observers_.extremes, observe); });
        count_step(step.broken);
        const Mask moved = active_ && step.moved;
        observers_.each([&](auto& observer) {
            observer.pass_step(block_, excitation_, now_, step, but_followed(moved));
        });
        now_.phase = select<T>(moved, step.phase, now_.phase);
        now_.tilt = select<T>(moved, step.tilt, now_.tilt);
        now_.rate = select<T>(moved, step.rate, now_.rate);
        pass_event(EventKind::step, moved);
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

    /// The ends of all lanes, once none is active.
    ForcedEnd<T> end() const
    {
        ForcedEnd<T> end = end_of_run_;
        observers_.each([&](const auto& observer) {
            observer.complete(end, block_, from_plus_, excitation_, now_);
        });
        return end;
    }

    struct ContactNeeds {
        ContactDemand<E> demand; ///< see ContactObserver::demand()
        E to_stick;              ///< see ContactObserver::slip_demand(); if it is wanted
    };

    /// What the contact had to bear, if it was observed and all lanes have an end.
    ContactNeeds contact_needs(bool with_to_stick) const
        requires(outputs.contact)
    {
        const State<T>& state = end_of_run_.state;
        const Mask returns = state.rate < Equations<theory>::separatrix_rate(block_, state.tilt);
        const Mask rocks_on = !(end_of_run_.fell || end_of_run_.is_stopped());
        const State<E> end{estimate_of(state.tilt), estimate_of(state.rate),
                           estimate_of(state.side)};
        const ContactDemand<E> later =
            free_contact(end, estimate_of(block_), contact_->sides(), rocks_on);
        return {contact_->demand(end_of_run_.fell || !returns, later),
                with_to_stick ? contact_->slip_demand(later) : E(0)};
    }

private:
    /// These lanes without those in which a series of bounces that dies out is followed, which only
    /// the contact sees.
    Mask but_followed(const Mask& lanes) const
    {
        if constexpr (outputs.contact) {
            return lanes && !followed_;
        } else {
            return lanes;
        }
    }

    void set_side_of_contact()
    {
        with_contact([&](auto& contact) {
            const auto ground = excitation_.ground_bounds();
            std::array<E, 5> bounds;
            std::ranges::transform(ground, bounds.begin(),
                                   [](const T& bound) { return estimate_of(bound); });
            contact.set_side(estimate_of(now_.side), estimate_of(block_.slenderness), bounds);
        });
    }

    /// Calls visit(observer) if the contact is observed.
    void with_contact([[maybe_unused]] const auto& visit)
    {
        if constexpr (outputs.contact) {
            if (contact_) {
                visit(*contact_);
            }
        }
    }

    /// Whether the rest of a series of bounces that dies out, of which the first has this rate,
    /// need not be followed: it lasts so short a time that the push hardly changes, or more than
    /// some ten thousand bounces were followed. What the contact bears until its end is seen.
    [[gnu::noinline, gnu::cold]] Mask ends_series(const Mask& lanes, const T& rate)
    {
        const Block<T> other = block_.turned();
        const auto pull_at = [&](const T& phase, const Block<T>& block, const T& side) -> T {
            const T pull =
                -Equations<theory>::acceleration(block, T(0), side * excitation_.ground(phase));
            return select<T>(lanes, pull, 1);
        };
        // On each side, the flights are shorter by the factor r from one to the next.
        const T flights =
            (rate + rate) * (block_.frequency_parameter / (other.frequency_parameter *
                                                           pull_at(now_.phase, other, -now_.side)) +
                             other.rate_ratio() / pull_at(now_.phase, block_, now_.side));
        const T lost = select<T>(lanes, 1 - block_.restitution, 1);
        const T duration = flights / lost * excitation_.frequency;
        const T decay = 5000 * rough_log2(block_.restitution); // of ten thousand bounces
        const T followed = rough_power_of_two(greater<T>(decay, -900));
        const Mask ends = lanes && (duration < 1e-6 || rate < followed * block_.slenderness);
        const auto observe = [&](const T& phase, const Block<T>& block, const T& side) {
            const auto push = estimate_of(side * excitation_.ground(phase));
            const E none(0);
            const MovingBlock<E, std::remove_cvref_t<decltype(push)>> standing{none, none, push,
                                                                               push};
            contact_->pass_rest(
                demand_of(force_while_rocking(contact_->sides().seen_from(estimate_of(side)),
                                              estimate_of(block.slenderness), standing)),
                ends);
        };
        const T end = select<T>(ends, lesser<T>(now_.phase + duration, end_), now_.phase);
        for (const T& phase : {now_.phase, end}) {
            observe(phase, block_, now_.side);
            observe(phase, other, -now_.side);
        }
        return ends;
    }

    /// The block rests between two phases; not at all if they are equal, as at the onset of a
    /// motion that lifts it at once. The friction that a record asks for is monotone between two
    /// samples.
    [[gnu::noinline, gnu::cold]] void rest_on_contact(const Mask& rests, const T& first,
                                                      const T& last)
    {
        const Mask lanes = rests && first < last;
        const ContactSide<E>& side = contact_->sides().plus;
        const auto observe = [&](const T& phase, const Mask& at) {
            const auto push = estimate_of(excitation_.ground(phase));
            contact_->pass_rest(demand_of(force_at_rest(side, push, push)), at);
        };
        observe(last, lanes);
        if constexpr (Excitation::is_recorded) {
            for (T phase = first; any<T>(lanes && phase < last);
                 phase = excitation_.motion.end_of_piece(phase)) {
                observe(phase, lanes && phase < last);
            }
        } else { // both are monotone functions of the push
            observe(first, lanes);
            for (const S& peak : excitation_.motion.peaks) {
                const Mask within = lanes && first < T(peak) && T(peak) < last;
                if (any<T>(within)) {
                    observe(T(peak), within);
                }
            }
        }
    }

    void pass_event(EventKind kind, const Mask& lanes)
    {
        observers_.each([&](auto& observer) { observer.pass_event(kind, now_, lanes); });
    }

    /// Sets the lanes to rest until the next uplift. Lanes without another uplift are finished.
    void wait_for_uplift(const Mask& lanes)
    {
        const T next = excitation_.next_uplift(lanes, now_.phase, lifted_);
        const Mask lifted = lanes && next < end_;
        with_contact(
            [&](auto&) { rest_on_contact(lanes, now_.phase, select<T>(lifted, next, end_)); });
        if (is_two_sided_) {
            now_.side = select<T>(lanes, side_at_rest_, now_.side);
        }
        now_.tilt = select<T>(lanes, 0, now_.tilt);
        now_.rate = select<T>(lanes, 0, now_.rate);
        now_.phase = select<T>(lifted, next, now_.phase);
        lifted_ = select<T>(lifted, next, lifted_);
        const Mask pushed_to_plus = horizontal_of(excitation_.ground(now_.phase)) < 0;
        now_.side = select<T>(lifted, select<T>(pushed_to_plus, 1, -1), now_.side);
        if (is_two_sided_) {
            change_sides();
        }
        pass_event(EventKind::uplift, lifted);
        finish(lanes && !lifted);
        with_contact([&](auto& contact) { contact.turn(estimate_of(now_.side)); });
        stepper_.lift(now_, lifted);
    }

    // Not inlined: these would change what the compiler does with symmetric blocks.
    [[gnu::noinline, gnu::cold]] static T side_of_higher_barrier(const Block<T>& block)
    {
        const T largest = Equations<theory>::separatrix_rate(block, T(0));
        return select<T>(barrier_ratio<theory>(largest, block) > 1, -1, 1);
    }

    /// Sees the blocks from the sides on which they rock now.
    [[gnu::noinline, gnu::cold]] void change_sides()
    {
        const T before = block_.slenderness;
        const Mask is_plus = now_.side > 0;
        block_ =
            combined([&](const T& plus, const T& minus) { return select<T>(is_plus, plus, minus); },
                     from_plus_, from_plus_.turned());
        observers_.each(
            [&](auto& observer) { observer.change_sides(T(block_.slenderness / before)); });
        rate_ratio_ = block_.rate_ratio();
        excitation_.frequency = frequency_ / block_.frequency_parameter;
        fastest_series_ = fastest_bounce_series(block_, excitation_);
        stepper_.set_side(block_, excitation_.frequency);
        set_side_of_contact();
    }

    /// Freezes the lanes in their current state.
    void finish(const Mask& lanes)
    {
        State<T>& state = end_of_run_.state;
        const T tilt = select<T>(now_.tilt > 0, now_.tilt, 0);
        state.tilt = select<T>(lanes, tilt, state.tilt);
        state.rate = select<T>(lanes, now_.rate, state.rate);
        state.side = select<T>(lanes, now_.side, state.side);
        active_ = active_ && !lanes;
    }

    void count_step(const Mask& broken)
    {
        end_of_run_.steps =
            select<T>(but_followed(active_), end_of_run_.steps + 1, end_of_run_.steps);
        const Mask too_many = active_ && end_of_run_.steps >= step_limit_;
        const Mask not_finite = active_ && broken;
        if (any<T>(too_many || not_finite)) {
            end_of_run_.capped = end_of_run_.capped || too_many;
            end_of_run_.not_finite = end_of_run_.not_finite || not_finite;
            finish(too_many || not_finite);
        }
    }

    /// Handles the impact of these lanes.
    void strike(const Mask& lanes)
    {
        const State<T> after = state_after_impact<T>({T(0), now_.rate, now_.side}, rate_ratio_);
        // As measured on the side from which the block strikes, see bounces_die_out().
        const T rate = is_two_sided_ ? sqrt(block_.restitution) * -now_.rate : after.rate;
        Mask rests = lanes && rate <= fastest_series_;
        if (any<T>(rests)) {
            rests =
                rests && bounces_die_out<theory>(block_, excitation_, now_.phase, rate, now_.side);
        }
        if constexpr (outputs.events) { // show the individual bounces
            rests = rests && after.rate < T(S(1) / 1024) * block_.slenderness;
        }
        const Mask counted = but_followed(lanes);
        const Mask dies_out = but_followed(rests);
        if constexpr (outputs.contact) {
            if (contact_) {
                const Mask series = lanes && (rests || followed_);
                rests = any<T>(series) ? ends_series(series, after.rate) : series;
                followed_ = (followed_ || series) && !rests;
            }
        }
        observers_.each([&](auto& observer) {
            observer.pass_impact(block_, excitation_, now_, counted, dies_out);
        });
        now_.rate = select<T>(lanes, after.rate, now_.rate);
        now_.side = select<T>(lanes, after.side, now_.side);
        if (is_two_sided_) {
            change_sides();
            with_contact([&](auto& contact) {
                contact.pass_impact(estimate_of(now_.side), estimate_of(block_.slenderness), lanes);
            });
        }
        pass_event(EventKind::impact, counted);
        pass_event(EventKind::rest, dies_out);
        end_of_run_.rested = end_of_run_.rested || dies_out;
        if (any<T>(rests)) {
            wait_for_uplift(rests);
        }
        with_contact([&](auto& contact) { contact.turn(estimate_of(now_.side)); });
        stepper_.turn(now_, lanes && active_);
        if constexpr (outputs.error) {
            if (uncertain_impact_ == UncertainImpact::stop) {
                finish(active_ && observers_.error.is_doubtful());
            }
        }
    }

    Block<T> block_;
    Excitation excitation_;
    const T end_;
    const T step_limit_;

    typename Method::template Stepper<
        theory, T,
        Outputs{.error = outputs.error, .peak = outputs.peak, .contact = outputs.contact},
        Excitation>
        stepper_;
    Rocking<T> now_;
    T lifted_; // phase of the latest uplift; the flank of a lobe lifts a block only once
    Mask active_;
    ForcedEnd<T> end_of_run_;
    const bool is_two_sided_;
    const Block<T> from_plus_; // the blocks as seen from the side plus
    const T frequency_;        // of the motion, in the unit of Block::frequency_parameter
    T side_at_rest_;           // that of the higher barrier: the margin is smaller there
    T rate_ratio_;             // of an impact on the side on which the block rocks
    T fastest_series_;

    [[no_unique_address]] Observers<outputs, theory, T, Excitation::is_recorded> observers_;
    [[no_unique_address]] OnlyIf<outputs.contact, std::optional<ContactObserver<E>>> contact_;
    [[no_unique_address]] OnlyIf<outputs.contact, Mask> followed_; // see but_followed()
    UncertainImpact uncertain_impact_;
};

/// The forced stage of one block per lane; see ForcedStage. tolerance: largest local error per step
/// of tilt and rate, over the size of the motion, at most alpha [1].
template <class Method, Theory theory, Outputs outputs = Outputs{.impacts = true}, Number T,
          class Excitation>
ForcedEnd<T> run_forced_stage(const Block<T>& block, const Excitation& excitation,
                              const scalar_t<T>& tolerance)
{
    ForcedStage<Method, theory, outputs, T, Excitation> stage(block, excitation, tolerance);
    while (stage.is_active()) {
        stage.advance();
    }
    return stage.end();
}

} // namespace overturn
