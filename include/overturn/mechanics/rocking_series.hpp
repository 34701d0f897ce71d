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

/// The series of the motion with this tilt [rad] and rate [rad per unit] at t = 0. push: the series
/// of side * ground acceleration / g. unit: one unit of t [1/p].
///
/// With s = sin(tilt - alpha), c = cos(tilt - alpha), v the rate, B the push (Eq. 47):
///
///     v' = unit^2 (s - B c),   s' = c v,   c' = -s v         linear theory: v' = unit^2 (y - B),
///
/// y = tilt - alpha. Products become sums over coefficients; s and c include the factor unit^2.
/// The newest terms of each sum are added last, which shortens the dependency chain.
template <Theory theory, int order, Number T, std::size_t count>
    requires(count >= order)
RockingSeries<order, T> rocking_series(const T& tilt, const T& rate, const T& slenderness,
                                       const std::array<T, count>& push, const T& unit)
{
    using arithmetic::fma;
    using S = scalar_t<T>;
    const T square = unit * unit;
    RockingSeries<order, T> series;
    auto& x = series.tilt;
    auto& v = series.rate;
    x[0] = tilt;
    v[0] = rate;
    x[1] = rate;
    if constexpr (theory == Theory::linear) {
        v[1] = square * ((tilt - slenderness) - push[0]);
        x[2] = v[1] * T(S(0.5));
        unrolled<order - 1>([&]<int i>() {
            constexpr int k = i + 1;
            v[k + 1] = (x[k] - push[k]) * (square * T(S(1) / (k + 1)));
            x[k + 2] = v[k + 1] * T(S(1) / (k + 2));
        });
    } else {
        const auto [sine, cosine] = sine_and_cosine(T(tilt - slenderness));
        Coefficients<order, T> s{square * sine};
        Coefficients<order, T> c{square * cosine};
        v[1] = fma(-push[0], c[0], s[0]);
        x[2] = v[1] * T(S(0.5));
        unrolled<order - 1>([&]<int i>() {
            constexpr int k = i + 1;
            T c_v(S(0));
            T s_v(S(0));
            newest_last<k>([&]<int j>() {
                if constexpr (j == k / 2) { // the first term
                    c_v = v[j] * c[k - 1 - j];
                    s_v = v[j] * s[k - 1 - j];
                } else {
                    c_v = fma(v[j], c[k - 1 - j], c_v);
                    s_v = fma(v[j], s[k - 1 - j], s_v);
                }
            });
            T push_c = push[k] * c[0];
            unrolled<k - 1>([&]<int j>() { push_c = fma(push[k - 1 - j], c[j + 1], push_c); });
            s[k] = c_v * T(S(1) / k);
            c[k] = s_v * T(S(-1) / k);
            push_c = fma(push[0], c[k], push_c);
            v[k + 1] = fma(s[k], T(S(1) / (k + 1)), push_c * T(S(-1) / (k + 1)));
            x[k + 2] = v[k + 1] * T(S(1) / (k + 2));
        });
    }
    return series;
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

} // namespace overturn
