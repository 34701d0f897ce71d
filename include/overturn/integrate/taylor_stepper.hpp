// Integrates the motion of a rocking block (Eq. 47) by Taylor series. The last four coefficients
// determine the step size. An event is a root of the series and ends the step. No step is repeated.
#pragma once

#include "overturn/integrate/first_event.hpp"
#include "overturn/integrate/first_root.hpp"
#include "overturn/integrate/power_series.hpp"
#include "overturn/integrate/rocking_step.hpp"
#include "overturn/mechanics/pulse_excitation.hpp"
#include "overturn/mechanics/rocking_series.hpp"
#include "overturn/mechanics/wavelet.hpp"

namespace overturn {

/// order: of the series of the rate. tolerance: bound of its last terms at the end of a step, over
/// the size of the motion [1].
template <int order, Theory theory, Number T, Outputs outputs = Outputs{},
          class Excitation = PulseExcitation<T>>
class TaylorStepper {
    using S = scalar_t<T>;
    using Mask = mask_t<T>;
    using Series = RockingSeries<order, T>;
    /// The number of last terms that determine the step size. Two terms may both be small by
    /// chance: for an even push from rest, every other term is 0, and the one between may be small.
    /// With four terms, errors are up to ten times smaller at the same tolerance; two and four take
    /// the same time for the same largest error.
    static constexpr int last_terms = 4;
    static constexpr bool may_be_wavelet = decltype(Excitation::motion)::may_be_wavelet;
    /// The order to which the series is known if the error is an output. In the linear theory, a
    /// term is almost free.
    static constexpr int known_order =
        !outputs.error ? order : order + (theory == Theory::linear ? 3 : 1);
    using KnownSeries = RockingSeries<known_order, T>;

public:
    TaylorStepper(const Block<T>& block, const Excitation& excitation, const S& tolerance)
        : excitation_(excitation), is_wavelet_(excitation.motion.is_wavelet()),
          tolerance_(tolerance), log2_tolerance_(rough_log2(tolerance_))
    {
        const T one(S(1));
        see_side(block, excitation.frequency);
        if constexpr (outputs.error) {
            unrolled<last_terms>([&]<int i>() {
                constexpr int k = order + 1 - last_terms + i;
                T ratio = rough_power_of_two(T(log2_tolerance_ * T(S(1) / k)));
                if constexpr (theory == Theory::linear) {
                    ratio = lesser<T>(ratio, T(S(1) / 3));
                }
                following_per_[i] = T(S(2)) / (one - ratio);
                unrolled<known_order + 1 - k>(
                    [&]<int>() { following_per_[i] = following_per_[i] * ratio; });
            });
        }
    }

    /// The blocks rock on other sides, of which these are the properties.
    void see_side(const Block<T>& block, const T& frequency)
    {
        using std::abs;
        const T one(S(1));
        slenderness_ = block.slenderness;
        excitation_.frequency = frequency;
        fastest_ = select<T>(frequency > one, frequency, one);
        if constexpr (!std::same_as<Excitation, PulseExcitation<T>>) {
            // Every sample of a record ends a step. If the reciprocal were rounded, the rate would
            // change by the same share of epsilon in each of thousands of steps, and the error
            // would exceed its bound, in which round-off is random.
            fastest_ = power_of_two_below(fastest_);
        }
        unit_ = one / fastest_;
        phase_per_unit_ = frequency * unit_;
        log2_most_allowed_ = rough_log2(T(tolerance_ * slenderness_ * unit_));
        if constexpr (may_be_wavelet) {
            if (!is_wavelet_) {
                return;
            }
            const T round_off = T(S(std::numeric_limits<S>::epsilon() / 1024)) * slenderness_;
            lost_ = end_of_tail(
                excitation_.motion.pulse,
                T(rough_log2(round_off) - rough_log2(T(abs(excitation_.acceleration)))));
        }
    }

    void lift(const Rocking<T>&, const Mask&) {}
    void turn(const Rocking<T>&, const Mask&) {}

    /// One step in every lane; the results of inactive lanes are meaningless. so_far: peak and
    /// lowest turn of the previous steps, if they are outputs.
    auto step(const Rocking<T>& now, const Mask& active, [[maybe_unused]] const auto& so_far) const
    {
        const auto push =
            excitation_.template series<known_order>(acceleration(now), now.phase, phase_per_unit_);
        const auto known = rocking_series<theory, known_order>(now.tilt, T(now.rate * unit_),
                                                               slenderness_, push, unit_);
        const Series series = leading<order>(known);
        const T longest = longest_step(now, series);
        const T end_of_piece = excitation_.motion.end_of_piece(now.phase);
        const T left = (end_of_piece - now.phase) / phase_per_unit_;
        Mask last = longest >= left;
        T h = select<T>(last, left, longest);

        const Mask none = active && !active;
        FirstEvent<T> event{h, none, none};
        const Enclosure<T> bounds = enclosure(series.tilt, h);
        const T noise = dip_of_round_off(slenderness_, T(h * unit_));
        const Mask suspect = active && may_meet<T>(bounds, noise);
        if (any<T>(suspect)) {
            event = first_event_not_inlined(series, bounds, h, noise, suspect);
            last = last && event.time == h;
            h = event.time;
        }
        const T zero(S(0));
        const T tilt = value_of_series(series.tilt, h);
        const T rate = value_of_series(series.rate, h) * fastest_;
        StepEnd<T> end{.phase = select<T>(last, end_of_piece, now.phase + h * phase_per_unit_),
                       .tilt = select<T>(tilt < zero, zero, tilt),
                       .rate = rate,
                       .moved = active,
                       .strikes = none,
                       .falls = none,
                       .broken = active && !((tilt - tilt) + (rate - rate) == zero)};
        const Mask ends_at_event = event.strikes || event.falls;
        if (any<T>(ends_at_event)) {
            end.tilt = select<T>(ends_at_event, tilt, end.tilt);
            move_to_event(end, event.strikes, event.falls,
                          T(slope_of_series(series.rate, h) * (fastest_ * fastest_)), excitation_);
        }
        if constexpr (outputs.error) {
            return StepEndWithErrors<T>{end, errors(now, {known, bounds, h}, push, end)};
        } else if constexpr (outputs.peak) {
            const auto sample_at = [&](const T& share) { return sample_of(series, h, share); };
            const T per_step = h * unit_;
            const TurnsInStep<T> turns(
                {now.rate * per_step, series.rate[1] * h * h},
                {end.rate * per_step, slope_of_series(series.rate, h) * h * h}, T(S(1)));
            return StepEndWithPeak<T>{
                end,
                highest_tilt<T>(now.tilt, end.tilt, upper_bound(bounds.upper()), so_far.peak,
                                sample_at),
                lowest_turn<T>(turns, lower_bound(bounds.lower()), so_far.lowest_turn,
                               active && !end.strikes, sample_at)};
        } else {
            return end;
        }
    }

private:
    /// The motion within a step of this length.
    struct Motion {
        const KnownSeries& known;
        const Enclosure<T>& bounds; ///< of the tilt
        const T& length;
    };

    /// The motion at a share of a step of length h.
    static MotionSample<T> sample_of(const Series& series, const T& h, const T& share)
    {
        const T time = share * h;
        return {value_of_series(series.tilt, time), value_of_series(series.rate, time) * h,
                slope_of_series(series.rate, time) * h * h};
    }

    /// The excitation's `acceleration`, positive towards the side of the tilt; 0 once a wavelet
    /// is below the round-off of the acceleration of the block.
    T acceleration(const Rocking<T>& now) const
    {
        const T towards = now.side * excitation_.acceleration;
        return is_wavelet_ ? select<T>(now.phase < lost_, towards, T(S(0))) : towards;
    }

    /// The longest step, in units: for the last four n, rate[n] h^n is at most the tolerance times
    /// the size of the motion, which is the larger of tilt + |rate| at the beginning and at the
    /// end, but at most alpha; see RungeKuttaStepper.
    T longest_step(const Rocking<T>& now, const Series& series) const
    {
        using std::abs;
        const T start = now.tilt + abs(now.rate);
        const T allowed = rough_log2(T(tolerance_ * unit_ * start));
        // From rest the rate grows to rate[1] h + rate[2] h^2, and h < 1.
        const T growth = abs(series.rate[1]) + abs(series.rate[2]);
        const T allowed_growing = log2_tolerance_ + rough_log2(growth);
        const auto log2_longest = [&]<int n>() -> T {
            const T last = rough_log2(T(abs(series.rate[n])));
            const T at_start = (allowed - last) * T(S(1) / n);
            const T growing = (allowed_growing - last) * T(S(1) / (n - 2));
            const T at_most = (log2_most_allowed_ - last) * T(S(1) / n);
            return lesser<T>(greater<T>(growing, at_start), at_most);
        };
        T longest = log2_longest.template operator()<order>();
        unrolled<last_terms - 1>([&]<int i>() {
            longest = lesser<T>(longest, log2_longest.template operator()<order - 1 - i>());
        });
        if constexpr (may_be_wavelet) {
            if (is_wavelet_) {
                // In the tail of a wavelet, the terms are small but grow; each must decrease by a
                // quarter.
                const T ratio =
                    following_ratio<order>(excitation_.motion.pulse, now.phase, phase_per_unit_);
                const T falling = select<T>(now.phase < lost_, T(S(0.75)) / ratio, T(S(0x1p+60)));
                return lesser<T>(rough_power_of_two(longest), falling);
            }
        }
        return rough_power_of_two(longest);
    }

    /// The truncation error: the next terms, which are known, and all that follow. The latter
    /// decrease like a geometric series that starts from the size of the motion: at the chosen step
    /// size, the k-th term is at most the tolerance, whose k-th root is the ratio, and the terms
    /// from k = last on sum up to
    ///
    ///     |rate[k] h^k| ratio^(last - k) / (1 - ratio)
    ///
    /// The largest of these is used: if all of the last terms are small by chance, those that
    /// follow are not. In the linear theory, the terms of the motion decrease faster than any
    /// geometric series; after the known terms, the ratio is at most a third. The push of a wavelet
    /// is added. The bound is twice the sum; in one of 10^7 points it was too small.
    T truncation_error(const Rocking<T>& now, const KnownSeries& known, const auto& push,
                       const T& h) const
    {
        using std::abs;
        T next(S(0));
        T following(S(0));
        T power = h;
        unrolled<order - last_terms>([&]<int>() { power = power * h; });
        if constexpr (may_be_wavelet) {
            if (is_wavelet_) {
                next = left_out_of(push, now.phase, h, power);
            }
        }
        unrolled<last_terms + known_order - order>([&]<int i>() {
            constexpr int k = order + 1 - last_terms + i;
            const T term = abs(known.rate[k]) * power;
            power = power * h;
            if constexpr (k > order) {
                next = next + term;
            } else {
                following = greater<T>(following, T(term * following_per_[i]));
            }
        });
        const T sum = next + following;
        return sum + sum;
    }

    StepErrors<T> errors(const Rocking<T>& now, const Motion& motion, const auto& push,
                         const StepEnd<T>& end) const
    {
        using arithmetic::fma;
        const auto& [known, bounds, h] = motion;
        const T left_out = truncation_error(now, known, push, h);
        const Series series = leading<order>(known);
        const T middle = h * T(S(0.5));
        const auto pushes = pushes_at(now, push, middle, h, end.phase);
        const auto stiffness = [&](const T& tilt, const auto& push_there) -> T {
            return rocking_stiffness<theory>(tilt, slenderness_, push_there);
        };
        const auto tilt_at_turn = [&, &h = h](const Mask& turns, const T& share) -> T {
            const T zero(S(0));
            const T one(S(1));
            T time = h * share;
            for (int i = 0; i < 3; ++i) { // Newton's method; the estimate alone would be too rough
                const T slope = slope_of_series(series.rate, time);
                const T newton = time - value_of_series(series.rate, time) /
                                            select<T>(turns && slope != zero, slope, one);
                time = select<T>(turns, lesser<T>(greater<T>(newton, zero), h), zero);
            }
            return value_of_series(series.tilt, time);
        };
        const T duration = h * unit_;
        const T longest = T(S(longest_variation));
        const T unknown = select<T>(duration > longest, T(unknown_error<S>), T(S(0)));
        const T acceleration = slope_of_series(series.rate, h);
        const TurnsInStep<T> turns({series.rate[0], series.rate[1]},
                                   {end.rate * unit_, acceleration}, h);
        return {.variation =
                    variation_over<T>(lesser<T>(duration, longest), stiffness(now.tilt, pushes[0]),
                                      stiffness(value_of_series(series.tilt, middle), pushes[1]),
                                      stiffness(end.tilt, pushes[2])),
                .tilt = left_out * h * T(S(1) / (order + 2)),
                .rate = fma(left_out, fastest_, unknown),
                .acceleration = acceleration * (fastest_ * fastest_),
                .turning_tilt = turning_tilt<T>(slenderness_, turns, lower_bound(bounds.lower()),
                                                upper_bound(bounds.upper()), tilt_at_turn)};
    }

    /// The push at the beginning, in the middle and at the end of a step.
    auto pushes_at(const Rocking<T>& now, const auto& push, const T& middle, const T& h,
                   const T& end) const
    {
        if constexpr (std::same_as<Excitation, PulseExcitation<T>>) {
            std::array<T, 3> pushes = excitation_.ground(
                std::array<T, 3>{now.phase, now.phase + middle * phase_per_unit_, end});
            for (T& value : pushes) {
                value = now.side * value;
            }
            return pushes;
        } else {
            return std::array{push.at(T(S(0))), push.at(middle), push.at(h)};
        }
    }

    /// The contribution of the push of a wavelet to the rate beyond the known series: the term
    /// f[k] h^k adds f[k] h^(k+1) / (k + 1), and the terms decrease at least geometrically.
    /// power: h^(order + 1 - last_terms).
    T left_out_of(const Coefficients<known_order, T>& push, const T& phase, const T& h,
                  T power) const
    {
        using std::abs;
        constexpr int last = known_order - 1;
        unrolled<last - 1 - (order + 1 - last_terms)>([&]<int>() { power = power * h; });
        const T ratio =
            following_ratio<known_order>(excitation_.motion.pulse, phase, T(phase_per_unit_ * h));
        const T term = greater<T>(abs(push[last]) * h, T(ratio * abs(push[last - 1]))) * power;
        return term * ratio / (T(S(1)) - ratio) * h * (unit_ * unit_ * T(S(1) / (last + 2)));
    }

    [[gnu::noinline]] FirstEvent<T> first_event_not_inlined(const Series& series,
                                                            const Enclosure<T>& bounds, const T& h,
                                                            const T& noise,
                                                            const Mask& suspect) const
    {
        return straight_line<T>([&] { return first_event(series, bounds, h, noise, suspect); });
    }

    T slenderness_;
    Excitation excitation_;
    const bool is_wavelet_;
    const T tolerance_;
    const T log2_tolerance_;
    T unit_;           // of time: 1/p, or 1/omega_p or about a sample if that is shorter [1/p]
    T fastest_;        // its reciprocal
    T phase_per_unit_; // [rad or samples]
    T log2_most_allowed_;
    T lost_ = T(S(0));                                            // see acceleration()
    std::array<T, outputs.error ? last_terms : 0> following_per_; // see truncation_error()
};

/// Selects Taylor series of this order.
template <int order>
struct Taylor {
    template <Theory theory, Number T, Outputs outputs, class Excitation>
    using Stepper = TaylorStepper<order, theory, T, outputs, Excitation>;
};

} // namespace overturn
