// Free rocking after the pulse (Eqs. 21-46): a sequence of arcs, with a loss at each impact between
// them, until the block lies flat. A block that does not fall strikes infinitely often in a finite
// time, unless it loses no energy. Scalars only.
#pragma once

#include "overturn/mechanics/energy_criteria.hpp"
#include "overturn/mechanics/rocking_arc.hpp"

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cmath>
#include <limits>
#include <type_traits>

namespace overturn {

/// The type in which q is computed. Near the separatrix, q loses most digits of the state, and the
/// time that a block spends near the top depends on the logarithm of q.
template <class T>
using MoreExact = std::conditional_t<
    std::is_floating_point_v<T>,
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                  boost::multiprecision::et_off>,
    T>;

/// q0 of a state (Eq. 12) [rad^2], accurate to the last digits of T unless the state is within
/// epsilon^2 of the separatrix:
///
///     q0 = 4 sin^2((alpha - |theta|) / 2) - theta'^2
///
/// or (alpha - |theta|)^2 - theta'^2 in the linear theory.
template <Theory theory, class T>
MoreExact<T> conserved_q(const State<T>& state, const T& slenderness)
{
    using std::sin;
    const MoreExact<T> y = MoreExact<T>(slenderness) - MoreExact<T>(state.tilt);
    const MoreExact<T> rate(state.rate);
    MoreExact<T> c = y;
    if constexpr (theory == Theory::nonlinear) {
        c = 2 * sin(MoreExact<T>(y / 2));
    }
    return (c - rate) * (c + rate);
}

/// The paper's restitution: the same energy ratio at every impact. Other models may depend on the
/// number of the impact, starting at 1, and on the side from which the block strikes.
template <Number T>
struct ConstantRestitution {
    T ratio; ///< r [1]

    T operator()(int, const T&) const { return ratio; }
};

/// Free rocking, one arc at a time; times in 1/p since the beginning.
template <Theory theory, Number T, class Restitution = ConstantRestitution<T>>
class FreeRocking {
public:
    FreeRocking(const State<T>& begin, const T& slenderness, const Restitution& restitution)
        : slenderness_(slenderness), restitution_(restitution), begin_(0),
          q_(conserved_q<theory>(begin, slenderness)), arc_(begin, slenderness, T(q_))
    {}

    /// The current arc, the time at which it begins, and the number of impacts before it.
    const RockingArc<theory, T>& arc() const { return arc_; }
    const T& begin() const { return begin_; }
    int impacts() const { return impacts_; }

    /// The time at which the arc ends with an impact or with the block flat; infinite if never.
    T impact_time() const { return begin_ + arc_.time_to_impact(); }
    T fall_time() const { return begin_ + arc_.time_to_fall(); }

    /// Advances to the arc after the impact, which must exist (Eqs. 40, 41).
    void strike()
    {
        using std::sqrt;
        begin_ = impact_time();
        ++impacts_;
        const T r = restitution_(impacts_, arc_.side());
        const State<T> upright{
            .tilt = T(0), .rate = sqrt(r) * arc_.impact_speed(), .side = -arc_.side()};
        // q_max - q is multiplied by r.
        const MoreExact<T> at_rest = conserved_q<theory>({T(0), T(0), T(1)}, slenderness_);
        q_ = at_rest * (1 - MoreExact<T>(r)) + MoreExact<T>(r) * q_;
        arc_ = RockingArc<theory, T>(upright, slenderness_, T(q_));
    }

private:
    T slenderness_;
    Restitution restitution_;
    T begin_;
    int impacts_ = 0;
    MoreExact<T> q_;
    RockingArc<theory, T> arc_;
};

/// The largest tilt of a block that does not fall, from this state on [rad]: that of its next turn,
/// before or after an impact. Every later turn is lower.
template <Theory theory, Number T>
T largest_free_tilt(const State<T>& state, const Block<T>& block)
{
    using std::asin;
    using std::sqrt;
    if (state.tilt == 0 && state.rate == 0) {
        return T(0); // without the rounding errors of the formulas below
    }
    const T c = separatrix_rate<theory>(state.tilt, block.slenderness);
    const T largest = separatrix_rate<theory>(T(0), block.slenderness);
    const T q = (c - state.rate) * (c + state.rate);
    const T r = block.restitution;
    const T q_at_turn = state.rate > 0 ? q : T(largest * largest * (1 - r) + r * q);
    const T distance = q_at_turn > 0 ? T(sqrt(q_at_turn)) : T(0); // from the top, at the turn
    const T top = theory == Theory::linear ? distance : T(2 * asin(distance / 2));
    return lesser<T>(greater<T>(block.slenderness - top, T(0)), block.slenderness);
}

/// The time from this state until a block that overturns lies flat, |theta| = pi/2 [1/p]. Infinite
/// if the state cannot be distinguished from the boundary in T.
template <Theory theory, Number T>
T time_to_lie_flat(const State<T>& state, const Block<T>& block)
{
    using std::sqrt;
    const T c = separatrix_rate<theory>(state.tilt, block.slenderness);
    const T q = (c - state.rate) * (c + state.rate);
    const RockingArc<theory, T> arc(state, block.slenderness, q);
    const T never = std::numeric_limits<T>::infinity();
    const T impact = arc.time_to_impact();
    if (impact == never) {
        return arc.time_to_fall();
    }
    const T largest = separatrix_rate<theory>(T(0), block.slenderness);
    const T r = block.restitution;
    const State<T> upright{.tilt = T(0), .rate = sqrt(r) * arc.impact_speed(), .side = -state.side};
    const T q_after = largest * largest * (1 - r) + r * q;
    return impact + RockingArc<theory, T>(upright, block.slenderness, q_after).time_to_fall();
}

/// The duration of rocking of a block that leaves the ground at the rate v, and after each arc at
/// sqrt(r) times the previous rate (the limit of Eq. 43): the sum of all half periods (Eq. 42)
/// [1/p]. r < 1, and v < 2 sin(alpha/2), the rate at which it would overturn. With s = sin(alpha),
/// c = cos(alpha), w = v^2 / 2s, Legendre's generating function gives the half period
///
///     T(v) = 2v/s sum of p[k] b[k],    b[k] = (2k)!! / (2k+1)!!,
///     p[0] = 1,   p[1] = w c/s,   (k+1) p[k+1] = (2k+1) (c/s) w p[k] + k w^2 p[k-1],
///
/// or 2 artanh(v / alpha) in the linear theory. Term k of all half periods is a geometric series.
/// The terms decrease like (v^2 / q_max)^k.
template <Theory theory, Number T>
T sum_of_half_periods(const T& v, const T& slenderness, const T& r)
{
    using std::cos;
    using std::expm1;
    using std::log;
    using std::sin;
    const T log_r = log(r);
    const auto share = [&](int k) -> T { return -1 / expm1(log_r * (2 * k + 1) / 2); };
    const T epsilon = std::numeric_limits<T>::epsilon();
    T sum = share(0);
    if constexpr (theory == Theory::linear) {
        const T ratio = v / slenderness;
        T power(1);
        for (int k = 1; power > epsilon; ++k) {
            power *= ratio * ratio;
            sum += power / (2 * k + 1) * share(k);
        }
        return 2 * ratio * sum;
    } else {
        const T s = sin(slenderness);
        const T w = v * v / (2 * s);
        const T slope = cos(slenderness) / s * w;
        T before(0);
        T p(1);
        T b(1);
        for (int k = 0; p * b > epsilon; ++k) {
            const T next = ((2 * k + 1) * slope * p + k * w * w * before) / (k + 1);
            before = p;
            p = next;
            b *= T(2 * k + 2) / (2 * k + 3);
            sum += p * b * share(k + 1);
        }
        return 2 * v / s * sum;
    }
}

/// The same sum for r close to 1, to first order in 1 - r: twice the integral of T(v) / v, divided
/// by -log r, plus half of the first term. q: its value at the first rate v.
template <Theory theory, Number T>
T integral_of_half_periods(const T& v, const T& q, const Block<T>& block)
{
    using std::log;
    using std::sqrt;
    const auto half_period = [&](const T& rate, const T& gained) -> T { // gained: increase of q
        const State<T> upright{.tilt = T(0), .rate = rate, .side = T(1)};
        return RockingArc<theory, T>(upright, block.slenderness, q + gained).time_to_impact();
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

/// The time at which a block comes to rest [1/p]; infinite if it falls, stays on its edge forever,
/// or rocks forever without energy loss.
template <Theory theory, Number T>
T time_of_rest(const State<T>& begin, const Block<T>& block)
{
    using std::isinf;
    using std::sqrt;
    const T never = std::numeric_limits<T>::infinity();
    const T r = block.restitution;
    FreeRocking<theory, T> rocking(begin, block.slenderness, ConstantRestitution<T>{r});
    if (isinf(rocking.impact_time())) {
        return never;
    }
    rocking.strike();
    T time = rocking.begin();
    T rate = rocking.arc().at(T(0)).rate;
    T q = rocking.arc().q();
    if (rate == 0) {
        return time;
    }
    if (!(q > 0) || !(r < 1)) {
        return never;
    }
    // Each bounce that is followed individually shortens the series. About as many are followed as
    // terms remain, so the work is proportional to 1 / sqrt(1 - r). If that is too much, r is so
    // close to 1 that the sum is an integral over the rate, whose logarithm decreases by half of
    // -log r per bounce.
    const T at_rest(conserved_q<theory>({T(0), T(0), T(1)}, block.slenderness));
    const int digits = std::numeric_limits<T>::digits;
    constexpr int most_bounces = 200'000;
    for (int bounces = 0; digits * at_rest > bounces * q; ++bounces) {
        if (bounces == most_bounces) {
            return time + integral_of_half_periods<theory>(rate, q, block);
        }
        const State<T> upright{.tilt = T(0), .rate = rate, .side = T(1)};
        time += RockingArc<theory, T>(upright, block.slenderness, q).time_to_impact();
        rate *= sqrt(r);
        q = at_rest * (1 - r) + r * q;
    }
    return time + sum_of_half_periods<theory>(rate, block.slenderness, r);
}

} // namespace overturn
