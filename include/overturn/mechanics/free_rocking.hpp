// Free rocking after the pulse (Eqs. 21-46): a sequence of arcs, with a loss at each impact between
// them, until the block lies flat. A block that does not fall strikes infinitely often in a finite
// time, unless it loses no energy. Scalars only.
#pragma once

#include "overturn/mechanics/energy_criteria.hpp"
#include "overturn/mechanics/rocking_arc.hpp"

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <limits>
#include <type_traits>

namespace overturn {

/// 113 bits.
using Quad = boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                           boost::multiprecision::et_off>;
template <>
struct number_traits<Quad> : scalar_number_traits<Quad> {};

/// The type in which q is computed. Near the separatrix, q loses most digits of the state, and the
/// time that a block spends near the top depends on the logarithm of q.
template <class T>
using MoreExact = std::conditional_t<std::is_floating_point_v<T>, Quad, T>;

/// q0 of a state (Eq. 12) [rad^2], accurate to the last digits of T unless the state is within
/// epsilon^2 of the separatrix:
///
///     q0 = 4 sin^2((alpha - |theta|) / 2) - theta'^2
///
/// or (alpha - |theta|)^2 - theta'^2 in the linear theory.
template <Theory theory, Number T, Number Q = MoreExact<T>>
Q conserved_q(const State<T>& state, const BlockSide<T>& side)
{
    const Q c = Equations<theory>::separatrix_rate(side_in<Q>(side), Q(state.tilt));
    const Q rate(state.rate);
    return (c - rate) * (c + rate);
}

/// q of a block at rest.
template <Theory theory, Number Q, Number T>
Q q_max_of(const BlockSide<T>& side)
{
    const Q largest = Equations<theory>::separatrix_rate(side_in<Q>(side), Q(0));
    return largest * largest;
}

/// q0 just after an impact on this side i, for the other side j. The energy m g R (q_max - q) / 2
/// changes by the factor r.
template <Number Q, Number T>
Q q_after_impact(const Block<T>& block, const Q& q, const Q& q_max, const Q& q_max_of_other)
{
    const Q kept = Q(block.restitution) * (Q(block.size) / Q(block.other.size)); // r R_i / R_j
    return q_max * (q_max_of_other / q_max - kept) + kept * q;
}
template <Theory theory, Number Q, Number T>
Q q_after_impact(const Block<T>& block, const Q& q)
{
    return q_after_impact(block, q, q_max_of<theory, Q>(block), q_max_of<theory, Q>(block.other));
}

/// Free rocking, one arc at a time; times since the beginning, in the unit of 1 /
/// Block::frequency_parameter, which is 1/p if the block is symmetric. Q: the type in which q is
/// computed.
template <Theory theory, Number T, Number Q = MoreExact<T>>
class FreeRocking {
public:
    /// block: as seen from the side on which it rocks at the beginning.
    FreeRocking(const State<T>& begin, const Block<T>& block)
        : block_(block), begin_(0), q_(conserved_q<theory, T, Q>(begin, block)),
          arc_(begin, block, T(q_))
    {}

    /// The current arc, the time at which it begins, and the number of impacts before it.
    const RockingArc<theory, T>& arc() const { return arc_; }
    const T& begin() const { return begin_; }
    int impacts() const { return impacts_; }

    /// As seen from the side of the current arc.
    const Block<T>& block() const { return block_; }

    /// The time at which the arc ends with an impact or with the block flat; infinite if never.
    T impact_time() const { return begin_ + arc_.time_to_impact() / block_.frequency_parameter; }
    T fall_time() const { return begin_ + arc_.time_to_fall() / block_.frequency_parameter; }

    /// The state of the arc at this time.
    State<T> at(const T& time) const
    {
        const T since = (time - begin_) * block_.frequency_parameter;
        return arc_.at(since > 0 ? since : T(0));
    }

    /// Advances to the arc after the impact, which must exist (Eqs. 40, 41).
    void strike()
    {
        begin_ = impact_time();
        ++impacts_;
        const State<T> upright{
            .tilt = T(0), .rate = block_.rate_ratio() * arc_.impact_speed(), .side = -arc_.side()};
        q_ = q_after_impact<theory>(block_, q_);
        block_ = block_.turned();
        arc_ = RockingArc<theory, T>(upright, block_, T(q_));
    }

private:
    Block<T> block_;
    T begin_;
    int impacts_ = 0;
    Q q_;
    RockingArc<theory, T> arc_;
};

/// The largest tilt of a block that does not fall, over alpha of its side, from this state on: that
/// of its next two turns, before or after an impact. Every later turn is lower.
template <Theory theory, Number T>
T largest_free_tilt(const State<T>& state, const Block<T>& block)
{
    if (state.tilt == 0 && state.rate == 0) {
        return T(0); // without the rounding errors of the formulas below
    }
    const auto turn = [](const T& slenderness, const T& q) -> T {
        const T distance = q > 0 ? T(sqrt(q)) : T(0); // from the top, at the turn
        const T top = Equations<theory>::distance_at(distance);
        return lesser<T>(greater<T>(slenderness - top, 0), slenderness) / slenderness;
    };
    const T q = conserved_q<theory, T, T>(state, block);
    if (state.rate > 0 && block.is_symmetric()) {
        return turn(block.slenderness, q);
    }
    const T q_on_other = q_after_impact<theory>(block, q);
    const T on_other = turn(block.other.slenderness, q_on_other);
    if (block.is_symmetric()) {
        return on_other;
    }
    const T next =
        state.rate > 0 ? q : q_after_impact<theory>(block.turned(), q_on_other); // on this side
    return greater<T>(on_other, turn(block.slenderness, next));
}

/// The time from this state until a block that overturns lies flat, |theta| = pi/2, in the unit of
/// FreeRocking. Infinite if the state cannot be distinguished from the boundary in Q, the type in
/// which q is computed.
template <Theory theory, Number Q, Number T>
T time_to_lie_flat(const State<T>& state, const Block<T>& block)
{
    constexpr int most_impacts = 2; // see safe_rates()
    FreeRocking<theory, T, Q> rocking(state, block);
    while (!isinf(rocking.impact_time()) && rocking.impacts() < most_impacts) {
        rocking.strike();
    }
    return rocking.fall_time();
}

/// The duration of rocking of a block that leaves the ground at the rate v, and after each arc at
/// sqrt(r) times the previous rate: see Equations::sum_of_half_periods(). Term k of all half
/// periods is a geometric series.
template <Theory theory, Number T>
T sum_of_half_periods(const T& v, const T&, const Block<T>& block)
{
    const T log_r = log(block.restitution);
    return Equations<theory>::sum_of_half_periods(
        block, v, [&](int k) -> T { return -1 / expm1(log_r * (2 * k + 1) / 2); });
}

/// The same sum for r close to 1, to first order in 1 - r: twice the integral of T(v) / v, divided
/// by -log r, plus half of the first term. q: its value at the first rate v.
template <Theory theory, Number T>
T integral_of_half_periods(const T& v, const T& q, const Block<T>& block)
{
    const auto half_period = [&](const T& rate, const T& gained) -> T { // gained: increase of q
        const State<T> upright{.tilt = T(0), .rate = rate, .side = T(1)};
        return RockingArc<theory, T>(upright, block, q + gained).time_to_impact();
    };
    const T root = sqrt(std::numeric_limits<T>::epsilon());
    const T fine = root * sqrt(root);
    boost::math::quadrature::tanh_sinh<T> integrator;
    const T integral = integrator.integrate(
        [&](const T& share, const T& from_end) -> T { // from_end: distance from 1, or from 0
            const bool near_first = from_end > 0;
            const T kept = near_first ? T(1 - from_end) : share;
            const T lost = near_first ? T(from_end * (2 - from_end)) : T((1 - share) * (1 + share));
            return half_period(T(v * kept), T(v * v * lost)) / kept;
        },
        T(0), T(1), fine);
    return 2 * integral / -log(block.restitution) + half_period(v, T(0)) / 2;
}

/// A block that leaves the ground, with q accurate as in RockingArc.
template <Number T>
struct PostImpact {
    T rate;
    T q;
    Block<T> block;
    T q_max; ///< of this side
    T q_max_of_other;

    /// The next one.
    PostImpact after_impact() const
    {
        return {rate * block.rate_ratio(), q_after_impact(block, q, q_max, q_max_of_other),
                block.turned(), q_max_of_other, q_max};
    }
};

/// The duration of all flights, in the unit of FreeRocking. sum(rate, q, block): that of a
/// symmetric block. On each of two different sides, the rate falls by r from one flight to the
/// next, as that of a symmetric block with the restitution r^2.
template <Number T, class Sum>
T sum_on_both_sides(const PostImpact<T>& post_impact, const Sum& sum)
{
    const Block<T>& block = post_impact.block;
    if (block.is_symmetric()) {
        return sum(post_impact.rate, post_impact.q, block) / block.frequency_parameter;
    }
    const auto on_one = [&](const PostImpact<T>& one) -> T {
        const Block<T> symmetric{one.block.slenderness, block.restitution * block.restitution};
        return sum(one.rate, one.q, symmetric) / one.block.frequency_parameter;
    };
    return on_one(post_impact) + on_one(post_impact.after_impact());
}

/// The time at which a block comes to rest, in the unit of FreeRocking; infinite if it falls, stays
/// on its edge forever, or rocks forever without energy loss.
template <Theory theory, Number T>
T time_of_rest(const State<T>& begin, const Block<T>& block)
{
    const T never = std::numeric_limits<T>::infinity();
    const T r = block.restitution;
    FreeRocking<theory, T> rocking(begin, block);
    // A block with two different sides may overturn after two impacts.
    for (int impacts = block.is_symmetric() ? 1 : 2; impacts > 0; --impacts) {
        if (isinf(rocking.impact_time())) {
            return never;
        }
        rocking.strike();
    }
    T time = rocking.begin();
    const auto q_max = [](const BlockSide<T>& side) {
        return T(q_max_of<theory, MoreExact<T>>(side));
    };
    PostImpact<T> post_impact{rocking.arc().at(T(0)).rate, rocking.arc().q(), rocking.block(),
                              q_max(rocking.block()), q_max(rocking.block().other)};
    if (post_impact.rate == 0) {
        return time;
    }
    if (!(post_impact.q > 0) || !(r < 1)) {
        return never;
    }
    // Each bounce that is followed individually shortens the series. About as many are followed as
    // terms remain, so the work is proportional to 1 / sqrt(1 - r). If that is too much, r is so
    // close to 1 that the sum is an integral over the rate, whose logarithm decreases by half of
    // -log r per bounce.
    const int digits = std::numeric_limits<T>::digits;
    constexpr int most_bounces = 200'000;
    for (int bounces = 0; digits * post_impact.q_max > bounces * post_impact.q; ++bounces) {
        if (bounces == most_bounces) {
            return time + sum_on_both_sides(post_impact, integral_of_half_periods<theory, T>);
        }
        const State<T> upright{.tilt = T(0), .rate = post_impact.rate, .side = T(1)};
        const RockingArc<theory, T> arc(upright, post_impact.block, post_impact.q);
        time += arc.time_to_impact() / post_impact.block.frequency_parameter;
        post_impact = post_impact.after_impact();
    }
    return time + sum_on_both_sides(post_impact, sum_of_half_periods<theory, T>);
}

} // namespace overturn
