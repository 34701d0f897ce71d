// The block, its two sides and its impacts. tau = p t; the tilt |theta| is never negative.
#pragma once

#include "overturn/number/elementary.hpp"
#include "overturn/number/number.hpp"

namespace overturn {

/// A block on one of its two corners. Lengths and frequencies have any unit that both sides share.
template <Number T>
struct BlockSide {
    T slenderness;                ///< alpha: the tilt at which it would balance [rad]
    T size = T(1);                ///< R: distance from the corner to the centre of mass
    T frequency_parameter = T(1); ///< p

    friend mask_t<T> operator==(const BlockSide& one, const BlockSide& other)
    {
        return one.slenderness == other.slenderness && one.size == other.size &&
               one.frequency_parameter == other.frequency_parameter;
    }
};

/// The side with the members combine(a member of each of these sides).
template <class Combine, Number... T>
auto combined(const Combine& combine, const BlockSide<T>&... sides)
    -> BlockSide<decltype(combine(sides.size...))>
{
    return {combine(sides.slenderness...), combine(sides.size...),
            combine(sides.frequency_parameter...)};
}

/// The same side in numbers of another type.
template <Number Other, Number T>
BlockSide<Other> side_in(const BlockSide<T>& side)
{
    return combined([](const T& member) { return Other(member); }, side);
}

/// A block as seen from the side on which it rocks: this side, with the other one.
template <Number T>
struct Block : BlockSide<T> {
    T restitution; ///< r: ratio of the energies after and before an impact [1]
    BlockSide<T> other;

    Block(const BlockSide<T>& side, const T& r, const BlockSide<T>& other_side)
        : BlockSide<T>(side), restitution(r), other(other_side)
    {}

    /// Symmetric, with size and frequency parameter 1; the slenderness is arctan(b / h).
    Block(const T& alpha, const T& r) : BlockSide<T>{alpha}, restitution(r), other{alpha} {}

    /// The same block as seen from the other side.
    Block turned() const { return {other, restitution, *this}; }

    /// Per lane: whether the sides are equal.
    mask_t<T> is_symmetric() const { return *this == other; }

    /// The ratio of the rates after and before an impact, each in units of the p of its side:
    /// sqrt(r R_i / R_j) from this side i to the other side j. The energy, m g R u^2 / 2, changes
    /// by the factor r.
    T rate_ratio() const { return sqrt(restitution * (this->size / other.size)); }
};

/// The side from which a block is seen.
template <Number T>
const BlockSide<T>& side_of(const Block<T>& block)
{
    return block;
}

/// The block with the members combine(a member of each of these blocks).
template <class Combine, Number... T>
auto combined(const Combine& combine, const Block<T>&... blocks)
    -> Block<decltype(combine(blocks.restitution...))>
{
    return {combined(combine, side_of(blocks)...), combine(blocks.restitution...),
            combined(combine, blocks.other...)};
}

/// The block, given as seen from its side plus, as seen from a side, +1 or -1.
template <Number T>
    requires(lanes_v<T> == 1)
Block<T> seen_from(const T& side, const Block<T>& block)
{
    return side < 0 ? block.turned() : block;
}

/// The same block in numbers of another type.
template <Number T>
Block<T> block_in(const Block<double>& block)
{
    return combined([](double member) { return T(member); }, block);
}

/// The state of a rocking block. The side is stored separately, because theta is 0 at uplift and
/// after an impact.
template <Number T>
struct State {
    T tilt; ///< |theta| [rad]
    T rate; ///< d|theta| / d tau, positive outward, tau = p t with the p of the side [rad]
    T side; ///< +1 or -1: the sign of theta. A positive ground acceleration pushes the block
            ///< towards its side minus.
};

template <Number T>
BlockSide<estimate_t<T>> estimate_of(const BlockSide<T>& side)
{
    return combined([](const T& member) { return estimate_of(member); }, side);
}
template <Number T>
Block<estimate_t<T>> estimate_of(const Block<T>& block)
{
    return combined([](const T& member) { return estimate_of(member); }, block);
}

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

/// Just after an impact: the block pivots about its other corner, its rate is multiplied by
/// Block::rate_ratio(), which is sqrt(r) if the block is symmetric (Eq. 40). The sign of theta'
/// does not change, so the inward rate becomes outward.
template <Number T>
State<T> state_after_impact(const State<T>& before, const T& rate_ratio)
{
    return {.tilt = T(0), .rate = -rate_ratio * before.rate, .side = -before.side};
}

} // namespace overturn
