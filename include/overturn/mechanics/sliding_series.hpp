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
template <int k, Number T>
T product_term(const auto& a, const auto& b)
{
    T sum(0);
    newest_last<k + 1>([&]<int j>() { sum = fma(a[j], b[k - j], sum); });
    return sum;
}

/// A state of a block on one corner.
template <Number T>
struct SlidingState {
    T tilt;
    T rate; ///< per unit of time
    T slip; ///< length per unit of time
};

/// The first coefficients, in which all others are zero.
template <int order, Number T>
SlidingSeries<order, T> first_coefficients(const SlidingSide<T>& side, const SlidingState<T>& state)
{
    const OnCorner<T> at = on_corner(side, state.tilt);
    SlidingSeries<order, T> c{};
    c.tilt[0] = state.tilt;
    c.rate[0] = state.rate;
    c.x[0] = at.x;
    c.y[0] = at.y;
    c.slip[0] = state.slip;
    c.yield[0] = T(1);
    return c;
}

/// Computes the next coefficients of the tilt and of where G is. Returns the k-th one of x'.
template <int k, int order, Number T>
T turn(SlidingSeries<order, T>& c)
{
    const T share(scalar_t<T>(1) / (k + 1));
    const T velocity = product_term<k, T>(c.rate, c.y);
    c.tilt[k + 1] = c.rate[k] * share;
    c.x[k + 1] = velocity * share;
    c.y[k + 1] = -product_term<k, T>(c.rate, c.x) * share;
    return velocity;
}

/// The series of a corner that sticks. field: its series, in lengths per unit of time squared.
///
///     (k^2 + R^2) rate' = y g1 - x g2,   F = x'' - g1,   N = y'' - g2
template <int order, Number T>
SlidingSeries<order, T> series_of_sticking(const SlidingSide<T>& side, const SlidingState<T>& state,
                                           const Field2<Coefficients<order + 1, T>>& field)
{
    using S = scalar_t<T>;
    SlidingSeries<order, T> c =
        first_coefficients<order>(side, SlidingState<T>{state.tilt, state.rate, T(0)});
    const T mobility = 1 / side.inertia();
    unrolled<order>([&]<int k>() {
        const T moment =
            product_term<k, T>(c.y, field.along) - product_term<k, T>(c.x, field.normal);
        turn<k>(c);
        c.rate[k + 1] = moment * (mobility * T(S(1) / (k + 1)));
    });
    unrolled<order - 1>([&]<int k>() {
        const T factor(S(k + 1) * S(k + 2));
        c.along[k] = fma(factor, c.x[k + 2], -field.along[k]);
        c.normal[k] = fma(factor, c.y[k + 2], -field.normal[k]);
    });
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
    SlidingSeries<order, T> c = first_coefficients<order>(side, state);
    const T pull = side.friction * direction;
    const T per_gyration = 1 / side.gyration;
    Coefficients<order, T> lever;    // m
    Coefficients<order, T> velocity; // x' = rate y
    Coefficients<order, T> normal;   // N
    T yielding(0);                   // 1 / D[0]
    unrolled<order>([&]<int k>() {
        lever[k] = fma(pull, c.y[k], c.x[k]);
        velocity[k] = turn<k>(c);
        c.yield[k] = fma(product_term<k, T>(c.x, lever), per_gyration, c.yield[k]);
        T force = -field.normal[k] - product_term<k, T>(c.rate, velocity);
        if constexpr (k == 0) {
            yielding = 1 / c.yield[0];
        } else {
            newest_last<k>(
                [&]<int j>() { force = fma(-c.yield[j + 1], normal[k - 1 - j], force); });
        }
        normal[k] = force * yielding;
        c.rate[k + 1] = product_term<k, T>(normal, lever) * (per_gyration * T(S(1) / (k + 1)));
        // Of slip + x', minus the coefficient of x', which is known from the next one on.
        c.slip[k + 1] = fma(-pull, normal[k], field.along[k]) * T(S(1) / (k + 1));
    });
    // The last coefficient of the yield is left out, as those above.
    unrolled<order - 1>([&]<int i>() { c.slip[i + 1] = c.slip[i + 1] - velocity[i + 1]; });
    c.slip[order] = c.slip[order] - product_term<order, T>(c.rate, c.y); // minus that of x'
    unrolled<order - 1>([&]<int k>() {
        c.normal[k] = normal[k];
        c.along[k] = -pull * normal[k];
    });
    return c;
}

} // namespace overturn
