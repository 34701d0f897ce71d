// Integrates the motion of a rocking block (Eq. 47) under a pulse by Taylor series. The last four
// coefficients determine the step size. An event is a root of the series and ends the step. No step
// is repeated.
#pragma once

#include "overturn/integrate/first_event.hpp"
#include "overturn/integrate/observers/contact_observer.hpp"
#include "overturn/integrate/taylor_errors.hpp"
#include "overturn/mechanics/pulse_excitation.hpp"

namespace overturn {

/// order: of the series of the rate. tolerance: bound of its last terms at the end of a step, over
/// the size of the motion [1].
template <int order, Theory theory, Number T, Outputs outputs = Outputs{}>
class TaylorStepper {
    using S = scalar_t<T>;
    using E = estimate_t<T>;
    using Mask = mask_t<T>;
    using Series = RockingSeries<order, T>;
    static constexpr int last_terms = overturn::last_terms<order>;
    static constexpr int known_order = outputs.error ? order_for_errors<order, theory> : order;

public:
    TaylorStepper(const Block<T>& block, const PulseExcitation<T>& excitation, const S& tolerance)
        : excitation_(excitation), is_wavelet_(excitation.motion.is_wavelet()),
          tolerance_(tolerance), log2_tolerance_(rough_log2(tolerance_)),
          errors_(estimate_of(log2_tolerance_))
    {
        set_side(block, excitation.frequency);
    }

    void set_side(const Block<T>& block, const T& frequency)
    {
        side_ = block;
        excitation_.frequency = frequency;
        const T fastest = select<T>(frequency > 1, frequency, 1);
        time_ = {1 / fastest, fastest};
        phase_per_unit_ = frequency * time_.unit;
        log2_most_allowed_ = rough_log2(tolerance_ * side_.slenderness * time_.unit);
        if (is_wavelet_) {
            const T round_off = T(S(std::numeric_limits<S>::epsilon() / 1024)) * side_.slenderness;
            lost_ = end_of_tail(excitation_.motion.pulse,
                                rough_log2(round_off) - rough_log2(abs(excitation_.acceleration)));
        }
    }

    void lift(const Rocking<T>&, const Mask&) {}
    void turn(const Rocking<T>&, const Mask&) {}

    auto step(const Rocking<T>& now, const Mask& active, [[maybe_unused]] const auto& so_far,
              [[maybe_unused]] const auto& observe) const
    {
        const auto push =
            excitation_.template series<known_order>(acceleration(now), now.phase, phase_per_unit_);
        const auto known = Equations<theory>::template series<known_order>(
            side_, now.tilt, now.rate * time_.unit, push, time_.unit);
        decltype(auto) series = leading<order>(known);
        const T longest = longest_step(now, series);
        const T end_of_piece = excitation_.motion.end_of_piece(now.phase);
        const T left = (end_of_piece - now.phase) / phase_per_unit_;
        Mask last = longest >= left;
        T h = select<T>(last, left, longest);

        const Mask none = active && !active;
        FirstEvent<T> event{h, none, none};
        const Enclosure<T> bounds = enclosure(series.tilt, h);
        const T noise = dip_of_round_off(side_.slenderness, h * time_.unit);
        const Mask suspect = active && may_have_event<T>(bounds, noise);
        if (any<T>(suspect)) {
            event = first_event(series, bounds, h, noise, suspect);
            last = last && event.time == h;
            h = event.time;
        }
        const T tilt = value_of_series(series.tilt, h);
        const T rate = value_of_series(series.rate, h) * time_.per_time;
        StepEnd<T, outputs> end;
        end.phase = select<T>(last, end_of_piece, now.phase + h * phase_per_unit_);
        end.tilt = select<T>(tilt < 0, 0, tilt);
        end.rate = rate;
        end.moved = active;
        end.strikes = none;
        end.falls = none;
        end.broken = active && !((tilt - tilt) + (rate - rate) == 0);
        const Mask ends_at_event = event.strikes || event.falls;
        if (any<T>(ends_at_event)) {
            const T acceleration =
                slope_of_series(series.rate, h) * (time_.per_time * time_.per_time);
            const StepMotion<T> there{select<T>(ends_at_event, tilt, end.tilt), rate, acceleration};
            move_to(event_near(event, there), end, excitation_);
        }
        const TaylorStep<known_order, T> taken{known, time_, h, lower_bound(bounds.lower()),
                                               upper_bound(bounds.upper())};
        if constexpr (outputs.error) {
            E beyond = error_of_estimates(series, estimate_of(h));
            if (is_wavelet_) {
                beyond = beyond + estimate_of(left_out_of(push, now.phase, h));
            }
            end.errors = errors_.of(taken, side_, pushes_at(now, h, end.phase), end, beyond);
        }
        if constexpr (outputs.contact) {
            observe.template operator()<halvings>(end, active, observed_step(series, now, end, h));
        }
        if constexpr (outputs.peak) {
            end.extremes = extremes(taken, now, end, so_far);
        }
        return end;
    }

private:
    static constexpr int halvings = 2; // of a step that the contact sees

    auto observed_step(const Series& series, const Rocking<T>& now, const auto& end,
                       const T& h) const
    {
        const auto moving = [&](const T& tilt, const T& rate, const T& phase) {
            return moving_block(excitation_, {phase, tilt, rate, now.side}, now.phase);
        };
        return ObservedStep{
            T((end.phase - now.phase) / excitation_.frequency),
            T(0),
            !excitation_.motion.has_kink(),
            [=, &now] { return moving(now.tilt, now.rate, now.phase); },
            [=, &end] { return moving(end.tilt, end.rate, end.phase); },
            [=, &series, &now, &h, this](const T& share) {
                const T time = share * h;
                return moving(value_of_series(series.tilt, time),
                              value_of_series(series.rate, time) * time_.per_time,
                              fma(time, phase_per_unit_, now.phase));
            },
            [&series, &h](const T& share) { return value_of_series(series.tilt, T(share * h)); }};
    }

    StepExtremes<T> extremes(const TaylorStep<known_order, T>& step, const Rocking<T>& now,
                             const StepEnd<T, outputs>& end, const auto& so_far) const
    {
        decltype(auto) series = leading<order>(step.known);
        const T& h = step.h;
        const auto at = [&](const T& share) { return motion_at(series, h, share); };
        const T per_step = h * time_.unit;
        const TurnsInStep<T> turns(
            {now.tilt, now.rate * per_step, series.rate[1] * h * h},
            {end.tilt, end.rate * per_step, slope_of_series(series.rate, h) * h * h}, T(1));
        return {
            highest_tilt<T>(now.tilt, end.tilt, step.highest, so_far.peak, at),
            lowest_turn<T>(turns, step.lowest, so_far.lowest_turn, end.moved && !end.strikes, at)};
    }

    /// The excitation's `acceleration`, positive towards the side of the tilt; 0 once a wavelet
    /// is below the round-off of the acceleration of the block.
    T acceleration(const Rocking<T>& now) const
    {
        const T towards = now.side * excitation_.acceleration;
        return is_wavelet_ ? select<T>(now.phase < lost_, towards, 0) : towards;
    }

    /// The longest step, in units: for the last four n, rate[n] h^n is at most the tolerance times
    /// the size of the motion, which is the larger of tilt + |rate| at the beginning and at the
    /// end, but at most alpha; see RungeKuttaStepper.
    T longest_step(const Rocking<T>& now, const Series& series) const
    {
        const T start = now.tilt + abs(now.rate);
        const T allowed = rough_log2(tolerance_ * time_.unit * start);
        // From rest the rate grows to rate[1] h + rate[2] h^2, and h < 1.
        const T growth = abs(series.rate[1]) + abs(series.rate[2]);
        const T allowed_growing = log2_tolerance_ + rough_log2(growth);
        const auto log2_longest = [&]<int n>() -> T {
            const T last = rough_log2(abs(series.rate[n]));
            const T at_start = (allowed - last) * T(S(1) / n);
            const T growing = (allowed_growing - last) * T(S(1) / (n - 2));
            const T at_most = (log2_most_allowed_ - last) * T(S(1) / n);
            return lesser<T>(greater<T>(growing, at_start), at_most);
        };
        T longest = log2_longest.template operator()<order>();
        unrolled<last_terms - 1>([&]<int i>() {
            longest = lesser<T>(longest, log2_longest.template operator()<order - 1 - i>());
        });
        if (is_wavelet_) {
            // In the tail of a wavelet, the terms are small but grow; each must decrease by a
            // quarter.
            const T ratio =
                following_ratio<order>(excitation_.motion.pulse, now.phase, phase_per_unit_);
            const T falling = select<T>(now.phase < lost_, 0.75 / ratio, 0x1p+60);
            return lesser<T>(rough_power_of_two(longest), falling);
        }
        return rough_power_of_two(longest);
    }

    /// The push at the beginning, in the middle and at the end of a step of length h.
    std::array<T, 3> pushes_at(const Rocking<T>& now, const T& h, const T& end) const
    {
        const T middle = h * 0.5;
        std::array<T, 3> pushes = excitation_.ground(
            std::array<T, 3>{now.phase, now.phase + middle * phase_per_unit_, end});
        for (T& value : pushes) {
            value = now.side * value;
        }
        return pushes;
    }

    /// The contribution of the push of a wavelet to the rate beyond the known series: the term
    /// f[k] h^k adds f[k] h^(k+1) / (k + 1), and the terms decrease at least geometrically.
    T left_out_of(const Coefficients<known_order, T>& push, const T& phase, const T& h) const
    {
        constexpr int last = known_order - 1;
        T power = h;
        unrolled<last - 2>([&]<int>() { power = power * h; });
        const T ratio =
            following_ratio<known_order>(excitation_.motion.pulse, phase, phase_per_unit_ * h);
        const T term = greater<T>(abs(push[last]) * h, ratio * abs(push[last - 1])) * power;
        return term * ratio / (1 - ratio) * h * (time_.unit * time_.unit * T(S(1) / (last + 2)));
    }

    BlockSide<T> side_;
    PulseExcitation<T> excitation_;
    const bool is_wavelet_;
    const T tolerance_;
    const T log2_tolerance_;
    TimeUnit<T> time_; // 1/p, or 1/omega_p if that is shorter
    T phase_per_unit_; // [rad]
    T log2_most_allowed_;
    T lost_ = T(0); // see acceleration()
    [[no_unique_address]] OnlyIf<outputs.error, TaylorErrors<order, theory, T>> errors_;
};

} // namespace overturn
