// The first time within a step at which a polynomial falls below zero, even if it rises again.
// The polynomial is not sampled but bounded by its Bernstein coefficients, so no root is missed.
#pragma once

#include "overturn/integrate/runge_kutta_step.hpp"
#include "overturn/number/elementary.hpp"

#include <limits>

namespace overturn {

/// The smallest Bernstein coefficient: a lower bound of the polynomial.
template <Number T>
T lower_bound(const Quintic<T>& c)
{
    return lesser<T>(lesser<T>(lesser<T>(c[0], c[1]), lesser<T>(c[2], c[3])),
                     lesser<T>(c[4], c[5]));
}

/// The largest Bernstein coefficient: an upper bound of the polynomial.
template <Number T>
T upper_bound(const Quintic<T>& c)
{
    return greater<T>(greater<T>(greater<T>(c[0], c[1]), greater<T>(c[2], c[3])),
                      greater<T>(c[4], c[5]));
}

/// The polynomial on [left, right] as a function of s from 0 to 1 (de Casteljau, twice).
template <Number T>
Quintic<T> restricted(Quintic<T> c, const T& left, const T& right)
{
    for (std::size_t level = 1; level < c.size(); ++level) {
        for (std::size_t i = 0; i + level < c.size(); ++i) {
            c[i] = fma(left, c[i + 1] - c[i], c[i]);
        }
    }
    // In lanes whose search has finished, left = right = 1.
    const T share = (right - left) / select<T>(left < 1, 1 - left, 1);
    for (std::size_t level = 1; level < c.size(); ++level) {
        for (std::size_t i = c.size() - 1; i >= level; --i) {
            c[i] = fma(share, c[i] - c[i - 1], c[i - 1]);
        }
    }
    return c;
}

/// pi/2 - tilt [rad].
template <Number T>
Quintic<T> room_above(Quintic<T> tilt)
{
    for (T& c : tilt) {
        c = T(pi<scalar_t<T>>() / 2) - c;
    }
    return tilt;
}

/// The largest dip that the round-off of an acceleration of order alpha can cause within a step h.
template <Number T>
T dip_of_round_off(const T& slenderness, const T& h)
{
    return slenderness * h * h * T(8 * std::numeric_limits<scalar_t<T>>::epsilon());
}

/// The root of a decreasing polynomial with c[0] >= 0 and c[5] < 0, to the relative accuracy
/// `enough`: Newton's method on de Casteljau's scheme, with bisection if it leaves the bracket.
template <Number T>
T root_of_falling(const Quintic<T>& c, const T& enough, const mask_t<T>& wanted)
{
    using S = scalar_t<T>;
    T low(0);
    T high(1);
    const T above = greater<T>(c[0], low);
    T s = above / (above - c.back());
    mask_t<T> open = wanted;
    while (any<T>(open)) {
        Quintic<T> d = c;
        for (std::size_t level = 1; level + 1 < d.size(); ++level) {
            for (std::size_t i = 0; i + level < d.size(); ++i) {
                d[i] = fma(s, d[i + 1] - d[i], d[i]);
            }
        }
        const T slope = 5 * (d[1] - d[0]);
        const T value = fma(s, d[1] - d[0], d[0]);
        const auto below = value < 0;
        high = select<T>(open && below, s, high);
        low = select<T>(open && !below, s, low);
        const auto sloping = slope != 0; // the slope may be 0 where a piece begins
        const T newton = s - value / select<T>(sloping, slope, 1);
        const auto inside = sloping && newton > low && newton < high;
        const T next = select<T>(inside, newton, (low + high) * 0.5);
        const auto moves =
            abs(next - s) > enough * high && high > T(std::numeric_limits<S>::epsilon());
        s = select<T>(open, next, s);
        open = open && moves;
    }
    return s;
}

/// For each lane in `wanted`: the first s in [0, 1] at which the polynomial falls below -noise;
/// more than 1 if it does not. Dips of at most `noise` >= 0 are ignored.
///
/// The search starts at 0. A piece whose coefficients are all at least -noise is skipped; a piece
/// that decreases and ends below -noise contains the root; any other piece is halved.
template <Number T>
T first_fall_below_zero(const Quintic<T>& c, const T& noise, const mask_t<T>& wanted)
{
    const T one(1);
    const T half(0.5);
    const T narrowest(0x1p-40); // a dip narrower than this share of a step is noise
    T left(0);
    T width = one;
    mask_t<T> searching = wanted;
    mask_t<T> found = wanted && !wanted;
    Quintic<T> piece = c;
    Quintic<T> found_piece{one, one, half, -half, -one, -one}; // for lanes without a root
    while (true) {
        const T right = left + width;
        const auto clear = lower_bound(piece) >= -noise;
        auto falls = piece[0] >= piece[1];
        for (std::size_t i = 2; i < piece.size(); ++i) {
            falls = falls && piece[i - 1] >= piece[i];
        }
        const auto narrow = width < narrowest;
        const auto below = piece.back() < -noise;
        const auto hit = searching && !clear && below && (falls || narrow);
        const auto pass = searching && !hit && (clear || narrow);
        found = found || hit;
        for (std::size_t i = 0; i < piece.size(); ++i) {
            found_piece[i] = select<T>(hit, piece[i], found_piece[i]);
        }
        left = select<T>(pass, right, left);
        width = select<T>(pass, select<T>(width + width < 1 - left, width + width, 1 - left),
                          select<T>(searching && !hit, width * half, width));
        // The last condition ends the search in lanes with NaN.
        searching = searching && !hit && left < 1 && piece.back() == piece.back();
        if (!any<T>(searching)) {
            break;
        }
        piece = restricted(c, left, left + width);
    }
    if (!any<T>(found)) {
        return T(2);
    }
    // Callers correct the root to second order, so a third of the digits is sufficient.
    const T enough(cbrt(std::numeric_limits<scalar_t<T>>::epsilon()));
    const T s = root_of_falling(found_piece, enough, found);
    return select<T>(found, fma(width, s, left), 2);
}

} // namespace overturn
