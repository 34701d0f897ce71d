// The forces between a block and its base, and the friction coefficient that they require. Forces
// are over the weight m g.
#pragma once

#include "overturn/mechanics/block.hpp"
#include "overturn/mechanics/ground.hpp"

#include <array>
#include <limits>

namespace overturn {

/// The properties of a side on which the forces depend, in addition to its slenderness.
template <Number T>
struct ContactSide {
    T inertia; ///< lambda = m R^2 / I, I: moment of inertia about the corner; 3/4 for a box [1]
    T cosine;  ///< of the angle by which the base descends towards this side
    T sine;
};

/// gyration: the radius of gyration about the centre of mass over R of the side plus [1].
/// size_plus: R of the side plus, in the unit of Block::size. The base passes through both corners,
/// which are below the centre of mass by R cos alpha.
template <Number T>
ContactSide<T> contact_side(const Block<T>& block, const T& gyration, const T& size_plus)
{
    const T share = gyration * size_plus / block.size;
    const auto here = sine_and_cosine(block.slenderness);
    const auto there = sine_and_cosine(block.other.slenderness);
    const T descent = block.size * here.cosine - block.other.size * there.cosine;
    const T width = block.size * here.sine + block.other.size * there.sine;
    const T length = sqrt(descent * descent + width * width);
    return {1 / (1 + share * share), width / length, descent / length};
}

/// Both sides of a block.
template <Number T>
struct ContactSides {
    /// block: as seen from its side plus.
    ContactSides(const Block<T>& block, const T& gyration)
        : plus(contact_side(block, gyration, block.size)),
          minus(contact_side(block.turned(), gyration, block.size))
    {}

    ContactSide<T> seen_from(const T& side) const
    {
        const mask_t<T> is_plus = side > 0;
        return {select<T>(is_plus, plus.inertia, minus.inertia),
                select<T>(is_plus, plus.cosine, minus.cosine),
                select<T>(is_plus, plus.sine, minus.sine)};
    }

    ContactSide<T> plus;
    ContactSide<T> minus;
};

/// The foot of the centre of mass on the base, over R.
template <Number T>
struct FootOfCentre {
    T distance; ///< from the corner of the side: b / R
    T height;   ///< of the centre of mass above the base: h / R
};

template <Number T>
FootOfCentre<T> foot_of_centre(const ContactSide<T>& side, const T& slenderness)
{
    const auto [s, c] = sine_and_cosine(slenderness);
    return {s * side.cosine + c * side.sine, c * side.cosine - s * side.sine};
}

/// A force of the base on the block, or an impulse, with its derivatives with respect to some
/// variable.
template <Number T>
struct ContactForce {
    T along;  ///< along the base, positive outward
    T normal; ///< normal to it
    T along_slope = T(0);
    T normal_slope = T(0);

    /// The friction coefficient that the contact needs; infinite if the block would leave the base.
    T friction() const
    {
        const mask_t<T> holds = normal > 0;
        return select<T>(holds, abs(along) / select<T>(holds, normal, 1),
                         T(std::numeric_limits<scalar_t<T>>::infinity()));
    }
};

/// The friction coefficient that a block needs to lift on its side: |b / h|. b is negative if the
/// foot is outside the base, beyond the corner.
template <Number T>
T friction_to_lift(const ContactSide<T>& side, const T& slenderness)
{
    const FootOfCentre<T> foot = foot_of_centre(side, slenderness);
    return abs(foot.distance) / foot.height;
}

/// The friction coefficient that an impact needs, from this side i to the other side j, if the base
/// acts at the corner j alone: the ratio of its impulses along the base and normal to it,
///
///     h |omega_i - omega_j| / (b_i omega_i + b_j omega_j)
///
/// Infinite if the normal impulse is not positive: the base would have to pull.
template <Number T>
T friction_of_impact(const Block<T>& block, const ContactSide<T>& side, const ContactSide<T>& other)
{
    const FootOfCentre<T> here = foot_of_centre(side, block.slenderness);
    const FootOfCentre<T> there = foot_of_centre(other, block.other.slenderness);
    const T kept = block.rate_ratio() * (block.other.frequency_parameter /
                                         block.frequency_parameter); // omega_j / omega_i
    const ContactForce<T> impulse{block.size * here.height * (1 - kept),
                                  block.size * here.distance +
                                      block.other.size * there.distance * kept};
    return impulse.friction();
}

/// The friction coefficient that a plastic impact on the corner of this side needs for the corner
/// not to slip: h b / (k^2 + h^2), which is less than b / h.
template <Number T>
T friction_of_plastic_impact(const ContactSide<T>& side, const T& slenderness)
{
    const FootOfCentre<T> foot = foot_of_centre(side, slenderness);
    const T gyration = 1 / side.inertia - 1; // k^2 / R^2
    return foot.height * foot.distance / (gyration + foot.height * foot.height);
}

/// The force whose horizontal part, positive outward, and vertical part are `level`, on the base.
template <Number T>
ContactForce<T> on_base(const ContactSide<T>& side, const ContactForce<T>& level)
{
    return {level.along * side.cosine - level.normal * side.sine,
            level.normal * side.cosine + level.along * side.sine,
            level.along_slope * side.cosine - level.normal_slope * side.sine,
            level.normal_slope * side.cosine + level.along_slope * side.sine};
}

/// A rocking block. The push is the acceleration of the ground over g, positive outward: T, or
/// Ground<T> with a vertical motion.
template <Number T, class Push>
struct MovingBlock {
    T tilt;          ///< [rad]
    T rate;          ///< with respect to tau [rad]
    Push push;       ///< [1]
    Push push_slope; ///< with respect to tau [1]
};

/// The force on a rocking block, whose centre of mass moves on a circle about the corner, and its
/// derivatives with respect to tau. With y = alpha - tilt, the gravity g (1 without a vertical
/// motion), the push B and the rate omega:
///
///     horizontal:  B + Q cos y + lambda omega^2 sin y,   Q = -lambda (g sin y + B cos y)
///     vertical:    g + Q sin y - lambda omega^2 cos y
template <Number T, class Push>
ContactForce<T> force_while_rocking(const ContactSide<T>& side, const T& slenderness,
                                    const MovingBlock<T, Push>& block)
{
    const auto [s, c] = sine_and_cosine(T(slenderness - block.tilt));
    const T& rate = block.rate; // s' = -c rate, c' = s rate
    const T& push = horizontal_of(block.push);
    const T gravity = gravity_of(block.push, T(1));
    const T& push_slope = horizontal_of(block.push_slope);
    const T gravity_slope = gravity_of(block.push_slope, T(0));
    const T pull = -(gravity * s + push * c);
    const T jerk = (gravity * c - push * s) * rate - (gravity_slope * s + push_slope * c);
    const T turning = side.inertia * pull;
    const T turning_slope = side.inertia * jerk;
    const T swing = side.inertia * (rate * rate);
    const T swing_slope = (turning + turning) * rate;
    return on_base<T>(
        side,
        {push + turning * c + swing * s, gravity + turning * s - swing * c,
         push_slope + (turning_slope - swing * rate) * c + (turning * rate + swing_slope) * s,
         gravity_slope + (turning_slope - swing * rate) * s - (turning * rate + swing_slope) * c});
}

/// An upper bound of the fourth derivative of the force, |d^4 (H + i V) / d tau^4|, on a smooth
/// piece of the ground motion. rate: an upper bound of |omega|; ground[k]: upper bounds of
/// |d^k c / d tau^k|, c = B - i g.
///
/// With e = exp(i y), the force is H + i V = B + i g + i lambda e'' because the centre of mass
/// moves on a circle, and
///
///     e' = i y' e,   y'' = Re(c e)
///
/// Leibniz' rule bounds all derivatives of e and y by those of c.
template <Number T>
[[gnu::noinline, gnu::cold]] T fourth_derivative_of_force(const T& inertia, const T& rate,
                                                          const std::array<T, 5>& ground)
{
    std::array<T, 7> e{T(1)};
    std::array<T, 7> speed{rate}; // y' and its derivatives
    for (std::size_t n = 0; n + 1 < e.size(); ++n) {
        T e_next(0);
        T speed_next(0);
        double binomial = 1;
        for (std::size_t k = 0; k <= n; ++k) {
            e_next = fma(T(binomial) * speed[k], e[n - k], e_next);
            if (k < ground.size()) {
                speed_next = fma(T(binomial) * ground[k], e[n - k], speed_next);
            }
            binomial = binomial * double(n - k) / double(k + 1);
        }
        e[n + 1] = e_next;
        speed[n + 1] = speed_next; // the last one is not used
    }
    return fma(inertia, e[6], ground[4]);
}

/// The force on a block at rest. slope: of the push, with respect to some variable.
template <Number T, class Push>
ContactForce<T> force_at_rest(const ContactSide<T>& side, const Push& push, const Push& slope)
{
    return on_base<T>(side, {horizontal_of(push), gravity_of(push, T(1)), horizontal_of(slope),
                             gravity_of(slope, T(0))});
}

/// What the contact must bear over some time.
template <Number T>
struct ContactDemand {
    T friction = T(0); ///< the largest friction coefficient that it needs [1]
    T normal = T(std::numeric_limits<scalar_t<T>>::infinity()); ///< the smallest normal force
    T impact = T(0); ///< the largest friction coefficient that an impact needs, if that is included

    /// All but the impacts.
    void include(const ContactDemand& other, const mask_t<T>& lanes)
    {
        friction = select<T>(lanes, greater<T>(friction, other.friction), friction);
        normal = select<T>(lanes, lesser<T>(normal, other.normal), normal);
    }

    void include_impact(const T& friction_of_impact, const mask_t<T>& lanes)
    {
        impact = select<T>(lanes, greater<T>(impact, friction_of_impact), impact);
    }

    void forget(const mask_t<T>& lanes)
    {
        const ContactDemand none;
        friction = select<T>(lanes, none.friction, friction);
        normal = select<T>(lanes, none.normal, normal);
    }
};

template <Number T>
ContactDemand<T> demand_of(const ContactForce<T>& force)
{
    return {force.friction(), force.normal};
}

/// The zero of a function between two places where its values have different signs, in these lanes,
/// by passes of the Illinois method: 7 find it to 12 digits of an eighth of a step. at(place)
/// returns the value.
template <Number T, class At>
T root_between(T first, T last, const mask_t<T>& lanes, const At& at, int passes = 7)
{
    T from = at(first);
    T to = at(last);
    for (int i = 0; i < passes; ++i) {
        const mask_t<T> open = lanes && from != to;
        const T change = select<T>(open, to - from, 1);
        const T next = select<T>(open, (first * to - last * from) / change, last);
        const T there = at(next);
        const mask_t<T> stays = there * to > 0;
        first = select<T>(stays, first, last);
        from = select<T>(stays, from * 0.5, to);
        last = next;
        to = there;
    }
    return last;
}

} // namespace overturn
