// One arc of free rocking: the motion about one corner between impacts, in closed form (Eqs. 21-45
// in real form). With y = alpha - |theta|, y'' = sin y, and q = 4 sin^2(y/2) - y'^2 is conserved
// (Eq. 21); linear theory: y'' = y, q = y^2 - y'^2. Scalars only.
#pragma once

#include "overturn/mechanics/theory/theories.hpp"

#include <boost/math/special_functions/ellint_rf.hpp>

#include <limits>

namespace overturn {

template <Number T>
T carlson_integral(const T& x, const T& y, const T& z)
{
    return boost::math::ellint_rf(x, y, z);
}

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
    using Form = typename Equations<theory>::template Arc<T>;

public:
    /// begin: a tilt from 0 to pi/2. q: as above, for this state; near the separatrix it is more
    /// accurate than a value computed from the state in T, see conserved_q().
    RockingArc(const State<T>& begin, const BlockSide<T>& side, const T& q)
        : slenderness_(side.slenderness), q_(q), side_(begin.side), form_(q)
    {
        const T y = slenderness_ - begin.tilt;
        const T gained = Form::square_gained(slenderness_, begin.tilt) + begin.rate * begin.rate;
        impact_speed_ = gained > 0 ? T(sqrt(gained)) : T(0);
        const T inward = -begin.rate;
        root_ = sqrt(abs(q));
        if (turns()) {
            direction_ = y < 0 ? -1 : 1;
            after_origin_ = form_.elapsed(direction_ * inward / (root_ * Form::cosine(y)));
        } else if (passes()) {
            direction_ = inward < 0 ? -1 : 1;
            after_origin_ = form_.elapsed(direction_ * Form::measure(y) / form_.scale);
        } else {
            direction_ = (y < 0) == (inward < 0) ? 1 : -1; // away from the top or towards it
            begin_ = y;
        }
    }

    /// The state at `time` after the beginning, which must not exceed the time to impact or fall.
    State<T> at(const T& time) const
    {
        if (!turns() && !passes()) {
            const T y = Form::from_quarter(Form::quarter(begin_) * exp(direction_ * time));
            return {.tilt = slenderness_ - y,
                    .rate = -direction_ * Form::speed_on_separatrix(y),
                    .side = side_};
        }
        const T s = form_.amplitude_at(after_origin_ + time);
        const T tilt = tilt_at(s);
        const T along = turns() ? sinh(s) : cosh(s);
        const T rate = -direction_ * root_ * Form::cosine(slenderness_ - tilt) * along;
        return {.tilt = tilt, .rate = rate, .side = side_};
    }

    /// The time until the block strikes the ground; infinite if it does not.
    T time_to_impact() const
    {
        const T never = std::numeric_limits<T>::infinity();
        if (turns() || passes()) {
            return direction_ > 0 ? T(form_.elapsed(sinh_at_impact()) - after_origin_) : never;
        }
        return direction_ > 0 && begin_ > 0
                   ? T(log(Form::quarter(slenderness_) / Form::quarter(begin_)))
                   : never;
    }

    /// The time until |theta| = pi/2; infinite if it is not reached.
    T time_to_fall() const
    {
        const T never = std::numeric_limits<T>::infinity();
        if (turns() || passes()) {
            return direction_ < 0 ? T(form_.elapsed(sinh_where_flat()) - after_origin_) : never;
        }
        const T flat = slenderness_ - pi<T>() / 2;
        return direction_ > 0 && begin_ < 0 ? T(log(Form::quarter(flat) / Form::quarter(begin_)))
                                            : never;
    }

    /// The inward speed at which the block strikes the ground, if it does (Eq. 39).
    const T& impact_speed() const { return impact_speed_; }

    const T& q() const { return q_; }
    const T& side() const { return side_; }

private:
    bool turns() const { return q_ > 0; }
    bool passes() const { return q_ < 0; }

    T sinh_at_impact() const
    {
        return turns() ? T(impact_speed_ / (root_ * Form::cosine(slenderness_)))
                       : T(Form::measure(slenderness_) / form_.scale);
    }

    T sinh_where_flat() const
    {
        const T y = pi<T>() / 2 - slenderness_;
        const T rate = Form::speed_on_separatrix(y);
        return turns() ? T(sqrt(rate * rate - q_) / (root_ * Form::cosine(y)))
                       : T(Form::measure(y) / form_.scale);
    }

    /// The tilt. The tangent of a difference avoids cancellation near an impact, where y is close
    /// to alpha.
    T tilt_at(const T& s) const
    {
        if (direction_ < 0) {
            return slenderness_ + Form::from_measure(form_.scale * (turns() ? cosh(s) : sinh(s)));
        }
        const T at_impact = asinh(sinh_at_impact());
        const T sum = (at_impact + s) / 2;
        const T difference = (at_impact - s) / 2;
        const T apart = 2 * form_.scale * sinh(difference) * (turns() ? sinh(sum) : cosh(sum));
        const T now = form_.scale * (turns() ? cosh(s) : sinh(s));
        return Form::tilt_at(slenderness_, apart, now);
    }

    T slenderness_;
    T q_;
    T side_;
    T root_; // sqrt |q|
    Form form_;
    T direction_; // the sign above
    T impact_speed_;
    T after_origin_ = T(0); // time at which the arc begins, measured from the turn or the top
    T begin_ = T(0);        // y at the beginning, if q = 0
};

} // namespace overturn
