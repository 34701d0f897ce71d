// Region and margin of a block that rocks freely after the end of the pulse (Eqs. 11-20, Fig. 4).
// Dimensionless: q over p^2, velocities d theta / d tau.
#pragma once

#include "overturn/mechanics/region.hpp"
#include "overturn/mechanics/theory/theories.hpp"

namespace overturn {

/// The energy at the top of the other side j over that of this side i: W_j / W_i with
/// W = m g R q_max / 2; 1 if the block is symmetric. largest: sqrt(q_max) of this side.
template <Theory theory, Number T>
T barrier_ratio(const T& largest, const Block<T>& block)
{
    const T ratio = Equations<theory>::separatrix_rate(block.other, T(0)) / largest;
    return block.other.size / block.size * (ratio * ratio);
}

/// The rates from which a block does not overturn after a certain impact: q0 >= q_min. If q_min is
/// not positive, only a block that moves inward has an impact before it could overturn: u >= -limit
/// with limit = sqrt(c^2 - q_min). If it is positive, also a block that moves outward strikes
/// first, inside the separatrix: |u| <= limit, the signed root of c |c| - q_min.
template <Number T>
struct ImpactLimit {
    T minus_q_min; ///< [rad^2]
    T limit;       ///< [rad]

    ImpactLimit(const T& minus_q, const T& c) : minus_q_min(minus_q), limit(limit_at(c)) {}

    /// The limit at another tilt, where the separatrix is at c.
    T limit_at(const T& c) const { return signed_root(square_at(c)); }

    /// c |c| - q_min, or c^2 - q_min if q_min is not positive.
    T square_at(const T& c) const
    {
        return fma(select<T>(minus_q_min < 0, abs(c), c), c, minus_q_min);
    }

    static T signed_root(const T& square)
    {
        const T root = sqrt(abs(square));
        return select<T>(square < 0, -root, root);
    }

    /// The distance of a rate from the limit; negative if the block overturns after the impact.
    T distance(const T& rate) const { return select<T>(minus_q_min < 0, -abs(rate), rate) + limit; }
};

/// The bounds of the safe states at one tilt (Eq. 20).
template <Number T>
struct SafeRates {
    /// c: if u > outward, the block overturns to the side of its tilt, without impact [rad].
    T outward;
    ImpactLimit<T> one; ///< beyond it, the block overturns to the other side, after one impact
    ImpactLimit<T> two; ///< beyond it, to the side of its tilt, after two; only if not after one
    /// sqrt(q_max): the largest safe rate of an upright block without impact (Eq. 16) [rad].
    T largest;

    /// The limit that a rate reaches first.
    ImpactLimit<T> inward() const { return {lesser<T>(one.minus_q_min, two.minus_q_min), outward}; }
};

/// With the energy E of the block on its side i, and the energies W at the top of both sides, the
/// block overturns after one impact if r E > W_j, and after two if r^2 E > W_i:
///
///     q_max = 4 sin^2(alpha_i/2),   q_min = q_max (1 - W_j/(r W_i))   for one impact,
///                                   q_min = q_max (1 - 1/r^2)         for two
///
/// For a symmetric block the first one is the larger, that of Eq. 18, so that U2 does not exist.
/// Later impacts face the same energies with less energy.
template <Theory theory, Number T>
SafeRates<T> safe_rates(const T& tilt, const Block<T>& block)
{
    const T c = Equations<theory>::separatrix_rate(block, tilt);
    const T largest = Equations<theory>::separatrix_rate(block, T(0));
    const T& r = block.restitution;
    const T q_max = largest * largest;
    const T ratio = barrier_ratio<theory>(largest, block);
    return {c,
            {T(q_max * ((ratio - r) / r)), c},
            {T(q_max * ((1 - r) * (1 + r) / (r * r))), c},
            largest};
}

/// The margin: distance to a change of the verdict, over sqrt(q_max). Positive if the block is
/// safe, negative if it overturns, continuous between impacts.
///
///     margin = min(c - u, u + sqrt(c^2 - q_min)) / sqrt(q_max)
///
/// with the larger q_min; see ImpactLimit if it is positive.
template <Theory theory, Number T>
T margin_after_pulse(const State<T>& state, const Block<T>& block)
{
    const SafeRates<T> safe = safe_rates<theory>(state.tilt, block);
    return lesser<T>(safe.outward - state.rate, safe.inward().distance(state.rate)) / safe.largest;
}

/// The margin of a block that reached |theta| = pi/2 during the pulse: -theta'^2 / q_max.
template <Theory theory, Number T>
T margin_of_fall(const T& rate, const Block<T>& block)
{
    const T ratio = rate / Equations<theory>::separatrix_rate(block, T(0));
    return -(ratio * ratio);
}

/// The region code, as a number, of a block that did not fall during the pulse (Eq. 20).
/// q0 = (c - u)(c + u) is not computed: for c >= 0, its sign is that of c - |u|.
template <Theory theory, Number T>
T region_code_after_pulse(const State<T>& state, const Block<T>& block)
{
    const SafeRates<T> safe = safe_rates<theory>(state.tilt, block);
    const auto code = [&](Region on_plus, Region on_minus) -> T {
        return select<T>(state.side > 0, T(int(on_plus)), T(int(on_minus)));
    };
    // If it does not overturn. Beyond the top, c < 0, so u <= c implies S+ or S-.
    const T is_safe = select<T>(state.rate >= -safe.outward, code(Region::S, Region::S),
                                code(Region::S_minus, Region::S_plus));
    const T after_two = select<T>(safe.two.distance(state.rate) < 0,
                                  code(Region::U2_plus, Region::U2_minus), is_safe);
    const T after_one = select<T>(safe.one.distance(state.rate) < 0,
                                  code(Region::U1_minus, Region::U1_plus), after_two);
    return select<T>(state.rate > safe.outward, code(Region::U0_plus, Region::U0_minus), after_one);
}

} // namespace overturn
