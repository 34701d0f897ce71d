// The linearisation of Eq. 47 for slender blocks: sin y = y, cos y = 1.
#pragma once

#include "overturn/mechanics/block.hpp"
#include "overturn/mechanics/ground.hpp"
#include "overturn/mechanics/rocking_series.hpp"
#include "overturn/mechanics/theory/theory.hpp"

namespace overturn {

/// The functions are those of Equations<Theory::nonlinear>.
template <>
struct Equations<Theory::linear> {
    static constexpr bool moment_is_at_most_distance = true;
    static constexpr bool has_one_top = true;
    static constexpr bool has_contact_forces = false;

    template <Number T>
    static T uplift_acceleration(const BlockSide<T>& side)
    {
        return side.slenderness;
    }

    /// |theta|'' = -(y + B); with a vertical motion, y is multiplied by the gravity.
    template <Number T, class Push>
    static T acceleration(const BlockSide<T>& side, const T& tilt, const Push& push)
    {
        const T y = side.slenderness - tilt;
        if constexpr (has_gravity<Push>) {
            return -fma(push.gravity, y, push.horizontal);
        } else {
            return -(y + push);
        }
    }

    template <Number T>
    static T lever(const BlockSide<T>&, const T&)
    {
        return T(1);
    }

    template <Number T, class Push>
    static T stiffness(const BlockSide<T>&, const T&, const Push& push)
    {
        return gravity_of(push, T(1));
    }

    static double largest_stiffness(double) { return 1; }
    static double lever_growth(const BlockSide<double>&) { return 0; }

    template <Number T>
    static T separatrix_rate(const BlockSide<T>& side, const T& tilt)
    {
        return side.slenderness - tilt;
    }
    template <Number T>
    static T separatrix_slope(const BlockSide<T>&, const T&)
    {
        return T(-1);
    }

    template <Number T>
    static T distance_at(const T& separatrix_rate)
    {
        return separatrix_rate;
    }

    /// v' = unit^2 (-y - B).
    template <int order, Number T, class Push>
    static RockingSeries<order, T> series(const BlockSide<T>& side, const T& tilt, const T& rate,
                                          const Push& push, const T& unit)
    {
        using S = scalar_t<T>;
        const T square = unit * unit;
        const auto& horizontal = horizontal_of(push);
        const T push_0 = coefficient<0>(horizontal);
        RockingSeries<order, T> series;
        auto& x = series.tilt;
        auto& v = series.rate;
        x[0] = tilt;
        v[0] = rate;
        x[1] = rate;
        const T y = tilt - side.slenderness;
        if constexpr (has_gravity<Push>) {
            v[1] = square * fma(push.gravity.start, y, -push_0);
        } else {
            v[1] = square * (y - push_0);
        }
        x[2] = v[1] * T(0.5);
        unrolled<order - 1>([&]<int i>() {
            constexpr int k = i + 1;
            T pull = x[k];
            if constexpr (has_gravity<Push>) {
                pull = fma(push.gravity.start, x[k], push.gravity.slope * (k == 1 ? y : x[k - 1]));
            }
            v[k + 1] = (pull - coefficient<k>(horizontal)) * (square * T(S(1) / (k + 1)));
            x[k + 2] = v[k + 1] * T(S(1) / (k + 2));
        });
        return series;
    }

    /// Here a term is almost free, and the terms of the motion decrease faster than any geometric
    /// series.
    static constexpr int terms_for_errors = 3;
    template <Number T>
    static T ratio_of_terms(const T& ratio)
    {
        return lesser<T>(ratio, T(scalar_t<T>(1) / 3));
    }

    /// With y, 1 and s in place of tan(y/2), cos(y/2) and tau.
    template <Number T>
    struct Arc {
        T scale;

        explicit Arc(const T& q) : scale(sqrt(abs(q))) {}

        static T measure(const T& y) { return y; }
        static T from_measure(const T& measure) { return measure; }
        static T cosine(const T&) { return T(1); }
        static T tilt_at(const T&, const T& apart, const T&) { return apart; }
        static T quarter(const T& y) { return y; }
        static T from_quarter(const T& quarter) { return quarter; }
        static T speed_on_separatrix(const T& y) { return y; }
        static T square_gained(const T& alpha, const T& tilt) { return tilt * (2 * alpha - tilt); }
        T elapsed(const T& sinh_s) const { return asinh(sinh_s); }
        T amplitude_at(const T& since) const { return since; }
    };

    /// The half period is 2 artanh(v / alpha).
    template <Number T>
    static T sum_of_half_periods(const BlockSide<T>& side, const T& v, const auto& share)
    {
        const T epsilon = std::numeric_limits<T>::epsilon();
        const T ratio = v / side.slenderness;
        T sum = share(0);
        T power(1);
        for (int k = 1; power > epsilon; ++k) {
            power *= ratio * ratio;
            sum += power / (2 * k + 1) * share(k);
        }
        return 2 * ratio * sum;
    }
};

} // namespace overturn
