// The block and its motion about one corner (Eq. 47), between impacts.
// tau = p t; the ground acceleration is in units of g; the tilt |theta| is never negative.
#pragma once

#include "overturn/mechanics/ground.hpp"
#include "overturn/mechanics/theory.hpp"
#include "overturn/number/elementary.hpp"
#include "overturn/number/number.hpp"

namespace overturn {

template <Number T>
struct Block {
    T slenderness; ///< alpha = arctan(b / h) [rad]
    T restitution; ///< r: ratio of the energies after and before an impact [1]
};

/// The state of a rocking block. The side is stored separately, because theta is 0 at uplift and
/// after an impact.
template <Number T>
struct State {
    T tilt; ///< |theta| [rad]
    T rate; ///< d|theta| / d tau, positive outward [rad]
    T side; ///< +1 or -1: the sign of theta
};

/// The largest restitution of a rocking block (Eq. 17); alpha [rad]:
///
///     r_max = (1 - 3/2 sin^2(alpha))^2
///
/// Valid for alpha < arcsin(sqrt(2/3)), where it reaches 0.
template <Number T>
T largest_restitution(const T& slenderness)
{
    const T sine = sine_and_cosine(slenderness).sine;
    const T root = scalar_t<T>(1) - scalar_t<T>(3) / scalar_t<T>(2) * sine * sine;
    return root * root;
}

/// The ground acceleration over g that lifts a block at rest [1].
template <Theory theory, Number T>
T uplift_acceleration(const T& slenderness)
{
    if constexpr (theory == Theory::linear) {
        return slenderness;
    } else {
        const auto [sine, cosine] = sine_and_cosine(slenderness);
        return sine / cosine;
    }
}

/// d^2|theta| / d tau^2 (Eq. 47), with y = alpha - |theta| and the push B = side * ground
/// acceleration / g:
///
///     |theta|'' = -(sin y + B cos y)          linear theory: -(y + B)
template <Theory theory, Number T>
T rocking_acceleration(const T& tilt, const T& slenderness, const T& push)
{
    using arithmetic::fma;
    const T y = slenderness - tilt;
    if constexpr (theory == Theory::linear) {
        return -(y + push);
    } else {
        const auto [sine, cosine] = sine_and_cosine(y);
        return -fma(push, cosine, sine);
    }
}

/// With a vertical motion, sin y (linear theory: y) is multiplied by the gravity.
template <Theory theory, Number T>
T rocking_acceleration(const T& tilt, const T& slenderness, const Ground<T>& push)
{
    using arithmetic::fma;
    const T y = slenderness - tilt;
    if constexpr (theory == Theory::linear) {
        return -fma(push.gravity, y, push.horizontal);
    } else {
        const auto [sine, cosine] = sine_and_cosine(y);
        return -fma(push.horizontal, cosine, push.gravity * sine);
    }
}

/// Just after an impact: the block pivots about its other corner, its angular velocity is
/// multiplied by sqrt(r) (Eq. 40). The sign of theta' does not change, so the inward rate becomes
/// outward.
template <Number T>
State<T> state_after_impact(const State<T>& before, const T& sqrt_restitution)
{
    return {.tilt = T(0), .rate = -sqrt_restitution * before.rate, .side = -before.side};
}

} // namespace overturn
