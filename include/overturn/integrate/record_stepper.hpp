// Integrates the motion of a rocking block (Eq. 47) under a record, or a pulse that is given by a
// table, by Taylor series. The intervals between samples of a record are short: a step nearly
// always spans what is left of one. An event is a root of the series and ends the step. No step is
// repeated.
#pragma once

#include "overturn/integrate/first_event.hpp"
#include "overturn/integrate/observers/contact_observer.hpp"
#include "overturn/integrate/taylor_errors.hpp"
#include "overturn/mechanics/contact.hpp"
#include "overturn/mechanics/record_excitation.hpp"

namespace overturn {

/// Bounds over a step in which the tilt is between 0 and pi/2.
template <Number T>
struct StepBounds {
    T acceleration; ///< of |tilt''| [rad per unit^2]
    T jolt;         ///< of |tilt'''| [rad per unit^3]
};

/// A larger tolerance would gain 6 % of the time. With this one, the errors of most points are
/// those of round-off, and uncertain verdicts are few.
inline constexpr double loosest_record_tolerance = 1e-10;

/// order: of the series of the rate. tolerance: bound of its last terms at the end of a step,
/// relative to the size of the motion, or to alpha if that is smaller [1].
template <int order, Theory theory, Number T, Outputs outputs, class Excitation>
class RecordStepper {
    using S = scalar_t<T>;
    using E = estimate_t<T>; // for what is not the motion itself
    using Mask = mask_t<T>;
    using Series = RockingSeries<order, T>;
    static constexpr int last_terms = overturn::last_terms<order>;
    static constexpr int known_order = outputs.error ? order_for_errors<order, theory> : order;

public:
    RecordStepper(const Block<T>& block, const Excitation& excitation, const S& tolerance)
        : excitation_(excitation),
          tolerance_(double(tolerance) < loosest_record_tolerance ? tolerance
                                                                  : S(loosest_record_tolerance)),
          errors_(estimate_of(rough_log2(tolerance_)))
    {
        set_side(block, excitation.frequency);
    }

    void set_side(const Block<T>& block, const T& frequency)
    {
        side_ = block;
        excitation_.frequency = frequency;
        // Every sample of a record ends a step. If the reciprocal were rounded, the rate would
        // change by the same share of epsilon in each of thousands of steps, and the error would
        // exceed its bound, in which round-off is random.
        const T fastest = power_of_two_below(select<T>(frequency > 1, frequency, 1));
        time_ = {1 / fastest, fastest};
        phase_per_unit_ = frequency * time_.unit;
        units_per_phase_ = 1 / phase_per_unit_;
        most_allowed_ = estimate_of(tolerance_ * side_.slenderness * time_.unit);
    }

    void lift(const Rocking<T>&, const Mask&) {}
    void turn(const Rocking<T>&, const Mask&) {}

    auto step(const Rocking<T>& now, const Mask& active, [[maybe_unused]] const auto& so_far,
              [[maybe_unused]] const auto& observe) const
    {
        const auto piece = excitation_.motion.piece_at(now.phase);
        const T& end_of_piece = piece.end;
        const auto push =
            excitation_.push_on(piece, now.side * excitation_.acceleration, phase_per_unit_);
        const auto known = Equations<theory>::template series<known_order>(
            side_, now.tilt, now.rate * time_.unit, push, time_.unit);
        decltype(auto) series = leading<order>(known);
        const T left = (end_of_piece - now.phase) * units_per_phase_;
        T h = longest_step(now, series, left, active);
        const Mask none = active && !active;
        const StepBounds<T> bounds = bounds_over(series, push, h);
        const Mask suspect = active && may_have_event(series, bounds, h);
        const T tilt = value_of_series(series.tilt, h);
        const T rate = value_of_series(series.rate, h);
        StepEnd<T, outputs> end;
        end.phase = select<T>(h == left, end_of_piece, now.phase + h * phase_per_unit_);
        end.tilt = select<T>(tilt < 0, 0, tilt);
        end.rate = rate * time_.per_time;
        end.moved = active;
        end.strikes = none;
        end.falls = none;
        end.broken = none;
        if (any<T>(suspect)) {
            const StepEvent<T> event =
                first_event_within(series, bounds, {h, T(0), tilt, rate, none, none}, suspect);
            h = event.time;
            const T phase = now.phase + (h + event.delay) * phase_per_unit_;
            end.phase = select<T>(h == left && !event.happens(), end_of_piece,
                                  lesser<T>(phase, end_of_piece));
            end.tilt = select<T>(event.tilt < 0, 0, event.tilt);
            end.rate = event.rate * time_.per_time;
            end.strikes = event.strikes;
            end.falls = event.falls;
            end.broken = active && !((tilt - tilt) + (rate - rate) == 0);
        }
        // The tilt is nowhere farther from its values at both ends.
        const T aside = bounds.acceleration * h * h * T(S(1) / 8);
        const T highest = greater<T>(now.tilt, end.tilt) + aside;
        if constexpr (outputs.error) {
            const TaylorStep<known_order, T> step{known, time_, h,
                                                  lesser<T>(now.tilt, end.tilt) - aside, highest};
            const std::array pushes{push.at(T(0)), push.at(h * 0.5), push.at(h)};
            end.errors =
                errors_.of(step, side_, pushes, end, error_of_estimates(series, estimate_of(h)));
        }
        if constexpr (outputs.contact) {
            observe.template operator()<0>(end, active, observed_step(series, push, now, end));
        }
        if constexpr (outputs.peak) {
            const auto& rough = estimate_of(series);
            const E length = estimate_of(h);
            const auto at = [&](const E& share) { return motion_at(rough, length, share); };
            const E peak = highest_tilt<E>(estimate_of(now.tilt), estimate_of(end.tilt),
                                           estimate_of(highest), estimate_of(so_far.peak), at);
            end.extremes = {T(peak), T(std::numeric_limits<S>::infinity())};
        }
        return end;
    }

private:
    auto observed_step(const Series& series, const auto& push, const Rocking<T>& now,
                       const auto& end) const
    {
        const E per_unit = estimate_of(time_.per_time);
        const E length = estimate_of((end.phase - now.phase) * units_per_phase_);
        const auto moving = [pushes = estimate_of(push), per_unit](const E& tilt, const E& rate,
                                                                   const E& time) {
            const auto ground = pushes.at(time);
            return MovingBlock<E, std::remove_cvref_t<decltype(ground)>>{
                tilt, rate, ground, pushes.slope_over(per_unit)};
        };
        const auto slope = moving(E(0), E(0), E(0)).push_slope;
        return ObservedStep{
            length * estimate_of(time_.unit),
            E(abs(horizontal_of(slope)) + abs(gravity_of(slope, E(0)))),
            false,
            [=, &now] { return moving(estimate_of(now.tilt), estimate_of(now.rate), E(0)); },
            [=, &end] { return moving(estimate_of(end.tilt), estimate_of(end.rate), length); },
            [=, rough = estimate_of(series)](const E& share) {
                const E time = share * length;
                return moving(value_of_series(rough.tilt, time),
                              value_of_series(rough.rate, time) * per_unit, time);
            },
            [&series, length](const E& share) {
                return value_of_series(estimate_of(series).tilt, E(share * length));
            }};
    }

    /// The longest step, in units, of at most `left`: for the last n, rate[n] h^n is at most
    /// the tolerance times the size of the motion, which is the larger of tilt + |rate| at the
    /// beginning and at the end, but at most alpha; see RungeKuttaStepper.
    T longest_step(const Rocking<T>& now, const Series& series, const T& left,
                   const Mask& active) const
    {
        const E tolerance = estimate_of(tolerance_);
        const E speed = estimate_of(abs(now.rate));
        const E at_start = tolerance * estimate_of(time_.unit) * (estimate_of(now.tilt) + speed);
        const auto size_of = [&](int k) -> E { return abs(estimate_of(series.rate[k])); };
        // From rest the rate grows to rate[1] h + rate[2] h^2. This is larger than what follows if
        // h <= 1; otherwise tilt and rate are at least half of it.
        const E growth = tolerance * (size_of(1) + size_of(2));
        // The series of other lanes need not converge.
        T length = select<T>(active, left, lesser<T>(left, 1));
        while (true) {
            const E h = estimate_of(length);
            E term = size_of(order);
            unrolled<last_terms - 1>(
                [&]<int i>() { term = greater<E>(term * h, size_of(order - 1 - i)); });
            const E allowed = lesser<E>(greater<E>(at_start, growth * (h * h)), most_allowed_);
            E largest = term * power<order + 1 - last_terms>(h);
            if constexpr (full_terms<T, order + 1> <= order) {
                largest = greater<E>(largest, error_of_estimates(series, h));
            }
            const Mask too_long = active && largest > allowed;
            if (!any<T>(too_long)) {
                return length;
            }
            length = select<T>(too_long, length * 0.5, length);
        }
    }

    /// With the tilt x, y = x - alpha, the gravity g and the push B, both linear in time,
    ///
    ///     |x''| <= |g| |y| + |B|,   |x'''| <= (|g| + |B|) |x'| + |g'| |y| + |B'|
    StepBounds<T> bounds_over(const Series& series, const auto& push, const T& h) const
    {
        const T square = time_.unit * time_.unit;
        const auto largest = [&](const Ramp<T>& ramp) -> T {
            return greater<T>(abs(ramp.start), abs(ramp.at(h)));
        };
        static_assert(Equations<theory>::moment_is_at_most_distance);
        const auto& horizontal = horizontal_of(push);
        const T pushed = largest(horizontal);
        T gravity(1);
        if constexpr (has_gravity<std::remove_cvref_t<decltype(push)>>) {
            gravity = largest(push.gravity);
        }
        const T speed = abs(series.rate[0]);
        const T stiffness = square * (gravity + pushed);
        // |y| <= 1 would do for the sine; this is closer, and it also holds in the linear theory.
        const T highest = fma(fma(stiffness, h, speed), h, series.tilt[0]);
        const T farthest = greater<T>(side_.slenderness, highest - side_.slenderness);
        const T acceleration = square * fma(gravity, farthest, pushed);
        T change = abs(horizontal.slope);
        if constexpr (has_gravity<std::remove_cvref_t<decltype(push)>>) {
            change = fma(abs(push.gravity.slope), farthest, change);
        }
        return {acceleration, fma(stiffness, fma(acceleration, h, speed), square * change)};
    }

    /// The lanes in which the block may strike the ground or reach pi/2 within the step.
    static Mask may_have_event(const Series& series, const StepBounds<T>& bounds, const T& h)
    {
        const T straight = fma(series.rate[0], h, series.tilt[0]);
        const T aside = bounds.acceleration * (h * h) * 0.5;
        return !(straight >= aside && straight + aside <= T(pi<S>() / 2));
    }

    /// The first impact or fall within a step, in the lanes in which there may be one. event: at
    /// the end of the whole step.
    ///
    /// If the tilt decreases throughout the step, or if it accelerates towards the ground, it falls
    /// below 0 once, if it is below 0 at the end. A lane in which neither is certain, or that may
    /// reach pi/2, is left to first_event().
    StepEvent<T> first_event_within(const Series& series, const StepBounds<T>& bounds,
                                    StepEvent<T> event, const Mask& suspect) const
    {
        const T h = event.time;
        const T noise = dip_of_round_off(side_.slenderness, h * time_.unit);
        const T& start = series.rate[0];
        const StepMotion<T> end{event.tilt, event.rate, slope_of_series(series.rate, h)};
        // A function is nowhere larger than the mean of its values at both ends and of h / 2 times
        // the bound of its slope.
        const Mask concave = series.rate[1] + end.acceleration + bounds.jolt * h < 0;
        const Mask sinks = start + end.rate + bounds.acceleration * h < 0;
        const T aside = bounds.acceleration * (h * h) * 0.5;
        const Mask low = series.tilt[0] + start * h + aside < T(pi<S>() / 2);
        const Mask simple =
            suspect && low && (concave || sinks) && (series.tilt[0] > 0 || start > 0);
        event.strikes = simple && end.position < -noise;
        Mask odd = suspect && !simple;
        if (any<T>(event.strikes)) {
            const Mask missed = approach_ground(series, bounds, end, event);
            odd = odd || missed;
        }
        if (any<T>(odd)) {
            search(series, h, noise, odd, event);
        }
        return event;
    }

    /// Finds the impact in the lanes that strike: by Halley's method, first of the leading terms of
    /// the series, until Newton's correction to second order is accurate: the error of its rate is
    /// at most jolt delay^2 / 2, that of its delay jolt |delay|^3 / (6 rate). Returns the lanes in
    /// which this fails. end: the motion at the end of the step.
    Mask approach_ground(const Series& series, const StepBounds<T>& bounds,
                         const StepMotion<T>& end, StepEvent<T>& event) const
    {
        const T h = event.time;
        const RockingSeries<4, E> rough = leading<4>(estimate_of(series));
        const auto nearer = [&](const E& time, const StepMotion<E>& at) -> E {
            const E square = fma(at.rate, at.rate, -0.5 * at.position * at.acceleration);
            const E halley = time - at.position * at.rate / square;
            return lesser<E>(greater<E>(halley, 0), estimate_of(h));
        };
        E guess = nearer(estimate_of(h), {estimate_of(end.position), estimate_of(end.rate),
                                          estimate_of(end.acceleration)});
        for (int i = 0; i < 2; ++i) {
            guess = nearer(guess, motion_at(rough, guess));
        }
        const auto within = [&](const T& time) { return lesser<T>(greater<T>(time, 0), h); };
        T time = within(T(guess));
        const T enough(2 * std::numeric_limits<S>::epsilon());
        Mask open = event.strikes;
        constexpr int most_passes = 6;
        for (int pass = 0; pass < most_passes; ++pass) {
            const StepMotion<T> now = motion_at(series, time);
            const EventCorrection<T> found = event_correction(now);
            const Mask close = open && now.rate < 0 &&
                               bounds.jolt * found.delay * found.delay <= enough * found.closing;
            event.time = select<T>(close, time, event.time);
            event.delay = select<T>(close, found.delay, event.delay);
            event.rate = select<T>(close, -found.closing, event.rate);
            event.tilt = select<T>(close, 0, event.tilt);
            open = open && !close;
            if (!any<T>(open)) {
                break;
            }
            time = within(time + found.delay);
        }
        event.strikes = event.strikes && !open;
        return open;
    }

    [[gnu::noinline]] void search(const Series& series, const T& h, const T& noise,
                                  const Mask& lanes, StepEvent<T>& event) const
    {
        straight_line<T>([&] {
            const auto first = first_event(series, enclosure(series.tilt, h), h, noise, lanes);
            const StepEvent<T> found = event_near(first, motion_at(series, first.time));
            event.time = select<T>(lanes, found.time, event.time);
            event.delay = select<T>(lanes, found.delay, event.delay);
            event.tilt = select<T>(lanes, found.tilt, event.tilt);
            event.rate = select<T>(lanes, found.rate, event.rate);
            event.strikes = event.strikes || (lanes && found.strikes);
            event.falls = lanes && found.falls;
        });
    }

    BlockSide<T> side_;
    Excitation excitation_;
    const T tolerance_;
    TimeUnit<T> time_; // a power of two: 1/p, or about the phase 1 if that is shorter
    T phase_per_unit_;
    T units_per_phase_;
    E most_allowed_;
    [[no_unique_address]] OnlyIf<outputs.error, TaylorErrors<order, theory, T>> errors_;
};

} // namespace overturn
