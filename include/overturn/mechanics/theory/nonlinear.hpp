// The rocking block of Eq. 47.
#pragma once

#include "overturn/mechanics/block.hpp"
#include "overturn/mechanics/ground.hpp"
#include "overturn/mechanics/rocking_series.hpp"
#include "overturn/mechanics/theory/theory.hpp"

namespace overturn {

/// Carlson's elliptic integral R_F, defined in rocking_arc.hpp: the kernels do not need it.
template <Number T>
T carlson_integral(const T& x, const T& y, const T& z);

/// Computes motion.rate[k + 1] and what it depends on for `first` <= k < `last`; all before are
/// known. s and c: see Equations::series().
template <int first, int last, int order, Number T>
void extend(RockingSeries<order, T>& motion, Coefficients<order, T>& s, Coefficients<order, T>& c,
            const auto& push)
{
    using S = scalar_t<T>;
    auto& x = motion.tilt;
    auto& v = motion.rate;
    unrolled<last - first>([&]<int i>() {
        constexpr int k = first + i;
        T c_v(0);
        T s_v(0);
        newest_last<k>([&]<int j>() {
            if constexpr (j == k / 2) { // the first term
                c_v = v[j] * c[k - 1 - j];
                s_v = v[j] * s[k - 1 - j];
            } else {
                c_v = fma(v[j], c[k - 1 - j], c_v);
                s_v = fma(v[j], s[k - 1 - j], s_v);
            }
        });
        s[k] = c_v * T(S(1) / k);
        c[k] = s_v * T(S(-1) / k);
        T s_k = s[k];
        if constexpr (has_gravity<std::remove_cvref_t<decltype(push)>>) {
            s_k = coefficient_of_product<k>(push.gravity, s);
        }
        const T push_c = coefficient_of_product<k>(horizontal_of(push), c);
        v[k + 1] = fma(s_k, T(S(1) / (k + 1)), push_c * T(S(-1) / (k + 1)));
        x[k + 2] = v[k + 1] * T(S(1) / (k + 2));
    });
}

template <>
struct Equations<Theory::nonlinear> {
    static constexpr bool moment_is_at_most_distance = true; // |sin y| <= |y|
    static constexpr bool has_one_top = true;
    static constexpr bool has_contact_forces = true;

    /// The ground acceleration over g that lifts a block at rest: tan(alpha) [1].
    template <Number T>
    static T uplift_acceleration(const BlockSide<T>& side)
    {
        const auto [sine, cosine] = sine_and_cosine(side.slenderness);
        return sine / cosine;
    }

    /// d^2|theta| / d tau^2 (Eq. 47), with the push B = side * ground acceleration / g:
    ///
    ///     |theta|'' = -(sin y + B cos y)
    ///
    /// With a vertical motion, sin y is multiplied by the gravity.
    template <Number T, class Push>
    static T acceleration(const BlockSide<T>& side, const T& tilt, const Push& push)
    {
        const auto [sine, cosine] = sine_and_cosine(T(side.slenderness - tilt));
        return -fma(horizontal_of(push), cosine, gravity_of(push, T(1)) * sine);
    }

    /// The factor on the push: cos y.
    template <Number T>
    static T lever(const BlockSide<T>& side, const T& tilt)
    {
        return sine_and_cosine(T(side.slenderness - tilt)).cosine;
    }

    /// d(|theta|'') / d|theta|, k = cos y - B sin y; with a vertical motion, cos y is multiplied by
    /// the gravity.
    template <Number T, class Push>
    static T stiffness(const BlockSide<T>& side, const T& tilt, const Push& push)
    {
        const auto [sine, cosine] = sine_and_cosine(T(side.slenderness - tilt));
        return fma(-horizontal_of(push), sine, gravity_of(push, T(1)) * cosine);
    }

    /// Upper bounds for bound_of_low_bounces(): of |k| under pushes up to `most`, and of the
    /// increase of the lever, over its value at the tilt 0, per tilt.
    static double largest_stiffness(double most) { return std::hypot(1, most); }
    static double lever_growth(const BlockSide<double>& side) { return std::tan(side.slenderness); }

    /// Signed distance to the top of the rocking arc, negative beyond the top, c = 2 sin(y / 2)
    /// [rad], and its slope d c / d|theta|, between -1 and 0 below the top.
    template <Number T>
    static T separatrix_rate(const BlockSide<T>& side, const T& tilt)
    {
        const T sine = sine_and_cosine(T((side.slenderness - tilt) * 0.5)).sine;
        return sine + sine;
    }
    template <Number T>
    static T separatrix_slope(const BlockSide<T>& side, const T& tilt)
    {
        return -sine_and_cosine(T((side.slenderness - tilt) * 0.5)).cosine;
    }

    /// The y > 0 at which c has this value.
    template <Number T>
    static T distance_at(const T& separatrix_rate)
    {
        return T(2 * asin(separatrix_rate / 2));
    }

    /// The series of the motion with this tilt [rad] and rate [rad per unit] at t = 0. push: the
    /// series of side * ground acceleration / g. unit: one unit of t [1/p].
    ///
    /// With s = sin(-y), c = cos y, v the rate:
    ///
    ///     v' = unit^2 (s - B c),   s' = c v,   c' = -s v
    ///
    /// With a vertical motion, s is multiplied by the gravity. Products become sums over
    /// coefficients; s and c include the factor unit^2.
    /// The newest terms of each sum are added last, which shortens the dependency chain.
    template <int order, Number T, class Push>
    static RockingSeries<order, T> series(const BlockSide<T>& side, const T& tilt, const T& rate,
                                          const Push& push, const T& unit)
    {
        const T square = unit * unit;
        const T push_0 = coefficient<0>(horizontal_of(push));
        RockingSeries<order, T> motion; // returned without a copy
        auto& x = motion.tilt;
        auto& v = motion.rate;
        x[0] = tilt;
        v[0] = rate;
        x[1] = rate;
        const auto [sine, cosine] = sine_and_cosine(T(tilt - side.slenderness));
        Coefficients<order, T> s{square * sine};
        Coefficients<order, T> c{square * cosine};
        T s_0 = s[0];
        if constexpr (has_gravity<Push>) {
            s_0 = push.gravity.start * s_0;
        }
        v[1] = fma(-push_0, c[0], s_0);
        x[2] = v[1] * T(0.5);
        constexpr int full = std::min(full_terms<T, order + 1>, order);
        extend<1, full>(motion, s, c, push);
        if constexpr (full < order) {
            auto rest = estimate_of(motion);
            auto rest_of_s = estimate_of(s);
            auto rest_of_c = estimate_of(c);
            extend<full, order>(rest, rest_of_s, rest_of_c, estimate_of(push));
            for (std::size_t k = full + 1; k < v.size(); ++k) {
                v[k] = T(rest.rate[k]);
                x[k + 1] = T(rest.tilt[k + 1]);
            }
        }
        return motion;
    }

    /// The number of terms beyond the order of a step that bounds of its error use, and the largest
    /// ratio of the terms after them; see TaylorErrors.
    static constexpr int terms_for_errors = 1;
    template <Number T>
    static T ratio_of_terms(const T& ratio)
    {
        return ratio;
    }

    /// The closed form of an arc; see RockingArc.
    template <Number T>
    struct Arc {
        T m;
        T scale; // M
        T omega; // [p]

        explicit Arc(const T& q)
            : m(q > 0 ? T(q / 4) : T(-q / (4 - q))),
              scale(q > 0 ? T(sqrt(m / (1 - m))) : T(sqrt(m))),
              omega(q > 0 ? T(1) : T(sqrt(1 - q / 4)))
        {}

        /// tan(y/2) and its inverse; cos(y/2).
        static T measure(const T& y) { return tan(y / 2); }
        static T from_measure(const T& measure) { return 2 * atan(measure); }
        static T cosine(const T& y) { return cos(y / 2); }

        /// alpha - y, where measure(alpha) and measure(y) = `now` differ by `apart`.
        static T tilt_at(const T& alpha, const T& apart, const T& now)
        {
            return from_measure(apart / (1 + measure(alpha) * now));
        }

        /// On the separatrix: tan(y/4), which is exponential in time; its inverse; |y'|.
        static T quarter(const T& y) { return tan(y / 4); }
        static T from_quarter(const T& quarter) { return 4 * atan(quarter); }
        static T speed_on_separatrix(const T& y) { return 2 * sin(y / 2); }

        /// The increase of the squared speed from this tilt to the ground,
        /// 4 sin^2(alpha/2) - 4 sin^2((alpha - tilt)/2) (Eq. 5), without cancellation.
        static T square_gained(const T& alpha, const T& tilt)
        {
            return 4 * sin(tilt / 2) * sin(alpha - tilt / 2);
        }

        /// The time since the turn or the top.
        T elapsed(const T& sinh_s) const
        {
            const T square = sinh_s * sinh_s;
            return sinh_s * carlson_integral(T(1), T(1 + m * square), T(1 + square)) / omega;
        }

        /// The hyperbolic amplitude at this time since the turn or the top, by Newton's method.
        /// d tau / d s decreases from 1 / omega on, so that the iteration converges from below; the
        /// last step squares an error below sqrt(epsilon).
        T amplitude_at(const T& since) const
        {
            T s = since * omega;
            const T close = sqrt(std::numeric_limits<T>::epsilon());
            constexpr int most = 64; // at most seven in practice
            for (int i = 0; i < most; ++i) {
                const T sinh_s = sinh(s);
                const T step = (since - elapsed(sinh_s)) * omega * sqrt(1 + m * sinh_s * sinh_s);
                s += step;
                if (abs(step) <= close * abs(s)) {
                    break;
                }
            }
            return s;
        }
    };

    /// The sum of all half periods (Eq. 42) of a block that leaves the ground at the rate v, and
    /// after each arc at sqrt(r) times the previous rate (the limit of Eq. 43) [1/p]. r < 1, and
    /// v < 2 sin(alpha/2). With s = sin(alpha), c = cos(alpha), w = v^2 / 2s, Legendre's generating
    /// function gives the half period
    ///
    ///     T(v) = 2v/s sum of p[k] b[k],    b[k] = (2k)!! / (2k+1)!!,
    ///     p[0] = 1,   p[1] = w c/s,   (k+1) p[k+1] = (2k+1) (c/s) w p[k] + k w^2 p[k-1]
    ///
    /// share(k): the sum over all arcs of the powers of term k, over the first one. The terms
    /// decrease like (v^2 / q_max)^k.
    template <Number T>
    static T sum_of_half_periods(const BlockSide<T>& side, const T& v, const auto& share)
    {
        const T epsilon = std::numeric_limits<T>::epsilon();
        const T s = sin(side.slenderness);
        const T w = v * v / (2 * s);
        const T slope = cos(side.slenderness) / s * w;
        T sum = share(0);
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
};

} // namespace overturn
