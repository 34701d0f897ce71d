// What the contact of freely rocking blocks must bear, after the ground motion.
#pragma once

#include "overturn/mechanics/contact.hpp"
#include "overturn/mechanics/theory/theories.hpp"

namespace overturn {

/// The force on a freely rocking block at y = alpha - tilt on an arc with this q (Eq. 21), and its
/// derivatives with respect to y: omega^2 = 2 (1 - cos y) - q, and
///
///     horizontal:  lambda sin y (omega^2 - cos y)
///     vertical:    1 - lambda (sin^2 y + omega^2 cos y)
template <Number T>
ContactForce<T> force_on_arc(const ContactSide<T>& side, const T& q, const SineAndCosine<T>& of_y)
{
    const auto& [s, c] = of_y;
    const T& inertia = side.inertia;
    const T square = 2 * (1 - c) - q;
    return on_base<T>(side,
                      {inertia * s * (square - c), 1 - inertia * (s * s + square * c),
                       inertia * (c * (square - c) + 3 * s * s), inertia * s * (square - 4 * c)});
}

/// The sines of y at which a force normal to the base may be smallest on an arc, |y| < pi/2, if the
/// base is not level. Above 1: there is no such place.
///
/// With the angle psi of the base, z = y + psi/2 and a = 2 - q, the derivative of the normal force
/// is lambda sin z cos z (F(z) - 6),
///
///     F(z) = a cos(psi/2) / cos z + a sin(psi/2) / sin z
///
/// F is monotonic between -pi/2, 0, pi/2 and its only extreme, tan^3 z = tan(psi/2), so that the
/// normal force has at most one minimum on either side of both 0 and that extreme.
template <Number T>
std::array<T, 2> places_of_least_normal(const ContactSide<T>& side, const T& q, const T& low,
                                        const T& high)
{
    const T half_tangent = side.sine / (1 + side.cosine);
    T root(1);                 // |tan z|, by square roots, which are the same on all processors
    constexpr int passes = 26; // each divides the exponent of its error by four
    for (int i = 0; i < passes; ++i) {
        root = sqrt(sqrt(abs(half_tangent) * root));
    }
    const T tangent = select<T>(half_tangent < 0, -root, root);
    const T half_cosine = 1 / sqrt(1 + half_tangent * half_tangent);
    const T level = -half_tangent * half_cosine; // sin y at z = 0
    const T extreme = (tangent - half_tangent) * half_cosine / sqrt(1 + tangent * tangent);
    const auto slope_at = [&](const T& sine) -> T {
        return force_on_arc<T>(side, q, {sine, sqrt(greater<T>(1 - sine * sine, 0))}).normal_slope;
    };
    const auto minimum_between = [&](const T& first, const T& last) -> T {
        const mask_t<T> within = first < last && slope_at(first) < 0 && slope_at(last) > 0;
        constexpr int most_passes = 16;
        return select<T>(within, root_between<T>(first, last, within, slope_at, most_passes), T(2));
    };
    return {minimum_between(low, lesser<T>(high, lesser<T>(level, extreme))),
            minimum_between(greater<T>(low, greater<T>(level, extreme)), high)};
}

/// What the contact must bear on an arc between two places, |y| < pi/2.
///
/// With a = 2 - q and x = cos y, the vertical force has its extremes at y = 0 and x = a/6. The
/// friction has them on any base, whose angle is a rotation of the force, where
///
///     (6 + 3 lambda) x^2 - a (1 + 5 lambda) x - 3 (1 - lambda) + lambda a^2 = 0
template <Number T>
ContactDemand<T> demand_on_arc(const ContactSide<T>& side, const T& q, const SineAndCosine<T>& low,
                               const SineAndCosine<T>& high)
{
    ContactDemand<T> demand = demand_of(force_on_arc(side, q, low));
    const mask_t<T> all = q == q;
    demand.include(demand_of(force_on_arc(side, q, high)), all);
    const auto see = [&](const T& sine, const mask_t<T>& lanes) {
        const mask_t<T> within = lanes && low.sine < sine && sine < high.sine;
        if (any<T>(within)) {
            const T cosine = sqrt(greater<T>(1 - sine * sine, 0));
            demand.include(demand_of(force_on_arc<T>(side, q, {sine, cosine})), within);
        }
    };
    const auto include_both = [&](const T& cosine, const mask_t<T>& lanes) {
        const T square = 1 - cosine * cosine;
        const mask_t<T> exists = lanes && square >= 0;
        const T sine = sqrt(greater<T>(square, 0));
        see(sine, exists);
        see(-sine, exists);
    };
    see(T(0), all);
    const T a = 2 - q;
    const T& inertia = side.inertia;
    include_both(a * T(scalar_t<T>(1) / 6), all);
    const T square = 6 + 3 * inertia;
    const T half = 0.5 * a * (1 + 5 * inertia);
    const T discriminant = half * half + square * (3 * (1 - inertia) - inertia * a * a);
    const T root = sqrt(greater<T>(discriminant, 0));
    include_both((half + root) / square, discriminant >= 0);
    include_both((half - root) / square, discriminant >= 0);
    const mask_t<T> sloped = side.sine != 0;
    if (any<T>(sloped)) {
        for (const T& sine : places_of_least_normal(side, q, low.sine, high.sine)) {
            see(sine, sloped);
        }
    }
    return demand;
}

/// What the contact of a block that stands on its corner at the tilt 0, and does not move, must
/// bear: the limit of infinitely many bounces.
template <Number T>
ContactDemand<T> standing_contact(const Block<T>& block, const ContactSide<T>& side)
{
    const T largest = Equations<Theory::nonlinear>::separatrix_rate(block, T(0));
    return demand_of(force_on_arc(side, T(largest * largest), sine_and_cosine(block.slenderness)));
}

/// What the contact must bear in these lanes, from this state on until the block rests or last
/// passes alpha. block: as seen from the side of the state.
///
/// Of the arcs on one side, each is slower than the one before it. Where the force is directed
/// inward, it decreases with the speed. Where it is directed outward, the friction increases
/// towards that of a block standing on its corner at the tilt 0, which infinitely many arcs
/// approach, as long as tan^2 alpha < 1 / (1 - lambda). So two arcs on each side and that limit
/// suffice, except for a flat block.
template <Number T>
[[gnu::noinline]] ContactDemand<T> free_contact(const State<T>& state, const Block<T>& block,
                                                const ContactSides<T>& sides,
                                                const mask_t<T>& lanes)
{
    using Mask = mask_t<T>;
    using Nonlinear = Equations<Theory::nonlinear>; // the only theory with these forces
    ContactDemand<T> demand;
    State<T> now = state;
    Block<T> on = block;
    const auto is_flat = [&](const ContactSide<T>& side, const T& alpha) -> Mask {
        const auto [s, c] = sine_and_cosine(alpha);
        return (1 - side.inertia) * s * s > c * c;
    };
    const Mask flat = is_flat(sides.seen_from(now.side), on.slenderness) ||
                      is_flat(sides.seen_from(-now.side), on.other.slenderness);
    const Mask moves = lanes && !(state.tilt == 0 && state.rate == 0);
    Mask open = moves;
    Mask gone = open && !open; // overturned
    const bool has_two_sides = any<T>(!block.is_symmetric());
    const SineAndCosine<T> top{T(0), T(1)};
    for (int arc = 0; arc < 200; ++arc) {
        const T y = on.slenderness - now.tilt;
        const T c = Nonlinear::separatrix_rate(on, now.tilt);
        const T q = (c - now.rate) * (c + now.rate);
        const Mask outward = now.rate > 0;
        if (arc >= 4) {
            open = open && flat;
        }
        gone = gone || (open && y <= 0 && (outward || now.rate >= c));
        open = open && !gone;
        if (!any<T>(open)) {
            break;
        }
        const auto either = [](const Mask& mask, const SineAndCosine<T>& yes,
                               const SineAndCosine<T>& no) -> SineAndCosine<T> {
            return {select<T>(mask, yes.sine, no.sine), select<T>(mask, yes.cosine, no.cosine)};
        };
        const Mask overturns = outward && q <= 0;
        const SineAndCosine<T> here = sine_and_cosine(y);
        const SineAndCosine<T> corner = sine_and_cosine(on.slenderness);
        const SineAndCosine<T> turn{sqrt(greater<T>(q * (1 - 0.25 * q), 0)), 1 - 0.5 * q};
        const SineAndCosine<T> low = either(
            overturns, top, either(outward, either(turn.sine < corner.sine, turn, corner), here));
        const SineAndCosine<T> high = either(overturns, here, corner);
        demand.include(demand_on_arc(sides.seen_from(now.side), q, low, high), open);
        gone = gone || (open && overturns);
        open = open && !gone;
        if (has_two_sides) {
            demand.include_impact(
                friction_of_plastic_impact(sides.seen_from(-now.side), on.other.slenderness), open);
        }
        const T largest = Nonlinear::separatrix_rate(on, T(0));
        const T speed = largest * largest - q;
        now = {T(0), on.rate_ratio() * sqrt(greater<T>(speed, 0)), -now.side};
        on = on.turned();
    }
    const Mask bounces = moves && !gone && block.restitution < 1;
    if (any<T>(bounces)) {
        demand.include(standing_contact(block, sides.seen_from(state.side)), bounces);
        demand.include(standing_contact(block.turned(), sides.seen_from(-state.side)), bounces);
    }
    return demand;
}

} // namespace overturn
