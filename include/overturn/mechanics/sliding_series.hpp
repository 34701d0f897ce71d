// Taylor coefficients of the motion of a block on one corner that sticks or slips.
#pragma once

#include "overturn/mechanics/rocking_series.hpp"
#include "overturn/mechanics/sliding.hpp"

namespace overturn {

/// Over time in any unit: lengths in that of the block, forces over the mass.
template <int order, Number T>
struct SlidingSeries {
    Coefficients<order + 1, T> tilt;   ///< [rad]
    Coefficients<order + 1, T> rate;   ///< d tilt / d t
    Coefficients<order + 1, T> x;      ///< from the corner to G, along the base
    Coefficients<order + 1, T> y;      ///< and normal to it
    Coefficients<order - 1, T> along;  ///< force of the base
    Coefficients<order - 1, T> normal; ///< positive
    Coefficients<order + 1, T> slip;   ///< velocity of the corner along the base; 0 if it sticks
    Coefficients<order + 1, T> yield;  ///< D, at least in the first coefficient 1 if it sticks
};

/// The k-th coefficient of the product of two series, of which all up to k are known.
template <Number T>
T product_term(const auto& a, const auto& b, std::size_t k)
{
    T sum = a[0] * b[k];
    for (std::size_t j = 1; j <= k; ++j) {
        sum = fma(a[j], b[k - j], sum);
    }
    return sum;
}

/// A state of a block on one corner.
template <Number T>
struct SlidingState {
    T tilt;
    T rate; ///< per unit of time
    T slip; ///< length per unit of time
};

/// The series of a corner that sticks. field: its series, in lengths per unit of time squared.
///
///     (k^2 + R^2) rate' = y g1 - x g2,   F = x'' - g1,   N = y'' - g2
template <int order, Number T>
SlidingSeries<order, T> series_of_sticking(const SlidingSide<T>& side, const SlidingState<T>& state,
                                           const Field2<Coefficients<order + 1, T>>& field)
{
    using S = scalar_t<T>;
    SlidingSeries<order, T> c;
    const OnCorner<T> at = on_corner(side, state.tilt);
    c.tilt[0] = state.tilt;
    c.rate[0] = state.rate;
    c.x[0] = at.x;
    c.y[0] = at.y;
    c.slip.fill(T(0));
    c.yield.fill(T(0));
    c.yield[0] = T(1);
    const T mobility = 1 / side.inertia();
    for (std::size_t k = 0; k < std::size_t(order); ++k) {
        const T share(S(1) / S(int(k) + 1));
        const T moment =
            product_term<T>(c.y, field.along, k) - product_term<T>(c.x, field.normal, k);
        c.tilt[k + 1] = c.rate[k] * share;
        c.x[k + 1] = product_term<T>(c.rate, c.y, k) * share;
        c.y[k + 1] = -product_term<T>(c.rate, c.x, k) * share;
        c.rate[k + 1] = moment * mobility * share;
    }
    for (std::size_t k = 0; k + 2 <= std::size_t(order); ++k) {
        const T factor(S(int(k) + 1) * S(int(k) + 2));
        c.along[k] = fma(factor, c.x[k + 2], -field.along[k]);
        c.normal[k] = fma(factor, c.y[k + 2], -field.normal[k]);
    }
    return c;
}

/// The series of a corner that slips. direction: +1 outward, or -1. With m = x + mu direction y and
/// D = 1 + x m / k^2 > 0:
///
///     D N = -g2 - rate^2 y,   k^2 rate' = N m,   (slip + x')' = g1 - mu direction N
template <int order, Number T>
SlidingSeries<order, T> series_of_slipping(const SlidingSide<T>& side, const SlidingState<T>& state,
                                           const T& direction,
                                           const Field2<Coefficients<order + 1, T>>& field)
{
    using S = scalar_t<T>;
    SlidingSeries<order, T> c;
    const OnCorner<T> at = on_corner(side, state.tilt);
    c.tilt[0] = state.tilt;
    c.rate[0] = state.rate;
    c.x[0] = at.x;
    c.y[0] = at.y;
    c.slip[0] = state.slip;
    const T pull = side.friction * direction;
    const T per_gyration = 1 / side.gyration;
    Coefficients<order, T> lever;  // m
    Coefficients<order, T> square; // of the rate
    Coefficients<order, T> normal; // N
    T yielding(0);                 // 1 / D[0]
    for (std::size_t k = 0; k < std::size_t(order); ++k) {
        const T share(S(1) / S(int(k) + 1));
        lever[k] = fma(pull, c.y[k], c.x[k]);
        square[k] = product_term<T>(c.rate, c.rate, k);
        c.yield[k] = product_term<T>(c.x, lever, k) * per_gyration;
        if (k == 0) {
            c.yield[0] = 1 + c.yield[0];
            yielding = 1 / c.yield[0];
        }
        T force = -field.normal[k] - product_term<T>(square, c.y, k);
        for (std::size_t j = 1; j <= k; ++j) {
            force = fma(-c.yield[j], normal[k - j], force);
        }
        normal[k] = force * yielding;
        c.tilt[k + 1] = c.rate[k] * share;
        c.x[k + 1] = product_term<T>(c.rate, c.y, k) * share;
        c.y[k + 1] = -product_term<T>(c.rate, c.x, k) * share;
        c.rate[k + 1] = product_term<T>(normal, lever, k) * per_gyration * share;
        // Of slip + x', minus the coefficient of x', which is known from the next one on.
        c.slip[k + 1] = fma(-pull, normal[k], field.along[k]) * share;
    }
    c.yield[std::size_t(order)] = T(0); // below the others, as the coefficients that are left out
    for (std::size_t k = 1; k < std::size_t(order); ++k) {
        c.slip[k] = fma(T(-S(int(k) + 1)), c.x[k + 1], c.slip[k]);
    }
    const T last = product_term<T>(c.rate, c.y, std::size_t(order)); // of x'
    c.slip[std::size_t(order)] = c.slip[std::size_t(order)] - last;
    for (std::size_t k = 0; k + 2 <= std::size_t(order); ++k) {
        c.normal[k] = normal[k];
        c.along[k] = -pull * normal[k];
    }
    return c;
}

} // namespace overturn
