// The forced stage: uplift, rocking, impacts and rest of a block until the end of the pulse or its
// fall (Eq. 47). The free stage is never integrated.
// Lanes run in lockstep, each with its own step size; a finished lane is frozen.
#pragma once

#include "overturn/integrate/contact_watch.hpp"
#include "overturn/integrate/event.hpp"
#include "overturn/integrate/forced_end.hpp"
#include "overturn/integrate/margin_error.hpp"
#include "overturn/integrate/record_stepper.hpp"
#include "overturn/integrate/runge_kutta_stepper.hpp"
#include "overturn/integrate/taylor_stepper.hpp"
#include "overturn/mechanics/bounce_series.hpp"

#include <optional>
#include <vector>

namespace overturn {

/// The largest number of trial steps of a point. It allows half a million impacts, or a tolerance
/// of 1e-14 over thousands of periods of 1/p. An amplitude less than 1e-4 above the uplift
/// threshold causes more impacts if the block loses little energy (r within 1e-5 of 1); the point
/// remains undecided. One step per interval of a record is added.
inline constexpr double most_steps = 1 << 20;

/// A block just after an event. Until the next event, it rocks on its side or rests.
template <Number T>
struct Event {
    EventKind kind;
    Rocking<T> rocking;
};

/// Selects Dormand-Prince 5(4), only for pulses.
struct RungeKutta {
    template <Theory theory, Number T, Outputs outputs, class Excitation>
        requires std::same_as<Excitation, PulseExcitation<T>>
    using Stepper = RungeKuttaStepper<theory, T, outputs>;
};

/// Selects Taylor series of this order.
template <int order>
struct Taylor {
    template <Theory theory, Number T, Outputs outputs, class Excitation>
    using Stepper = std::conditional_t<std::same_as<Excitation, PulseExcitation<T>>,
                                       TaylorStepper<order, theory, T, outputs>,
                                       RecordStepper<order, theory, T, outputs, Excitation>>;
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
    static constexpr bool is_recorded = !std::same_as<Excitation, PulseExcitation<T>>;
    static constexpr bool may_watch = outputs.contact;
    static_assert(!may_watch || Equations<theory>::has_contact_forces);

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
                       .impacts = T(0),
                       .steps = T(0),
                       .phase = end_,
                       .error = T(0),
                       .in_doubt = none,
                       .peak = T(0),
                       .softest_impact = T(std::numeric_limits<S>::infinity()),
                       .last_impact = T(std::numeric_limits<S>::infinity()),
                       .lowest_turn = T(std::numeric_limits<S>::infinity())};
        if constexpr (may_watch) {
            followed_ = none;
            if (contact) {
                watch_.emplace(*contact);
                see_side();
            }
        }
        if (is_two_sided_) {
            side_at_rest_ = side_of_higher_barrier(block);
        }
        wait_for_uplift(active_);
    }

    /// The events so far, in order; only if they are an output.
    const auto& events() const { return events_; }

    /// As seen from the side on which it rocks, or rocked at the end.
    const Block<T>& block() const { return block_; }

    /// Whether any lane is still active.
    bool is_active() const { return any<T>(active_); }

    /// Takes one step in every active lane and handles the event at its end.
    void advance()
    {
        const auto see = [&]<int halvings>(const auto& end, const Mask& lanes, const auto& step) {
            if_watched([&](auto& watch) {
                watch.template see_step<halvings>({estimate_of(now_.tilt), estimate_of(now_.rate),
                                                   estimate_of(end.tilt), estimate_of(end.rate)},
                                                  active_, active_ && lanes, step);
            });
        };
        const auto step =
            straight_line<T>([&] { return stepper_.step(now_, active_, end_of_run_, see); });
        count_step(step.broken);
        const Mask moved = active_ && step.moved;
        if constexpr (outputs.error) {
            margin_error_.pass_step(block_, excitation_, now_, step, but_followed(moved));
        }
        if constexpr (outputs.peak) {
            const Mask counted = but_followed(moved);
            T& peak = end_of_run_.peak;
            peak = select<T>(counted, greater<T>(step.extremes.peak, peak), peak);
            T& turn = end_of_run_.lowest_turn;
            turn = select<T>(counted, lesser<T>(step.extremes.lowest_turn, turn), turn);
        }
        now_.phase = select<T>(moved, step.phase, now_.phase);
        now_.tilt = select<T>(moved, step.tilt, now_.tilt);
        now_.rate = select<T>(moved, step.rate, now_.rate);
        record(EventKind::step, moved);
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
        if constexpr (outputs.peak) {
            if (is_two_sided_) {
                end.peak = end.peak * (from_plus_.slenderness / block_.slenderness);
            }
        }
        if constexpr (outputs.error) {
            end = margin_error_.at_end(block_, excitation_, now_, end);
        }
        return end;
    }

    /// What the contact had to bear, if it was watched and all lanes have an end.
    ContactDemand<E> contact_demand() const
        requires may_watch
    {
        const State<T>& state = end_of_run_.state;
        const Mask returns = state.rate < Equations<theory>::separatrix_rate(block_, state.tilt);
        const Mask rocks_on = !(end_of_run_.fell || end_of_run_.is_stopped());
        const State<E> end{estimate_of(state.tilt), estimate_of(state.rate),
                           estimate_of(state.side)};
        return watch_->demand(end_of_run_.fell || !returns,
                              free_contact(end, estimate_of(block_), watch_->sides(), rocks_on));
    }

private:
    /// These lanes without those in which a series of bounces that dies out is followed, which only
    /// the contact sees.
    Mask but_followed(const Mask& lanes) const
    {
        if constexpr (may_watch) {
            return lanes && !followed_;
        } else {
            return lanes;
        }
    }

    void see_side()
    {
        if_watched([&](auto& watch) {
            const auto ground = excitation_.ground_bounds();
            std::array<E, 5> bounds;
            std::ranges::transform(ground, bounds.begin(),
                                   [](const T& bound) { return estimate_of(bound); });
            watch.see_side(estimate_of(now_.side), estimate_of(block_.slenderness), bounds);
        });
    }

    /// Calls visit(watch) if the contact is watched.
    void if_watched([[maybe_unused]] const auto& visit)
    {
        if constexpr (may_watch) {
            if (watch_) {
                visit(*watch_);
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
            (rate + rate) * (block_.pace / (other.pace * pull_at(now_.phase, other, -now_.side)) +
                             other.rate_ratio() / pull_at(now_.phase, block_, now_.side));
        const T lost = select<T>(lanes, 1 - block_.restitution, 1);
        const T duration = flights / lost * excitation_.frequency;
        const T decay = 5000 * rough_log2(block_.restitution); // of ten thousand bounces
        const T followed = rough_power_of_two(greater<T>(decay, -900));
        const Mask ends = lanes && (duration < 1e-6 || rate < followed * block_.slenderness);
        const auto see = [&](const T& phase, const Block<T>& block, const T& side) {
            const auto push = estimate_of(side * excitation_.ground(phase));
            const E none(0);
            const MovingBlock<E, std::remove_cvref_t<decltype(push)>> standing{none, none, push,
                                                                               push};
            watch_->see_rest(
                demand_of(force_while_rocking(watch_->sides().seen_from(estimate_of(side)),
                                              estimate_of(block.slenderness), standing)),
                ends);
        };
        const T end = select<T>(ends, lesser<T>(now_.phase + duration, end_), now_.phase);
        for (const T& phase : {now_.phase, end}) {
            see(phase, block_, now_.side);
            see(phase, other, -now_.side);
        }
        return ends;
    }

    /// The block rests between two phases; not at all if they are equal, as at the onset of a
    /// motion that lifts it at once. The friction that a record asks for is monotone between two
    /// samples.
    [[gnu::noinline, gnu::cold]] void see_rest(const Mask& at_rest, const T& first, const T& last)
    {
        const Mask lanes = at_rest && first < last;
        const ContactSide<E>& side = watch_->sides().plus;
        if constexpr (is_recorded) {
            const auto see = [&](const T& phase, const Mask& at) {
                const auto push = estimate_of(excitation_.ground(phase));
                watch_->see_rest(demand_of(force_at_rest(side, push, push)), at);
            };
            for (T phase = first; any<T>(lanes && phase < last); phase = floor(phase) + 1) {
                see(phase, lanes && phase < last);
            }
            see(last, lanes);
        } else {
            // Both are monotone functions of the push.
            const auto see = [&](const T& phase, const Mask& at) {
                const T push = excitation_.ground(phase);
                watch_->see_rest(demand_of(force_at_rest(side, push, push)), at);
            };
            see(first, lanes);
            see(last, lanes);
            for (const S& peak : excitation_.motion.peaks) {
                const Mask within = lanes && first < T(peak) && T(peak) < last;
                if (any<T>(within)) {
                    see(T(peak), within);
                }
            }
        }
    }

    void record([[maybe_unused]] EventKind kind, [[maybe_unused]] const Mask& happened)
    {
        if constexpr (outputs.events) {
            if (happened) {
                events_.push_back({kind, now_});
            }
        }
    }

    /// Sets the lanes to rest until the next uplift. Lanes without another uplift are finished.
    void wait_for_uplift(const Mask& lanes)
    {
        const T next = excitation_.next_uplift(lanes, now_.phase, lifted_);
        const Mask lifted = lanes && next < end_;
        if_watched([&](auto&) { see_rest(lanes, now_.phase, select<T>(lifted, next, end_)); });
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
        record(EventKind::uplift, lifted);
        finish(lanes && !lifted);
        if_watched([&](auto& watch) { watch.turn(estimate_of(now_.side)); });
        stepper_.lift(now_, lifted);
    }

    // Not inlined: these would change what the compiler does with symmetric blocks.
    [[gnu::noinline, gnu::cold]] static T side_of_higher_barrier(const Block<T>& block)
    {
        const T largest = Equations<theory>::separatrix_rate(block, T(0));
        return select<T>(barrier_ratio<theory>(largest, block) > 1, -1, 1);
    }

    /// Sees the blocks from the sides on which they rock now. The peak remains the largest share of
    /// alpha, times the alpha of the side.
    [[gnu::noinline, gnu::cold]] void change_sides()
    {
        [[maybe_unused]] const T before = block_.slenderness;
        const Mask is_plus = now_.side > 0;
        block_ =
            combined([&](const T& plus, const T& minus) { return select<T>(is_plus, plus, minus); },
                     from_plus_, from_plus_.turned());
        if constexpr (outputs.peak) {
            T& peak = end_of_run_.peak;
            peak = peak * (block_.slenderness / before);
        }
        rate_ratio_ = block_.rate_ratio();
        excitation_.frequency = frequency_ / block_.pace;
        fastest_series_ = fastest_bounce_series(block_, excitation_);
        stepper_.see_side(block_, excitation_.frequency);
        see_side();
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
        if constexpr (may_watch) {
            if (watch_) {
                const Mask series = lanes && (rests || followed_);
                rests = any<T>(series) ? ends_series(series, after.rate) : series;
                followed_ = (followed_ || series) && !rests;
            }
        }
        if constexpr (outputs.error) {
            margin_error_.pass_impact(block_, excitation_, now_, counted, dies_out);
        }
        // For filling, which is for pulses only.
        if constexpr (outputs.peak && !is_recorded) {
            const T push = now_.side * excitation_.ground(now_.phase);
            const Mask outward = Equations<theory>::acceleration(block_, T(0), push) > 0;
            T& softest = end_of_run_.softest_impact;
            softest = select<T>(counted && !dies_out && outward && -now_.rate < softest, -now_.rate,
                                softest);
            T& last = end_of_run_.last_impact;
            last = select<T>(counted && !dies_out, -now_.rate, last);
        }
        now_.rate = select<T>(lanes, after.rate, now_.rate);
        now_.side = select<T>(lanes, after.side, now_.side);
        if constexpr (outputs.impacts) {
            T& impacts = end_of_run_.impacts;
            impacts = select<T>(counted, impacts + 1, impacts);
        }
        if (is_two_sided_) {
            change_sides();
        }
        record(EventKind::impact, lanes);
        record(EventKind::rest, rests);
        end_of_run_.rested = end_of_run_.rested || dies_out;
        if constexpr (outputs.error) {
            if (any<T>(dies_out)) {
                margin_error_.forget(dies_out);
            }
        }
        if (any<T>(rests)) {
            wait_for_uplift(rests);
        }
        if_watched([&](auto& watch) { watch.turn(estimate_of(now_.side)); });
        stepper_.turn(now_, lanes && active_);
        if constexpr (outputs.error) {
            if (uncertain_impact_ == UncertainImpact::stop) {
                finish(active_ && margin_error_.is_doubtful());
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
    const T frequency_;        // of the motion, in the unit of Block::pace
    T side_at_rest_;           // that of the higher barrier: the margin is smaller there
    T rate_ratio_;             // of an impact on the side on which the block rocks
    T fastest_series_;

    [[no_unique_address]] OnlyIf<may_watch, std::optional<ContactWatch<E>>> watch_;
    [[no_unique_address]] OnlyIf<may_watch, Mask> followed_; // see but_followed()
    [[no_unique_address]] OnlyIf<outputs.error, MarginError<theory, T>> margin_error_;
    [[no_unique_address]] OnlyIf<outputs.events, std::vector<Event<T>>> events_;
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
