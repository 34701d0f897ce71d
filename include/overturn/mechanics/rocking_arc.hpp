// One arc of free rocking: the motion about one corner between impacts, in closed form (Eqs. 21-45
// in real form). With y = alpha - |theta|, y'' = sin y, and q = 4 sin^2(y/2) - y'^2 is conserved
// (Eq. 21); linear theory: y'' = y, q = y^2 - y'^2. Scalars only.
#pragma once

#include "overturn/mechanics/block.hpp"

#include <boost/math/special_functions/ellint_rf.hpp>

#include <limits>

namespace overturn {

/// The motion from a given state until the block strikes the ground or lies flat, |theta| = pi/2.
///
/// The modulus of the paper's elliptic functions, 2p/sqrt(q0), is imaginary or above 1 for every
/// block and infinite at q0 = 0. With the hyperbolic amplitude s, the real argument of the
/// hyperbolic cosine or sine that solves the linear theory,
///
///     q > 0, turns back below the top:  tan(y/2) = +-M cosh s,  y' = +-sqrt(q) cos(y/2) sinh s
///     q < 0, passes the top:            tan(y/2) = +-M sinh s,  y' = +-sqrt(-q) cos(y/2) cosh s
///
///     tau = sinh s R_F(1, 1 + m sinh^2 s, cosh^2 s) / omega
///
/// with y, 1, s instead of tan(y/2), cos(y/2), tau in the linear theory; tau is measured from the
/// turn or from the top. R_F is Carlson's elliptic integral (tau is F(gd s) with the modulus
/// sqrt(1 - m), which is too close to 1 to represent m accurately);
///
///     q > 0:  m = q/4,            M = sqrt(m / (1 - m)),   omega = 1
///     q < 0:  m = -q / (4 - q),   M = sqrt(m),             omega = sqrt(1 - q/4)
///
/// On the separatrix, q = 0, tan(y/4) grows or decays exponentially in tau. Times in 1/p.
template <Theory theory, Number T>
    requires(lanes_v<T> == 1)
class RockingArc {
public:
    /// begin: a tilt from 0 to pi/2. q: as above, for this state; near the separatrix it is more
    /// accurate than a value computed from the state in T, see conserved_q().
    RockingArc(const State<T>& begin, const T& slenderness, const T& q)
        : slenderness_(slenderness), q_(q), side_(begin.side)
    {
        const T y = slenderness - begin.tilt;
        const T gained = square_gained(begin.tilt) + begin.rate * begin.rate;
        impact_speed_ = gained > 0 ? T(sqrt(gained)) : T(0);
        const T inward = -begin.rate;
        root_ = sqrt(abs(q));
        scale_ = root_;
        if (!is_linear) {
            m_ = q > 0 ? T(q / 4) : T(-q / (4 - q));
            scale_ = q > 0 ? T(sqrt(m_ / (1 - m_))) : T(sqrt(m_));
            omega_ = q > 0 ? T(1) : T(sqrt(1 - q / 4));
        }
        if (turns()) {
            direction_ = y < 0 ? -1 : 1;
            after_origin_ = elapsed(direction_ * inward / (root_ * cosine(y)));
        } else if (passes()) {
            direction_ = inward < 0 ? -1 : 1;
            after_origin_ = elapsed(direction_ * measure(y) / scale_);
        } else {
            direction_ = (y < 0) == (inward < 0) ? 1 : -1; // away from the top or towards it
            begin_ = y;
        }
    }

    /// The state at `time` after the beginning, which must not exceed the time to impact or fall.
    State<T> at(const T& time) const
    {
        if (!turns() && !passes()) {
            const T y = from_quarter(quarter(begin_) * exp(direction_ * time));
            return {.tilt = slenderness_ - y,
                    .rate = -direction_ * speed_on_separatrix(y),
                    .side = side_};
        }
        const T s = amplitude_at(after_origin_ + time);
        const T tilt = tilt_at(s);
        const T along = turns() ? sinh(s) : cosh(s);
        const T rate = -direction_ * root_ * cosine(slenderness_ - tilt) * along;
        return {.tilt = tilt, .rate = rate, .side = side_};
    }

    /// The time until the block strikes the ground; infinite if it does not.
    T time_to_impact() const
    {
        const T never = std::numeric_limits<T>::infinity();
        if (turns() || passes()) {
            return direction_ > 0 ? T(elapsed(sinh_at_impact()) - after_origin_) : never;
        }
        return direction_ > 0 && begin_ > 0 ? T(log(quarter(slenderness_) / quarter(begin_)))
                                            : never;
    }

    /// The time until |theta| = pi/2; infinite if it is not reached.
    T time_to_fall() const
    {
        const T never = std::numeric_limits<T>::infinity();
        if (turns() || passes()) {
            return direction_ < 0 ? T(elapsed(sinh_where_flat()) - after_origin_) : never;
        }
        const T flat = slenderness_ - pi<T>() / 2;
        return direction_ > 0 && begin_ < 0 ? T(log(quarter(flat) / quarter(begin_))) : never;
    }

    /// The inward speed at which the block strikes the ground, if it does (Eq. 39).
    const T& impact_speed() const { return impact_speed_; }

    const T& q() const { return q_; }
    const T& side() const { return side_; }

private:
    bool turns() const { return q_ > 0; }
    bool passes() const { return q_ < 0; }

    static constexpr bool is_linear = theory == Theory::linear;

    /// tan(y/2) and its inverse; cos(y/2). In the linear theory, y and 1.
    static T measure(const T& y) { return is_linear ? y : T(tan(y / 2)); }
    static T from_measure(const T& measure) { return is_linear ? measure : T(2 * atan(measure)); }
    static T cosine(const T& y) { return is_linear ? T(1) : T(cos(y / 2)); }

    /// On the separatrix: tan(y/4), which is exponential in time; its inverse; |y'|. In the linear
    /// theory, y.
    static T quarter(const T& y) { return is_linear ? y : T(tan(y / 4)); }
    static T from_quarter(const T& quarter) { return is_linear ? quarter : T(4 * atan(quarter)); }
    static T speed_on_separatrix(const T& y) { return is_linear ? y : T(2 * sin(y / 2)); }

    /// The increase of the squared speed from this tilt to the ground,
    /// 4 sin^2(alpha/2) - 4 sin^2((alpha - tilt)/2) (Eq. 5), without cancellation.
    T square_gained(const T& tilt) const
    {
        return is_linear ? T(tilt * (2 * slenderness_ - tilt))
                         : T(4 * sin(tilt / 2) * sin(slenderness_ - tilt / 2));
    }

    T sinh_at_impact() const
    {
        return turns() ? T(impact_speed_ / (root_ * cosine(slenderness_)))
                       : T(measure(slenderness_) / scale_);
    }

    T sinh_where_flat() const
    {
        const T y = pi<T>() / 2 - slenderness_;
        const T rate = speed_on_separatrix(y);
        return turns() ? T(sqrt(rate * rate - q_) / (root_ * cosine(y))) : T(measure(y) / scale_);
    }

    /// The time since the turn or the top.
    T elapsed(const T& sinh_s) const
    {
        if constexpr (is_linear) {
            return asinh(sinh_s);
        } else {
            const T square = sinh_s * sinh_s;
            return sinh_s * boost::math::ellint_rf(T(1), T(1 + m_ * square), T(1 + square)) /
                   omega_;
        }
    }

    /// The hyperbolic amplitude at this time since the turn or the top, by Newton's method. d tau /
    /// d s decreases from 1 / omega on, so that the iteration converges from below; the last step
    /// squares an error below sqrt(epsilon).
    T amplitude_at(const T& since) const
    {
        T s = since * omega_;
        if constexpr (!is_linear) {
            const T close = sqrt(std::numeric_limits<T>::epsilon());
            constexpr int most = 64; // at most seven in practice
            for (int i = 0; i < most; ++i) {
                const T sinh_s = sinh(s);
                const T step = (since - elapsed(sinh_s)) * omega_ * sqrt(1 + m_ * sinh_s * sinh_s);
                s += step;
                if (abs(step) <= close * abs(s)) {
                    break;
                }
            }
        }
        return s;
    }

    /// The tilt. The tangent of a difference avoids cancellation near an impact, where y is close
    /// to alpha.
    T tilt_at(const T& s) const
    {
        if (direction_ < 0) {
            return slenderness_ + from_measure(scale_ * (turns() ? cosh(s) : sinh(s)));
        }
        const T at_impact = asinh(sinh_at_impact());
        const T sum = (at_impact + s) / 2;
        const T difference = (at_impact - s) / 2;
        const T apart = 2 * scale_ * sinh(difference) * (turns() ? sinh(sum) : cosh(sum));
        const T now = scale_ * (turns() ? cosh(s) : sinh(s));
        return is_linear ? apart : from_measure(apart / (1 + measure(slenderness_) * now));
    }

    T slenderness_;
    T q_;
    T side_;
    T root_;         // sqrt |q|
    T m_ = T(0);     // see above
    T scale_;        // M
    T omega_ = T(1); // [p]
    T direction_;    // the sign above
    T impact_speed_;
    T after_origin_ = T(0); // time at which the arc begins, measured from the turn or the top
    T begin_ = T(0);        // y at the beginning, if q = 0
};

} // namespace overturn
