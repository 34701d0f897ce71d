// How a small change of a rocking block's state is passed on: by the linearised Eq. 47 between
// impacts, and by the impact itself. The upright block is an inverted pendulum, so changes grow; a
// slow impact amplifies them.
#pragma once

#include "overturn/mechanics/block.hpp"

namespace overturn {

/// A 2 x 2 matrix: d(tilt, rate) at the end over d(tilt, rate) at the beginning.
template <Number T>
struct Variation {
    T tilt_by_tilt; ///< [1]
    T tilt_by_rate; ///< [1/p]
    T rate_by_tilt; ///< [p]
    T rate_by_rate; ///< [1]
    /// How far off rate_by_tilt may be [p]; the entries of its row and column are by this times
    /// `time` [1/p], tilt_by_rate by this times its square.
    T unsure = T(scalar_t<T>(0));
    T time = T(scalar_t<T>(0));
};

/// d(|theta|'') / d|theta| of Eq. 47 with y = alpha - |theta| and the push B:
///
///     k = cos y - B sin y          linear theory: 1
template <Theory theory, Number T>
T rocking_stiffness(const T& tilt, const T& slenderness, const T& push)
{
    using arithmetic::fma;
    if constexpr (theory == Theory::linear) {
        return T(scalar_t<T>(1));
    } else {
        const auto [sine, cosine] = sine_and_cosine(T(slenderness - tilt));
        return fma(-push, sine, cosine);
    }
}

/// Of longer times variation_over() knows nothing [1/p].
inline constexpr double longest_variation = 12;

/// Over a time h [1/p] without an event, from the stiffness at its beginning, its middle and its
/// end: the classical Runge-Kutta step for delta'' = k(t) delta, written out, and beyond it the
/// series of cosh and sinh for the mean of k, as steps of the linear theory are long. For a
/// constant k it is off by less than 2 % of its largest entry at the longest h, and by 3e-10 at 3.
/// What it is unsure of grows with d, what k varies by, and is seldom too little, and in the median
/// ten times too much.
template <Number T>
Variation<T> variation_over(const T& h, const T& begin, const T& middle, const T& end)
{
    using arithmetic::fma;
    using std::abs;
    using S = scalar_t<T>;
    const T one(S(1));
    const T square = h * h;
    const T sixth = square * T(S(1) / 6);
    const T corner = square * square * T(S(1) / 24) * middle;
    const T two_middle = middle + middle;
    const T mean = T(S(1) / 6) * (begin + two_middle + two_middle + end);
    const T x = mean * square;
    // sum of x^n / (2n)! from n = 3 on, and of x^n / (2n + 1)! from n = 2 on.
    T even = one;
    for (const double divisor : {380, 306, 240, 182, 132, 90, 56}) {
        even = fma(x * T(S(1) / S(divisor)), even, one);
    }
    T odd = one;
    for (const double divisor : {342, 272, 210, 156, 110, 72, 42}) {
        odd = fma(x * T(S(1) / S(divisor)), odd, one);
    }
    even = x * x * x * T(S(1) / 720) * even;
    odd = x * x * T(S(1) / 120) * odd;
    const T tilt_by_rate = h * (fma(sixth, middle, one) + odd);
    const T varies = abs(begin - middle) + abs(end - middle);
    return {.tilt_by_tilt = fma(corner, begin, fma(sixth, begin + two_middle, one)) + even,
            .tilt_by_rate = tilt_by_rate,
            .rate_by_tilt = h * fma(T(S(0.5)) * sixth * middle, begin + end, fma(mean, odd, mean)),
            .rate_by_rate = fma(corner, end, fma(sixth, two_middle + end, one)) + even,
            .unsure = tilt_by_rate * varies * fma(square, T(S(0.25)) * varies, T(S(1) / 32)),
            .time = h};
}

/// Over an impact at the speed w: a tilt that is too large by d strikes later by d / w, and has
/// another acceleration meanwhile. a, b: d^2|theta| / d tau^2 just before and just after.
///
///     tilt+ = -sqrt(r) tilt-,   rate+ = -sqrt(r) rate- - (sqrt(r) a + b) tilt- / w
template <Number T>
Variation<T> variation_over_impact(const T& sqrt_restitution, const T& speed, const T& before,
                                   const T& after)
{
    using arithmetic::fma;
    return {.tilt_by_tilt = -sqrt_restitution,
            .tilt_by_rate = T(scalar_t<T>(0)),
            .rate_by_tilt = -fma(sqrt_restitution, before, after) / speed,
            .rate_by_rate = -sqrt_restitution};
}

} // namespace overturn
