// Integrates the motion of a rocking block (Eq. 47) by Dormand-Prince 5(4). An event within a step
// is found on the dense output; the step is then repeated so that it ends at the event.
#pragma once

#include "overturn/integrate/first_event.hpp"
#include "overturn/integrate/observers/contact_observer.hpp"
#include "overturn/mechanics/pulse_excitation.hpp"

namespace overturn {

/// tolerance: largest local error per step of tilt and rate, over the size of the motion [1].
template <Theory theory, Number T, Outputs outputs = Outputs{}>
class RungeKuttaStepper {
    using S = scalar_t<T>;
    using Mask = mask_t<T>;
    /// The largest change of phase of the fastest harmonic over a step whose error can be
    /// estimated [rad].
    static constexpr double longest_angle = 2;

public:
    RungeKuttaStepper(const Block<T>& block, const PulseExcitation<T>& excitation,
                      const S& tolerance)
        : excitation_(excitation), is_wavelet_(excitation.motion.is_wavelet()),
          tolerance_(tolerance)
    {
        set_side(block, excitation.frequency);
        step_size_ = first_step_;
        if constexpr (outputs.error) {
            embedded_share_ = 8 * rough_power_of_two(rough_log2(tolerance_) * T(S(2) / 5));
        }
    }

    /// Before lift() or turn().
    void set_side(const Block<T>& block, const T& frequency)
    {
        side_ = block;
        excitation_.frequency = frequency;
        const T fastest = select<T>(frequency > 1, frequency, 1);
        first_step_ = step_error_power(tolerance_) / fastest;
        if (is_wavelet_) {
            longest_seen_ = T(longest_angle) / frequency;
            const T negligible = tolerance_ * T(S(1) / 128) * side_.slenderness;
            tail_end_ =
                end_of_tail(excitation_.motion.pulse,
                            rough_log2(negligible) - rough_log2(abs(excitation_.acceleration)));
        }
    }

    /// The step size is reset.
    void lift(const Rocking<T>& now, const Mask& lanes)
    {
        step_size_ = select<T>(lanes, first_step_, step_size_);
        turn(now, lanes);
    }

    void turn(const Rocking<T>& now, const Mask& lanes)
    {
        const T push = now.side * excitation_.ground(now.phase);
        const T acceleration = Equations<theory>::acceleration(side_, now.tilt, push);
        acceleration_ = select<T>(lanes, acceleration, acceleration_);
        if constexpr (outputs.error) {
            remember(sample(now.side, now.tilt, now.rate, now.phase, now.phase), lanes);
        }
    }

    auto step(const Rocking<T>& now, const Mask& active, [[maybe_unused]] const auto& so_far,
              [[maybe_unused]] const auto& observe)
    {
        const T end_of_piece = excitation_.motion.end_of_piece(now.phase);
        const T left = (end_of_piece - now.phase) / excitation_.frequency;
        const T longest = longest_step(now);
        const Mask last = !ends_at_event_ && longest >= left;
        const T h = select<T>(ends_at_event_, step_to_event_, select<T>(last, left, longest));
        const T phase_step = h * excitation_.frequency;
        const StepMotion<T> start{now.tilt, now.rate, acceleration_};
        const Step<T> step = trial_step(start, h, now, phase_step);
        const T error = relative_error(step, h);
        const Mask accepted = error <= 1;

        const Mask checked = active && accepted && !ends_at_event_;
        const Mask event = checked && find_event(start, step, h, checked);
        const Mask moved = active && accepted && !event;
        acceleration_ = select<T>(moved, step.end.acceleration, acceleration_);
        // A step that ends at an event does not change the step size.
        const T resized = h * step_size_factor(error);
        const Mask resize = active && !event && !(ends_at_event_ && accepted);
        step_size_ = select<T>(resize && !(last && accepted), resized, step_size_);

        const Mask arrived = moved && ends_at_event_;
        ends_at_event_ = event;
        const Mask finite = h * (step.end.position - step.end.position) == 0;
        StepEnd<T, outputs> end;
        end.phase = select<T>(last, end_of_piece, now.phase + phase_step);
        end.tilt = step.end.position;
        end.rate = step.end.rate;
        end.moved = moved;
        end.strikes = arrived && !arrived;
        end.falls = arrived && !arrived;
        end.broken = active && !finite && h < first_step_ * 0x1p-60;
        T delay(0);
        if (any<T>(arrived)) {
            const Mask flat = towards_fall_ > 0;
            const StepEvent<T> at_end = event_near<T>({h, arrived && !flat, arrived && flat},
                                                      {end.tilt, end.rate, acceleration_});
            move_to(at_end, end, excitation_);
            delay = at_end.delay;
        }
        if constexpr (outputs.error) {
            const T phase = now.phase + phase_step;
            const auto end_on = [&](const T& piece) { // the jerk is different on the next piece
                return sample(now.side, step.end.position, step.end.rate, phase, piece);
            };
            const Sample last_sample = end_on(now.phase);
            end.errors = errors(now, {start, step, h}, delay, last_sample);
            remember(last_sample, moved);
            if (excitation_.motion.has_kink()) {
                remember(end_on(end.phase), moved);
            }
        }
        if constexpr (outputs.contact) {
            if (any<T>(moved)) {
                observe.template operator()<halvings>(
                    end, moved, observed_step({start, step, h}, now, end, phase_step));
            }
        }
        if constexpr (outputs.peak) {
            end.extremes = extremes({start, step, h}, end, so_far, moved && !arrived);
        }
        return end;
    }

private:
    /// The step size from the step size control. Before the tail of a wavelet, it is limited to a
    /// phase difference that resolves the lobes: a step across the whole tail would find the
    /// wavelet flat at every node.
    T longest_step(const Rocking<T>& now) const
    {
        return is_wavelet_ ? lesser<T>(step_size_,
                                       select<T>(now.phase < tail_end_, longest_seen_, step_size_))
                           : step_size_;
    }

    /// A step with its beginning and its length. With copies instead of references, steps take a
    /// quarter longer.
    struct TrialStep {
        const StepMotion<T>& start;
        const Step<T>& step;
        const T& length;
    };

    static constexpr int halvings = 1; // of a step that the contact sees

    auto observed_step(const TrialStep& trial, const Rocking<T>& now, const auto& end,
                       const T& phase_step) const
    {
        const auto moving = [&](const T& tilt, const T& rate, const T& phase) {
            return moving_block(excitation_, {phase, tilt, rate, now.side}, now.phase);
        };
        const Quintic<T> tilt = dense_output(trial.start, trial.step.end, trial.length);
        const T per_step = 1 / select<T>(trial.length > 0, trial.length, 1);
        return ObservedStep{T((end.phase - now.phase) / excitation_.frequency),
                            T(0),
                            !excitation_.motion.has_kink(),
                            [=, &now] { return moving(now.tilt, now.rate, now.phase); },
                            [=, &end] { return moving(end.tilt, end.rate, end.phase); },
                            [=, &now, &phase_step](const T& share) {
                                const StepMotion<T> motion = motion_at(tilt, share);
                                return moving(motion.position, motion.rate * per_step,
                                              fma(share, phase_step, now.phase));
                            },
                            [=](const T& share) { return motion_at(tilt, share).position; }};
    }

    /// The stages are compiled for each pulse. Computing the pushes before the stages, or selecting
    /// the pulse in each stage, costs a tenth more, because it prevents overlapping execution.
    Step<T> trial_step(const StepMotion<T>& start, const T& h, const Rocking<T>& now,
                       const T& phase_step) const
    {
        return excitation_.motion.with_formula([&](const auto& formula) {
            return runge_kutta_step(start, h, [&](std::size_t stage, const T& tilt) {
                const T phase =
                    fma(T(DormandPrince::node[stage].template in<S>()), phase_step, now.phase);
                const T push = now.side * (excitation_.acceleration * formula.value(phase));
                return Equations<theory>::acceleration(side_, tilt, push);
            });
        });
    }

    /// turning: the lanes in which the turns of the step count.
    StepExtremes<T> extremes(const TrialStep& trial, const StepEnd<T, outputs>& end,
                             const auto& so_far, const Mask& turning) const
    {
        const auto& [start, step, h] = trial;
        const Quintic<T> tilt = dense_output(start, step.end, h);
        const auto at = [&](const T& share) { return motion_at(tilt, share); };
        const auto per_step = [&](const StepMotion<T>& motion) -> StepMotion<T> {
            return {motion.position, motion.rate * h, motion.acceleration * h * h};
        };
        const TurnsInStep<T> turns(per_step(start), per_step(step.end), T(1));
        return {highest_tilt<T>(start.position, end.tilt, upper_bound(tilt), so_far.peak, at),
                lowest_turn<T>(turns, lower_bound(tilt), so_far.lowest_turn, turning, at)};
    }

    /// Local error over the allowed error. The latter is the tolerance times the size of the
    /// motion, at most alpha, plus the round-off of the motion and of an acceleration of order
    /// alpha over the step. If the size were always alpha, a block lifted by a millionth of alpha
    /// would strike with a speed that is wrong by 1e-6 at a tolerance of 1e-10, and a series of
    /// bounces would propagate this error.
    T relative_error(const Step<T>& step, const T& h) const
    {
        const T& alpha = side_.slenderness;
        const T tilt = abs(step.end.position);
        const T rate = abs(step.end.rate);
        const T size = lesser<T>(tilt + rate, alpha);
        const T round_off = T(16 * std::numeric_limits<S>::epsilon()) * fma(alpha, h, tilt + rate);
        const T allowed = fma(tolerance_, size, round_off);
        const T position_error = abs(step.position_error);
        const T rate_error = abs(step.rate_error);
        // Written so that NaN propagates.
        const T error = select<T>(position_error < rate_error, rate_error,
                                  position_error + (rate_error - rate_error));
        return error / allowed;
    }

    /// The terms of the equation of motion at one point.
    struct Sample {
        T acceleration = T(0);
        T jerk = T(0); // derivative of the acceleration with respect to tau, along the motion
        T stiffness = T(0);
    };

    /// At a phase of the smooth piece that contains or begins at the phase `on`.
    Sample sample(const T& side, const T& tilt, const T& rate, const T& phase, const T& on) const
    {
        const auto push = excitation_.motion.template series<2>(side * excitation_.acceleration,
                                                                phase, excitation_.frequency, on);
        const T stiffness = Equations<theory>::stiffness(side_, tilt, push[0]);
        const T lever = Equations<theory>::lever(side_, tilt);
        return {Equations<theory>::acceleration(side_, tilt, push[0]),
                fma(stiffness, rate, -push[1] * lever), stiffness};
    }

    void remember(const Sample& sample, const Mask& lanes)
    {
        sample_.acceleration = select<T>(lanes, sample.acceleration, sample_.acceleration);
        sample_.jerk = select<T>(lanes, sample.jerk, sample_.jerk);
        sample_.stiffness = select<T>(lanes, sample.stiffness, sample_.stiffness);
    }

    /// Compares the step with the integrals of its acceleration, by a formula of order 6 from the
    /// accelerations at its ends and, on its dense output, in the middle, and the jerks at its
    /// ends:
    ///
    ///     int a dt = h (7 a0 + 16 am + 7 a1) / 30 + h^2 (j0 - j1) / 60
    ///     int (h - t) a dt = h^2 (13 a0 + 16 am + a1) / 60 + h^3 j0 / 60
    ///
    /// The difference is the error of the solution of order 5, plus a smaller error of the formula.
    /// The latter is covered by a share of the embedded estimate e, an error of order 5; the share
    /// is of order 7, because (e / size)^(2/5) is proportional to h^2. Twice the sum covers the
    /// additional error of longer steps; for steps with a phase difference above 2, the error is
    /// unknown. In 4 of 10^6 points, the bound was too small, by a factor of up to two.
    ///
    /// delay: time from the end of the step to the event. If the variation did not include it,
    /// errors of the time would become errors of the energy at each of thousands of bounces.
    StepErrors<T> errors(const Rocking<T>& now, const TrialStep& trial, const T& delay,
                         const Sample& last) const
    {
        const auto& [start, step, h] = trial;
        const StepMotion<T>& end = step.end;
        const Quintic<T> tilt = dense_output(start, end, h);
        const T middle_tilt =
            ((tilt[0] + tilt[5]) + 5 * (tilt[1] + tilt[4]) + 10 * (tilt[2] + tilt[3])) *
            T(S(1) / 32);
        const T phase_step = excitation_.frequency * h;
        const Sample& first = sample_;
        const Sample middle =
            sample(now.side, middle_tilt, T(0), fma(phase_step, T(0.5), now.phase), now.phase);
        const T rate_gain = h * fma(T(S(7) / 30), first.acceleration + last.acceleration,
                                    fma(T(S(16) / 30), middle.acceleration,
                                        h * T(S(1) / 60) * (first.jerk - last.jerk)));
        const T tilt_gain = h * fma(h,
                                    fma(T(S(13) / 60), first.acceleration,
                                        fma(T(S(16) / 60), middle.acceleration,
                                            T(S(1) / 60) * fma(h, first.jerk, last.acceleration))),
                                    start.rate);
        const T tilt_error = abs((end.position - start.position) - tilt_gain);
        const T rate_error = abs((end.rate - start.rate) - rate_gain);
        // Where the push is linear or negligible, the length is measured in units of 1/p.
        const S& fastest = excitation_.motion.fastest;
        T length = fastest == 0 ? h : phase_step * T(fastest);
        if (is_wavelet_) {
            length = select<T>(now.phase < tail_end_, length, h);
        }
        const T longest(longest_variation);
        const T longest_length(1.001 * longest_angle); // allows for rounding
        const T unknown = select<T>(length > longest_length || h > longest, T(unknown_error<S>), 0);
        const T two(2);
        const auto tilt_at_turn = [&](const Mask& turns, const T& share) -> T {
            T s = select<T>(turns, share, 0);
            for (int i = 0; i < 3; ++i) { // Newton's method; the estimate alone would be too rough
                const Quintic<T> after = restricted<T>(tilt, s, 1);
                const T slope = after[1] - after[0];
                const T bend = 4 * (after[2] - after[1] - slope);
                const T next = s - (1 - s) * slope / select<T>(bend != 0, bend, 1);
                s = select<T>(turns && next > 0 && next < 1, next, s);
            }
            return restricted<T>(tilt, 0, s).back();
        };
        const TurnsInStep<T> turns(start, end, h);
        return {.variation = variation_over<T>(lesser<T>(h + delay, longest), first.stiffness,
                                               middle.stiffness, last.stiffness),
                .tilt = two * fma(embedded_share_, abs(step.position_error), tilt_error),
                .rate = fma(two, fma(embedded_share_, abs(step.rate_error), rate_error), unknown),
                .acceleration = last.acceleration,
                .turning_tilt = turning_tilt<T>(side_.slenderness, turns, lower_bound(tilt),
                                                upper_bound(tilt), tilt_at_turn)};
    }

    /// Finds the first impact or fall within an accepted step. In lanes with an event, the next
    /// step ends at it.
    Mask find_event(const StepMotion<T>& start, const Step<T>& step, const T& h, const Mask& lanes)
    {
        const T noise = dip_of_round_off(side_.slenderness, h);
        const Quintic<T> tilt = dense_output(start, step.end, h);
        const Mask suspect =
            lanes && (lower_bound(tilt) < -noise || T(pi<S>() / 2) - upper_bound(tilt) < -noise);
        return any<T>(suspect) ? aim_at_event(tilt, noise, h, suspect) : suspect;
    }

    [[gnu::noinline]] Mask aim_at_event(const Quintic<T>& tilt, const T& noise, const T& h,
                                        const Mask& suspect)
    {
        const FirstEvent<T> contact = first_contact<T>({tilt, T(0)}, noise, suspect);
        const Mask event = contact.strikes || contact.falls;
        step_to_event_ = select<T>(event, h * contact.time, step_to_event_);
        towards_fall_ = select<T>(event, select<T>(contact.falls, 1, 0), towards_fall_);
        return event;
    }

    BlockSide<T> side_;
    PulseExcitation<T> excitation_;
    const bool is_wavelet_;
    const T tolerance_;
    T first_step_;

    T acceleration_ = T(0); // at the beginning of the next step
    T step_size_; // next step, unless an event or the end of a smooth piece comes first [1/p]
    T step_to_event_ = T(0); // step that ends at an event found previously [1/p]
    T towards_fall_ = T(0);  // 1 if that event is the fall, 0 if it is an impact
    Mask ends_at_event_ = T(0) != T(0);
    T tail_end_ = T(0);     // phase after which a wavelet is negligible [rad]
    T longest_seen_ = T(0); // longest step that resolves a wavelet [1/p]

    [[no_unique_address]] OnlyIf<outputs.error, Sample>
        sample_; // at the beginning of the next step
    [[no_unique_address]] OnlyIf<outputs.error, T> embedded_share_; // see errors()
};

} // namespace overturn
