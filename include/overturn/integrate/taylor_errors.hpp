// Bounds of the local errors of a step by Taylor series, and what propagates errors over it.
#pragma once

#include "overturn/integrate/power_series.hpp"
#include "overturn/integrate/stepper_types.hpp"
#include "overturn/mechanics/theory/theories.hpp"

namespace overturn {

/// The number of last terms of a series that determine the step size. Two terms may both be small
/// by chance: for an even push from rest, every other term is 0, and the one between may be small.
/// With four terms, errors are up to ten times smaller at the same tolerance; two and four take the
/// same time for the same largest error. Of a short series, the first of four terms would be too
/// far from those that are left out.
template <int order>
inline constexpr int last_terms = order < 10 ? 2 : 4;

/// The order to which the series is known if the error is an output.
template <int order, Theory theory>
inline constexpr int order_for_errors = order + Equations<theory>::terms_for_errors;

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

/// A bound of the error of the terms that are estimates, see full_terms, at h [rad per unit]. Their
/// roundings are at most a few units of the last place of the largest of them. One term may be
/// small by chance; the one before it is larger by much more than its weight here.
template <int order, Number T>
estimate_t<T> error_of_estimates(const RockingSeries<order, T>& series, const estimate_t<T>& h)
{
    using E = estimate_t<T>;
    constexpr int first = full_terms<T, order + 1>;
    if constexpr (first > order) {
        return E(0);
    } else {
        const auto size_of = [&](int k) -> E { return abs(estimate_of(series.rate[k])); };
        const E terms = greater<E>(size_of(first - 1) * E(1.0 / 16), size_of(first) * h);
        return E(16 * std::numeric_limits<scalar_t<E>>::epsilon()) * power<first - 1>(h) *
               greater<E>(terms, size_of(first + 1) * (h * h));
    }
}

template <int order, Theory theory, Number T>
class TaylorErrors {
    using E = estimate_t<T>;
    using S = scalar_t<E>;
    using Mask = mask_t<T>;
    static constexpr int known_order = order_for_errors<order, theory>;
    static constexpr int last_terms = overturn::last_terms<order>;

public:
    explicit TaylorErrors(const E& log2_tolerance)
    {
        unrolled<last_terms>([&]<int i>() {
            constexpr int k = order + 1 - last_terms + i;
            const E ratio = Equations<theory>::ratio_of_terms(
                rough_power_of_two(E(log2_tolerance * E(S(1) / k))));
            following_per_[i] = 2 / (1 - ratio);
            unrolled<known_order + 1 - k>(
                [&]<int>() { following_per_[i] = following_per_[i] * ratio; });
        });
    }

    /// pushes: at the beginning, in the middle and at the end of the step. beyond: a bound of the
    /// contribution of the push to the rate beyond the known series [rad per unit].
    StepErrors<T> of(const TaylorStep<known_order, T>& step, const BlockSide<T>& side,
                     const auto& pushes, const auto& end, const E& beyond) const
    {
        const auto& known = estimate_of(step.known);
        const E h = estimate_of(step.h);
        const E unit = estimate_of(step.time.unit);
        const E per_time = estimate_of(step.time.per_time);
        const E left_out = truncation_error(known, h, beyond);
        const auto stiffness = [&](const E& tilt, const auto& push) -> E {
            return Equations<theory>::stiffness(estimate_of(side), tilt, estimate_of(push));
        };
        decltype(auto) series = leading<order>(step.known);
        const auto& rough = estimate_of(series);
        const auto tilt_at_turn = [&](const Mask& turns, const T& share) -> T {
            E time = h * estimate_of(share);
            for (int i = 0; i < 3; ++i) { // Newton's method; the estimate alone would be too rough
                const E slope = slope_of_series(rough.rate, time);
                const E newton = time - value_of_series(rough.rate, time) /
                                            select<E>(turns && slope != 0, slope, 1);
                time = select<E>(turns, lesser<E>(greater<E>(newton, 0), h), 0);
            }
            return value_of_series(series.tilt, T(time)); // second-order error
        };
        const E duration = h * unit;
        const E longest(longest_variation);
        const E unknown = select<E>(duration > longest, unknown_error<S>, 0);
        const E acceleration = slope_of_series(rough.rate, h);
        const TurnsInStep<T> turns({series.tilt[0], series.rate[0], series.rate[1]},
                                   {end.tilt, end.rate * step.time.unit, T(acceleration)}, step.h);
        return {.variation = variation_over<E>(
                    lesser<E>(duration, longest), stiffness(known.tilt[0], pushes[0]),
                    stiffness(value_of_series(rough.tilt, h * 0.5), pushes[1]),
                    stiffness(estimate_of(end.tilt), pushes[2])),
                .tilt = left_out * h * E(S(1) / (order + 2)),
                .rate = fma(left_out, per_time, unknown),
                .acceleration = acceleration * (per_time * per_time),
                .turning_tilt = turning_tilt<T>(side.slenderness, turns, step.lowest, step.highest,
                                                tilt_at_turn)};
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
    E truncation_error(const RockingSeries<known_order, E>& known, const E& h,
                       const E& beyond) const
    {
        E next = beyond;
        E following(0);
        E power = h;
        unrolled<order - last_terms>([&]<int>() { power = power * h; });
        unrolled<last_terms + known_order - order>([&]<int i>() {
            constexpr int k = order + 1 - last_terms + i;
            const E term = abs(known.rate[k]) * power;
            power = power * h;
            if constexpr (k > order) {
                next = next + term;
            } else {
                following = greater<E>(following, term * following_per_[i]);
            }
        });
        const E sum = next + following;
        return sum + sum;
    }

    std::array<E, last_terms> following_per_; // see truncation_error()
};

} // namespace overturn
