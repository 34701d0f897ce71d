// Taylor coefficients of the motion about one corner (Eq. 47) between impacts. Each theory computes
// them by recurrences. Method: Jorba & Zou, Experimental Mathematics 14 (2005) 99-117.
#pragma once

#include "overturn/mechanics/ground.hpp"
#include "overturn/mechanics/pulse_series.hpp"

#include <algorithm>

namespace overturn {

/// tilt(t) = sum of tilt[k] t^k; its rate d tilt / d t = sum of rate[k] t^k, one order lower. The
/// time unit of t is the `unit` given to Equations::series().
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
