// Taylor coefficients of the motion about one corner (Eq. 47) between impacts, by recurrences.
// Method: Jorba & Zou, Experimental Mathematics 14 (2005) 99-117.
#pragma once

#include "overturn/mechanics/block.hpp"
#include "overturn/mechanics/pulse_series.hpp"

#include <algorithm>

namespace overturn {

/// tilt(t) = sum of tilt[k] t^k; its rate d tilt / d t = sum of rate[k] t^k, one order lower. The
/// time unit of t is the `unit` given to rocking_series().
template <int order, Number T>
struct RockingSeries {
    Coefficients<order + 2, T> tilt; ///< |theta| [rad]
    Coefficients<order + 1, T> rate; ///< d|theta| / d t [rad]
};

/// Calls `body.template operator()<j>()` for 0 <= j < count from the middle outwards: in a sum over
/// j and count - 1 - j, the terms that are known first are added first.
template <int count, class Body>
constexpr void newest_last(const Body& body)
{
    unrolled<count>([&]<int i>() {
        constexpr int left = count - 1 - i;
        body.template operator()<(left % 2 == 0 ? left / 2 : count - (left + 1) / 2)>();
    });
}

/// The k-th coefficient of a push, or of a ramp.
template <int k, Number T, std::size_t count>
T coefficient(const std::array<T, count>& push)
{
    return push[k];
}
template <int k, Number T>
T coefficient(const Ramp<T>& ramp)
{
    return k == 0 ? ramp.start : k == 1 ? ramp.slope : T(0);
}

/// The k-th coefficient of the product of a push, or a ramp, with a series; k > 0.
template <int k, Number T, std::size_t count, std::size_t terms>
T coefficient_of_product(const std::array<T, count>& push, const std::array<T, terms>& c)
{
    T sum = push[k] * c[0];
    unrolled<k - 1>([&]<int j>() { sum = fma(push[k - 1 - j], c[j + 1], sum); });
    return fma(push[0], c[k], sum);
}
template <int k, Number T, std::size_t terms>
T coefficient_of_product(const Ramp<T>& ramp, const std::array<T, terms>& c)
{
    return fma(ramp.start, c[k], ramp.slope * c[k - 1]);
}

template <int order, Number T, class Push>
RockingSeries<order, T> linear_rocking_series(const T& tilt, const T& rate, const T& slenderness,
                                              const Push& push, const T& unit)
{
    using S = scalar_t<T>;
    const T square = unit * unit;
    const auto& horizontal = horizontal_of(push);
    const T push_0 = coefficient<0>(horizontal);
    RockingSeries<order, T> series;
    auto& x = series.tilt;
    auto& v = series.rate;
    x[0] = tilt;
    v[0] = rate;
    x[1] = rate;
    const T y = tilt - slenderness;
    if constexpr (has_gravity<Push>) {
        v[1] = square * fma(push.gravity.start, y, -push_0);
    } else {
        v[1] = square * (y - push_0);
    }
    x[2] = v[1] * T(0.5);
    unrolled<order - 1>([&]<int i>() {
        constexpr int k = i + 1;
        T pull = x[k];
        if constexpr (has_gravity<Push>) {
            pull = fma(push.gravity.start, x[k], push.gravity.slope * (k == 1 ? y : x[k - 1]));
        }
        v[k + 1] = (pull - coefficient<k>(horizontal)) * (square * T(S(1) / (k + 1)));
        x[k + 2] = v[k + 1] * T(S(1) / (k + 2));
    });
    return series;
}

/// Computes motion.rate[k + 1] and what it depends on for `first` <= k < `last`; all before are
/// known. s and c: see rocking_series().
template <int first, int last, int order, Number T>
void extend(RockingSeries<order, T>& motion, Coefficients<order, T>& s, Coefficients<order, T>& c,
            const auto& push)
{
    using S = scalar_t<T>;
    auto& [x, v] = motion;
    unrolled<last - first>([&]<int i>() {
        constexpr int k = first + i;
        T c_v(0);
        T s_v(0);
        newest_last<k>([&]<int j>() {
            if constexpr (j == k / 2) { // the first term
                c_v = v[j] * c[k - 1 - j];
                s_v = v[j] * s[k - 1 - j];
            } else {
                c_v = fma(v[j], c[k - 1 - j], c_v);
                s_v = fma(v[j], s[k - 1 - j], s_v);
            }
        });
        s[k] = c_v * T(S(1) / k);
        c[k] = s_v * T(S(-1) / k);
        T s_k = s[k];
        if constexpr (has_gravity<std::remove_cvref_t<decltype(push)>>) {
            s_k = coefficient_of_product<k>(push.gravity, s);
        }
        const T push_c = coefficient_of_product<k>(horizontal_of(push), c);
        v[k + 1] = fma(s_k, T(S(1) / (k + 1)), push_c * T(S(-1) / (k + 1)));
        x[k + 2] = v[k + 1] * T(S(1) / (k + 2));
    });
}

template <int order, Number T, class Push>
RockingSeries<order, T> nonlinear_rocking_series(const T& tilt, const T& rate, const T& slenderness,
                                                 const Push& push, const T& unit)
{
    const T square = unit * unit;
    const T push_0 = coefficient<0>(horizontal_of(push));
    RockingSeries<order, T> motion; // returned without a copy
    auto& x = motion.tilt;
    auto& v = motion.rate;
    x[0] = tilt;
    v[0] = rate;
    x[1] = rate;
    const auto [sine, cosine] = sine_and_cosine(T(tilt - slenderness));
    Coefficients<order, T> s{square * sine};
    Coefficients<order, T> c{square * cosine};
    T s_0 = s[0];
    if constexpr (has_gravity<Push>) {
        s_0 = push.gravity.start * s_0;
    }
    v[1] = fma(-push_0, c[0], s_0);
    x[2] = v[1] * T(0.5);
    constexpr int full = std::min(full_terms<T, order + 1>, order);
    extend<1, full>(motion, s, c, push);
    if constexpr (full < order) {
        auto rest = estimate_of(motion);
        auto rest_of_s = estimate_of(s);
        auto rest_of_c = estimate_of(c);
        extend<full, order>(rest, rest_of_s, rest_of_c, estimate_of(push));
        for (std::size_t k = full + 1; k < v.size(); ++k) {
            v[k] = T(rest.rate[k]);
            x[k + 1] = T(rest.tilt[k + 1]);
        }
    }
    return motion;
}

/// The series of the motion with this tilt [rad] and rate [rad per unit] at t = 0. push: the series
/// of side * ground acceleration / g. unit: one unit of t [1/p].
///
/// With s = sin(tilt - alpha), c = cos(tilt - alpha), v the rate, B the push (Eq. 47):
///
///     v' = unit^2 (s - B c),   s' = c v,   c' = -s v         linear theory: v' = unit^2 (y - B),
///
/// y = tilt - alpha; with a vertical motion, s and y are multiplied by the gravity. Products become
/// sums over coefficients; s and c include the factor unit^2.
/// The newest terms of each sum are added last, which shortens the dependency chain.
template <Theory theory, int order, Number T, class Push>
RockingSeries<order, T> rocking_series(const T& tilt, const T& rate, const T& slenderness,
                                       const Push& push, const T& unit)
{
    if constexpr (theory == Theory::linear) {
        return linear_rocking_series<order>(tilt, rate, slenderness, push, unit);
    } else {
        return nonlinear_rocking_series<order>(tilt, rate, slenderness, push, unit);
    }
}

template <int order, Number T>
    requires has_estimate<T>
RockingSeries<order, estimate_t<T>> estimate_of(const RockingSeries<order, T>& series)
{
    return {estimate_of(series.tilt), estimate_of(series.rate)};
}

/// The series truncated to a lower order.
template <int order, int known_order, Number T>
RockingSeries<order, T> leading(const RockingSeries<known_order, T>& known)
{
    RockingSeries<order, T> series;
    std::copy_n(known.tilt.begin(), series.tilt.size(), series.tilt.begin());
    std::copy_n(known.rate.begin(), series.rate.size(), series.rate.begin());
    return series;
}
template <int order, int known_order, Number T>
    requires(order == known_order)
const RockingSeries<order, T>& leading(const RockingSeries<known_order, T>& known)
{
    return known;
}

} // namespace overturn
