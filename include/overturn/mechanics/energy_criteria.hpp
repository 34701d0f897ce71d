// Region and margin of a block that rocks freely after the end of the pulse (Eqs. 11-20, Fig. 4).
// Dimensionless: q over p^2, velocities d theta / d tau.
#pragma once

#include "overturn/mechanics/block.hpp"
#include "overturn/mechanics/region.hpp"

namespace overturn {

/// Signed distance to the top of the rocking arc, negative beyond the top [rad].
///
///     c = 2 sin((alpha - |theta|) / 2)          linear theory: alpha - |theta|
template <Theory theory, Number T>
T separatrix_rate(const T& tilt, const T& slenderness)
{
    if constexpr (theory == Theory::linear) {
        return slenderness - tilt;
    } else {
        const scalar_t<T> half = scalar_t<T>(1) / 2;
        const T sine = sine_and_cosine(T((slenderness - tilt) * T(half))).sine;
        return sine + sine;
    }
}

/// The bounds of the libration region at one tilt (Eq. 20): a block is safe if and only if its
/// outward rate u satisfies -inward <= u <= outward.
template <Number T>
struct SafeRates {
    /// c: if u > outward, the block overturns to the side of its tilt, without impact [rad].
    T outward;
    T inward; ///< sqrt(c^2 - q_min): if u < -inward, to the other side, after one impact [rad]
    /// sqrt(q_max): the largest safe rate of an upright block without impact (Eq. 16) [rad].
    T largest;
    T minus_q_min; ///< [rad^2]
};

///     q_max = 4 sin^2(alpha/2),   q_min = q_max (1 - 1/r)       (Eqs. 16, 18)
template <Theory theory, Number T>
SafeRates<T> safe_rates(const T& tilt, const Block<T>& block)
{
    using arithmetic::fma;
    using std::sqrt;
    const T c = separatrix_rate<theory>(tilt, block.slenderness);
    const T largest = separatrix_rate<theory>(T(scalar_t<T>(0)), block.slenderness);
    const T one = T(scalar_t<T>(1));
    const T minus_q_min = largest * largest * ((one - block.restitution) / block.restitution);
    return {c, sqrt(fma(c, c, minus_q_min)), largest, minus_q_min};
}

/// The margin: distance to a change of the verdict, over sqrt(q_max). Positive if the block is
/// safe, negative if it overturns, continuous between impacts.
///
///     margin = min(c - u, u + sqrt(c^2 - q_min)) / sqrt(q_max)
template <Theory theory, Number T>
T margin_after_pulse(const State<T>& state, const Block<T>& block)
{
    const SafeRates<T> safe = safe_rates<theory>(state.tilt, block);
    const T above = safe.outward - state.rate;
    const T below = state.rate + safe.inward;
    return select<T>(above < below, above, below) / safe.largest;
}

/// The slope of the separatrix: d c / d|theta|, between -1 and 0 below the top.
template <Theory theory, Number T>
T separatrix_slope(const T& tilt, const T& slenderness)
{
    using S = scalar_t<T>;
    if constexpr (theory == Theory::linear) {
        return T(S(-1));
    } else {
        return -sine_and_cosine(T((slenderness - tilt) * T(S(0.5)))).cosine;
    }
}

/// The margin of a block that reached |theta| = pi/2 during the pulse: -theta'^2 / q_max.
template <Theory theory, Number T>
T margin_of_fall(const T& rate, const Block<T>& block)
{
    const T ratio = rate / separatrix_rate<theory>(T(scalar_t<T>(0)), block.slenderness);
    return -(ratio * ratio);
}

/// The region code, as a number, of a block that did not fall during the pulse (Eq. 20).
/// q0 = (c - u)(c + u) is not computed: for c >= 0, its sign is that of c - |u|.
template <Theory theory, Number T>
T region_code_after_pulse(const State<T>& state, const Block<T>& block)
{
    const auto code = [](Region region) { return T(scalar_t<T>(int(region))); };
    const SafeRates<T> safe = safe_rates<theory>(state.tilt, block);
    const mask_t<T> plus = state.side > T(scalar_t<T>(0));
    const T beyond_top = select<T>(plus, code(Region::U0_plus), code(Region::U0_minus));
    const T beyond_impact = select<T>(plus, code(Region::U1_minus), code(Region::U1_plus));
    const T in_blade = select<T>(plus, code(Region::S_minus), code(Region::S_plus));
    // From here on, -inward <= u <= c. Beyond the top, c < 0, so u <= c implies S+ or S-.
    const T safely = select<T>(state.rate >= -safe.outward, code(Region::S), in_blade);
    const T standing = select<T>(state.rate < -safe.inward, beyond_impact, safely);
    return select<T>(state.rate > safe.outward, beyond_top, standing);
}

} // namespace overturn
