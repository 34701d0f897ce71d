// What the contact of a freely rocking block must bear, after the ground motion.
#pragma once

#include "overturn/mechanics/contact.hpp"
#include "overturn/mechanics/free_rocking.hpp"

namespace overturn {

/// The force on a freely rocking block at y = alpha - tilt on an arc with this q (Eq. 21), and its
/// derivatives with respect to y: omega^2 = 2 (1 - cos y) - q, and
///
///     horizontal:  lambda sin y (omega^2 - cos y)
///     vertical:    1 - lambda (sin^2 y + omega^2 cos y)
template <Number T>
ContactForce<T> force_on_arc(const ContactSide<T>& side, const T& q, const T& y)
{
    const auto [s, c] = sine_and_cosine(y);
    const T& inertia = side.inertia;
    const T half = sine_and_cosine(T(y / 2)).sine;
    const T square = 4 * half * half - q;
    return on_base<T>(side,
                      {inertia * s * (square - c), 1 - inertia * (s * s + square * c),
                       inertia * (c * (square - c) + 3 * s * s), inertia * s * (square - 4 * c)});
}

/// What the contact must bear from this state on until the block rests or last passes alpha. block:
/// as seen from the side of the state.
///
/// Of the arcs on one side, each is slower than the one before it. Where the force is directed
/// inward, it decreases with the speed. Where it is directed outward, the friction increases
/// towards that of a block standing on its corner at the tilt 0, which infinitely many arcs
/// approach, as long as tan^2 alpha < 1 / (1 - lambda). So two arcs on each side and that limit
/// suffice, except for a flat block.
template <Number T>
ContactDemand<T> free_contact(const State<T>& state, const Block<T>& block,
                              const ContactSides<T>& sides)
{
    constexpr int parts = 16;
    constexpr Theory theory = Theory::nonlinear;
    ContactDemand<T> demand;
    if (state.tilt == 0 && state.rate == 0) {
        return demand;
    }
    State<T> now = state;
    Block<T> on = block;
    const auto is_flat = [&](const ContactSide<T>& side, const T& alpha) {
        return (1 - side.inertia) * tan(alpha) * tan(alpha) > 1;
    };
    const bool flat = is_flat(sides.seen_from(now.side), on.slenderness) ||
                      is_flat(sides.seen_from(-now.side), on.other.slenderness);
    for (int arc = 0; arc < (flat ? 200 : 4); ++arc) {
        const T y = on.slenderness - now.tilt;
        const T c = Equations<theory>::separatrix_rate(on, now.tilt);
        const T q = (c - now.rate) * (c + now.rate);
        const bool outward = now.rate > 0;
        if (y <= 0 && (outward || now.rate >= c)) {
            return demand; // beyond alpha, and further on
        }
        const bool overturns = outward && q <= 0;
        const T turn = q > 0 ? T(2 * asin(sqrt(q) / 2)) : T(0);
        const T first = overturns ? T(0) : outward ? lesser<T>(turn, on.slenderness) : y;
        const T last = overturns ? y : on.slenderness;
        const ContactSide<T> side = sides.seen_from(now.side);
        demand.include(demand_between<T>(first, last, parts,
                                         [&](const T& at) { return force_on_arc(side, q, at); }),
                       true);
        if (overturns) {
            return demand;
        }
        const T square = Equations<theory>::separatrix_rate(on, T(0));
        const T speed = square * square - q;
        now = {T(0), on.rate_ratio() * (speed > 0 ? T(sqrt(speed)) : T(0)), -now.side};
        on = on.turned();
    }
    if (block.restitution < 1) {
        for (const T& of : {now.side, T(-now.side)}) {
            const T top = Equations<theory>::separatrix_rate(on, T(0));
            demand.include(
                demand_of(force_on_arc(sides.seen_from(of), T(top * top), on.slenderness)), true);
            on = on.turned();
        }
    }
    return demand;
}

} // namespace overturn
