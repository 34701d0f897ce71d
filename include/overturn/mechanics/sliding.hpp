// A block that may slip on its base, with Coulomb friction: its forces at rest and its impacts.
// Lengths have the unit of Block::size, times that of 1 / Block::frequency_parameter; forces are
// over the mass. G: the centre of mass. On each side, the first axis points along the base outward
// and the second one is normal to it.
#pragma once

#include "overturn/mechanics/contact.hpp"

namespace overturn {

/// The block and its base as seen from the corner C of one side.
template <Number T>
struct SlidingSide {
    T base;       ///< b: distance of C from the foot of G on the base
    T other_base; ///< that of the other corner
    T height;     ///< h: of G above the base
    T gyration;   ///< k^2: the square of the radius of gyration about G
    T gravity;    ///< g
    T cosine;     ///< of the angle by which the base descends towards this side
    T sine;
    T friction; ///< mu

    /// k^2 + R^2, over the mass: the moment of inertia about C.
    T inertia() const { return gyration + base * base + height * height; }

    /// b / h: the block lifts on this side only if mu is larger.
    T friction_to_lift() const { return base / height; }

    /// The friction coefficient that an impact on C needs: h b / (k^2 + h^2). Less than b / h.
    T friction_of_impact() const { return height * base / (gyration + height * height); }

    /// The ratio of tangential and normal force at rest at which the block moves to this side: it
    /// slides at mu, or it lifts at b / h.
    T threshold() const { return lesser<T>(friction, friction_to_lift()); }

    /// The ground acceleration over the gravity, directed away from this side, at which that ratio
    /// is reached: the tangent of arctan(threshold) minus the angle of the base.
    T acceleration_to_move() const
    {
        const T ratio = threshold();
        return (ratio * cosine - sine) / (cosine + ratio * sine);
    }

    SlidingSide turned() const
    {
        return {other_base, base, height, gyration, gravity, cosine, -sine, friction};
    }
};

/// block: as seen from its side plus; gyration: see contact_side().
template <Number T>
SlidingSide<T> sliding_side(const Block<T>& block, const T& gyration, const T& friction)
{
    const ContactSides<T> sides(block, gyration);
    const FootOfCentre<T> plus = foot_of_centre(sides.plus, block.slenderness);
    const FootOfCentre<T> minus = foot_of_centre(sides.minus, block.other.slenderness);
    const T k = gyration * block.size;
    const T p = block.frequency_parameter;
    return {block.size * plus.distance,
            block.other.size * minus.distance,
            block.size * plus.height,
            k * k,
            p * p * block.size / sides.plus.inertia,
            sides.plus.cosine,
            sides.plus.sine,
            friction};
}

/// The field of acceleration in the frame of the ground: that of gravity minus that of the ground.
template <class T>
struct Field2 {
    T along;  ///< g1
    T normal; ///< g2; negative
};

/// push: the acceleration of the ground over g, positive outward; gravity: 1 + the upwards one.
template <Number T>
Field2<T> field_on(const SlidingSide<T>& side, const T& push, const T& gravity)
{
    return {side.gravity * (gravity * side.sine - push * side.cosine),
            -side.gravity * (push * side.sine + gravity * side.cosine)};
}

/// A block with one corner on the base.
template <Number T>
struct OnCorner {
    T x; ///< from C to G, along the base and normal to it
    T y;
};

template <Number T>
OnCorner<T> on_corner(const SlidingSide<T>& side, const T& tilt)
{
    const auto [s, c] = sine_and_cosine(tilt);
    return {side.height * s - side.base * c, side.base * s + side.height * c};
}

/// The force of the base on a block whose corner sticks. rate: d tilt / d time.
template <Number T>
ContactForce<T> force_of_sticking(const SlidingSide<T>& side, const OnCorner<T>& at, const T& rate,
                                  const Field2<T>& field)
{
    const T turning = (at.y * field.along - at.x * field.normal) / side.inertia();
    const T square = rate * rate;
    return {turning * at.y - square * at.x - field.along,
            -turning * at.x - square * at.y - field.normal};
}

/// The same of a corner that slips outward (direction +1) or inward (-1).
template <Number T>
ContactForce<T> force_of_slipping(const SlidingSide<T>& side, const OnCorner<T>& at, const T& rate,
                                  const T& direction, const Field2<T>& field)
{
    const T pull = side.friction * direction;
    const T yield = 1 + at.x * (at.x + pull * at.y) / side.gyration;
    const T normal = (-field.normal - rate * rate * at.y) / yield;
    return {-pull * normal, normal};
}

/// A state just after an impact on C.
template <Number T>
struct AfterImpact {
    bool stays_down; ///< both corners stay on the base
    T rate;          ///< d tilt / d time, positive; 0 if it stays down
    T slip;          ///< the velocity of C along the base, or of the base of the block
};

/// The impact on C of a block that turns at `rate` > 0 towards this side, about its other corner.
/// slip: the velocity of C along the base; loss: rho = sqrt(r / r_max), at most 1.
///
/// Plastic, with Coulomb friction in Routh's two phases: C slips until it sticks or the impact
/// ends; then it goes on sticking, or slips outward. An inward slip is reduced as much as the rate
/// by rho, because otherwise G would gain speed along the base.
template <Number T>
    requires(lanes_v<T> == 1)
AfterImpact<T> impact_with_friction(const SlidingSide<T>& side, const T& rate, const T& slip,
                                    const T& loss)
{
    const T& k2 = side.gyration;
    const T& h = side.height;
    const T& b = side.base;
    const T& mu = side.friction;
    const T tangential = 1 + h * h / k2; // the inverse mass at C, by components
    const T coupled = h * b / k2;
    const T normal = 1 + b * b / k2;
    T v_t = slip;
    T v_n = -rate * (side.base + side.other_base);
    T p_t(0);
    T p_n(0);
    const auto apply = [&](const T& along, const T& impulse) { // until the impulse is reached
        p_t += along * impulse;
        p_n += impulse;
        v_t += (tangential * along + coupled) * impulse;
        v_n += (coupled * along + normal) * impulse;
    };
    if (v_t != 0) {
        const T along = v_t > 0 ? T(-mu) : mu;
        const T slowing = tangential * along + coupled;
        const T closing = coupled * along + normal;
        const T never(std::numeric_limits<T>::infinity());
        const T to_stick = slowing * v_t < 0 ? T(-v_t / slowing) : never;
        const T to_end = closing > 0 ? T(-v_n / closing) : never;
        if (to_stick < to_end) {
            apply(along, to_stick);
            v_t = T(0);
        } else {
            apply(along, to_end);
            v_n = T(0);
        }
    }
    if (v_n < 0) {
        const T stick = -coupled / tangential;
        const bool sticks = -stick <= mu;
        const T along = sticks ? stick : T(-mu);
        apply(along, -v_n / (coupled * along + normal));
        v_t = sticks ? T(0) : v_t;
    }
    const T turned = rate - (b * p_n + h * p_t) / k2;
    if (!(turned > 0)) {
        const T speed = slip + rate * h;
        const T left = greater<T>(abs(speed) - mu * rate * side.other_base, 0);
        return {true, T(0), speed < 0 ? T(-left) : left};
    }
    const T kept = v_t < 0 ? lesser<T>(v_t + (1 - loss) * h * turned, 0) : v_t;
    return {false, turned * loss, kept};
}

/// sqrt(r / r_max) of a block; infinite if every impact ends the rocking.
template <Number T>
T share_of_rate_kept(const SlidingSide<T>& side, const T& restitution)
{
    const T kept = side.gyration + side.height * side.height - side.base * side.other_base;
    const T square = restitution * side.inertia() * side.turned().inertia();
    return kept > 0 ? T(sqrt(square) / kept) : T(std::numeric_limits<T>::infinity());
}

} // namespace overturn
