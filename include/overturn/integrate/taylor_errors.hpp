// Bounds of the local errors of a step by Taylor series, and what propagates errors over it.
#pragma once

#include "overturn/integrate/power_series.hpp"
#include "overturn/integrate/rocking_step.hpp"
#include "overturn/mechanics/rocking_series.hpp"

namespace overturn {

/// The number of last terms of a series that determine the step size. Two terms may both be small
/// by chance: for an even push from rest, every other term is 0, and the one between may be small.
/// With four terms, errors are up to ten times smaller at the same tolerance; two and four take the
/// same time for the same largest error. Of a short series, the first of four terms would be too
/// far from those that are left out.
template <int order>
inline constexpr int last_terms = order < 10 ? 2 : 4;

/// The order to which the series is known if the error is an output. In the linear theory, a term
/// is almost free.
template <int order, Theory theory>
inline constexpr int order_for_errors = order + (theory == Theory::linear ? 3 : 1);

/// The motion at a share of a step of length h.
template <int order, Number T>
MotionSample<T> sample_of(const RockingSeries<order, T>& series, const T& h, const T& share)
{
    const T time = share * h;
    return {value_of_series(series.tilt, time), value_of_series(series.rate, time) * h,
            slope_of_series(series.rate, time) * h * h};
}

/// The unit of time of a series.
template <Number T>
struct TimeUnit {
    T unit;     ///< [1/p]
    T per_time; ///< its reciprocal [p]
};

/// A step whose motion is this series.
template <int known_order, Number T>
struct TaylorStep {
    const RockingSeries<known_order, T>& known;
    TimeUnit<T> time;
    T h;       ///< its length [units]
    T lowest;  ///< bounds of the tilt within the step [rad]
    T highest; ///< [rad]
};

template <int order, Theory theory, Number T>
class TaylorErrors {
    using S = scalar_t<T>;
    using Mask = mask_t<T>;
    static constexpr int known_order = order_for_errors<order, theory>;
    static constexpr int last_terms = overturn::last_terms<order>;

public:
    explicit TaylorErrors(const T& log2_tolerance)
    {
        const T one(S(1));
        unrolled<last_terms>([&]<int i>() {
            constexpr int k = order + 1 - last_terms + i;
            T ratio = rough_power_of_two(T(log2_tolerance * T(S(1) / k)));
            if constexpr (theory == Theory::linear) {
                ratio = lesser<T>(ratio, T(S(1) / 3));
            }
            following_per_[i] = T(S(2)) / (one - ratio);
            unrolled<known_order + 1 - k>(
                [&]<int>() { following_per_[i] = following_per_[i] * ratio; });
        });
    }

    /// pushes: at the beginning, in the middle and at the end of the step. beyond: a bound of the
    /// contribution of the push to the rate beyond the known series [rad per unit].
    StepErrors<T> of(const TaylorStep<known_order, T>& step, const T& slenderness,
                     const auto& pushes, const StepEnd<T>& end, const T& beyond) const
    {
        using arithmetic::fma;
        const auto& [known, time_unit, h, lowest, highest] = step;
        const auto& [unit, per_time] = time_unit;
        const T left_out = truncation_error(known, h, beyond);
        const RockingSeries<order, T> series = leading<order>(known);
        const auto stiffness = [&](const T& tilt, const auto& push) -> T {
            return rocking_stiffness<theory>(tilt, slenderness, push);
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
        const T duration = h * unit;
        const T longest = T(S(longest_variation));
        const T unknown = select<T>(duration > longest, T(unknown_error<S>), T(S(0)));
        const T acceleration = slope_of_series(series.rate, h);
        const TurnsInStep<T> turns({series.rate[0], series.rate[1]},
                                   {end.rate * unit, acceleration}, h);
        return {.variation = variation_over<T>(
                    lesser<T>(duration, longest), stiffness(known.tilt[0], pushes[0]),
                    stiffness(value_of_series(series.tilt, T(h * T(S(0.5)))), pushes[1]),
                    stiffness(end.tilt, pushes[2])),
                .tilt = left_out * h * T(S(1) / (order + 2)),
                .rate = fma(left_out, per_time, unknown),
                .acceleration = acceleration * (per_time * per_time),
                .turning_tilt = turning_tilt<T>(slenderness, turns, lowest, highest, tilt_at_turn)};
    }

private:
    /// The truncation error: the next terms, which are known, and all that follow. The latter
    /// decrease like a geometric series that starts from the size of the motion: at the chosen step
    /// size, the k-th term is at most the tolerance, whose k-th root is the ratio, and the terms
    /// from k = last on sum up to
    ///
    ///     |rate[k] h^k| ratio^(last - k) / (1 - ratio)
    ///
    /// The largest of these is used: if all of the last terms are small by chance, those that
    /// follow are not. In the linear theory, the terms of the motion decrease faster than any
    /// geometric series; after the known terms, the ratio is at most a third. The bound is twice
    /// the sum; in one of 10^7 points it was too small.
    T truncation_error(const RockingSeries<known_order, T>& known, const T& h,
                       const T& beyond) const
    {
        using std::abs;
        T next = beyond;
        T following(S(0));
        T power = h;
        unrolled<order - last_terms>([&]<int>() { power = power * h; });
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

    std::array<T, last_terms> following_per_; // see truncation_error()
};

} // namespace overturn
