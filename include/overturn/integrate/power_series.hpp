// Values and bounds of power series over a step.
#pragma once

#include "overturn/integrate/runge_kutta_step.hpp"

namespace overturn {

/// c[first] + c[first + 1] t + c[first + 2] t^2 + ..., with the even and the odd powers summed
/// separately: two short dependency chains instead of a long one. term(k) returns c[k].
template <int first, int count, Number T, class Term>
T sum_of_powers(const T& t, const Term& term)
{
    static_assert(count >= 2);
    const T square = t * t;
    constexpr int last = first + count - 1;
    T upper = term.template operator()<last>();
    T lower = term.template operator()<last - 1>();
    unrolled<count - 2>([&]<int i>() {
        constexpr int k = last - 2 - i;
        T& sum = i % 2 == 0 ? upper : lower;
        sum = fma(sum, square, term.template operator()<k>());
    });
    return count % 2 == 1 ? fma(lower, t, upper) : fma(upper, t, lower);
}

/// The same, with only the first full_terms terms in all digits of T.
template <int first, int count, Number T, class Term>
T sum_of_small_powers(const T& t, const Term& term)
{
    constexpr int full = full_terms<T, first + count>;
    if constexpr (full < first + count) {
        using E = estimate_t<T>;
        const T rest(sum_of_powers<full, first + count - full>(estimate_of(t), [&]<int k>() -> E {
            return estimate_of(term.template operator()<k>());
        }));
        return sum_of_powers<first, full - first + 1>(t, [&]<int k>() -> T {
            if constexpr (k < full) {
                return term.template operator()<k>();
            } else {
                return rest;
            }
        });
    } else {
        return sum_of_powers<first, count>(t, term);
    }
}

/// The value at t.
template <Number T, std::size_t count>
T value_of_series(const std::array<T, count>& c, const T& t)
{
    return sum_of_small_powers<0, int(count)>(t, [&]<int k>() -> const T& { return c[k]; });
}

/// The value of the derivative at t.
template <Number T, std::size_t count>
T slope_of_series(const std::array<T, count>& c, const T& t)
{
    return sum_of_small_powers<1, int(count) - 1>(
        t, [&]<int k>() -> T { return c[k] * T(scalar_t<T>(k)); });
}

/// An upper bound of the absolute value of the derivative over [0, t], t >= 0.
template <Number T, std::size_t count>
T steepest(const std::array<T, count>& c, const T& t)
{
    return sum_of_powers<1, int(count) - 1>(
        t, [&]<int k>() -> T { return abs(c[k]) * T(scalar_t<T>(k)); });
}

/// Bounds of a series over [0, t], t >= 0: from `center` - slack s^5 to `center` + slack s^5 for s
/// from 0 to 1.
template <Number T>
struct Enclosure {
    Quintic<T> center;
    T slack;

    Quintic<T> lower() const { return ending_at(center[5] - slack); }
    Quintic<T> upper() const { return ending_at(center[5] + slack); }

private:
    Quintic<T> ending_at(const T& end) const
    {
        return {center[0], center[1], center[2], center[3], center[4], end};
    }
};

/// Center: the terms below t^5, as Bernstein coefficients; slack: the absolute sum of all others.
template <Number T, std::size_t count>
Enclosure<T> enclosure(const std::array<T, count>& c, const T& t)
{
    using S = scalar_t<T>;
    static_assert(count >= 7);
    const T square = t * t;
    const T fourth = square * square;
    Quintic<T> b{c[0],
                 c[1] * (t * T(S(1) / 5)),
                 c[2] * (square * T(S(1) / 10)),
                 c[3] * (square * t * T(S(1) / 10)),
                 c[4] * (fourth * T(S(1) / 5)),
                 T(0)};
    for (std::size_t level = 0; level < 5; ++level) {
        for (std::size_t i = 5; i > level; --i) {
            b[i] = b[i] + b[i - 1];
        }
    }
    const T rest = sum_of_powers<5, int(count) - 5>(t, [&]<int k>() -> T { return abs(c[k]); });
    return {b, rest * (fourth * t)};
}

} // namespace overturn
