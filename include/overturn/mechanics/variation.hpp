// Propagation of a small change of the state of a rocking block: by the linearised Eq. 47 between
// impacts, and by the impact itself. The block is an inverted pendulum, so changes grow; a slow
// impact amplifies them.
#pragma once

#include "overturn/mechanics/block.hpp"
#include "overturn/number/unrolled.hpp"

namespace overturn {

/// A 2 x 2 matrix: d(tilt, rate) at the end over d(tilt, rate) at the beginning.
template <Number T>
struct Variation {
    T tilt_by_tilt; ///< [1]
    T tilt_by_rate; ///< [1/p]
    T rate_by_tilt; ///< [p]
    T rate_by_rate; ///< [1]
    /// Error bound of rate_by_tilt [p]. The bound of the diagonal entries is `unsure` times `time`
    /// [1/p], that of tilt_by_rate is `unsure` times the square of `time`.
    T unsure = T(0);
    T time = T(0);
};

/// The longest time for which variation_over() is valid [1/p].
inline constexpr double longest_variation = 12;

/// The variation over a time h [1/p] without an event, from the stiffness k at its beginning,
/// middle and end: the classical Runge-Kutta step for delta'' = k(t) delta, written out, plus the
/// higher terms of the series of cosh and sinh for the mean of k, because steps in the linear
/// theory are long. For a constant k, its error is below 2 % of its largest entry at the longest h,
/// and 3e-10 at h = 3. The error bound `unsure` grows with the variation of k; it is seldom too
/// small, and ten times too large in the median.
template <Number T>
Variation<T> variation_over(const T& h, const T& begin, const T& middle, const T& end)
{
    using S = scalar_t<T>;
    const T one(1);
    const T square = h * h;
    const T sixth = square * T(S(1) / 6);
    const T corner = square * square * T(S(1) / 24) * middle;
    const T two_middle = middle + middle;
    const T mean = T(S(1) / 6) * (begin + two_middle + two_middle + end);
    const T x = mean * square;
    // sum of x^n / (2n)! from n = 3 on, and of x^n / (2n + 1)! from n = 2 on.
    T even = one;
    T odd = one;
    unrolled<7>([&]<int i>() {
        constexpr int n = 20 - 2 * i;
        even = fma(x * T(S(1) / (n * (n - 1))), even, one);
        odd = fma(x * T(S(1) / ((n - 1) * (n - 2))), odd, one);
    });
    even = x * x * x * T(S(1) / 720) * even;
    odd = x * x * T(S(1) / 120) * odd;
    const T tilt_by_rate = h * (fma(sixth, middle, one) + odd);
    const T varies = abs(begin - middle) + abs(end - middle);
    return {.tilt_by_tilt = fma(corner, begin, fma(sixth, begin + two_middle, one)) + even,
            .tilt_by_rate = tilt_by_rate,
            .rate_by_tilt = h * fma(T(0.5) * sixth * middle, begin + end, fma(mean, odd, mean)),
            .rate_by_rate = fma(corner, end, fma(sixth, two_middle + end, one)) + even,
            .unsure = tilt_by_rate * varies * fma(square, T(0.25) * varies, T(S(1) / 32)),
            .time = h};
}

/// The variation over an impact at the speed w: a block whose tilt is larger by d strikes later by
/// d / w, with a different acceleration until then. a, b: d^2|theta| / d tau^2 before and after; f:
/// Block::rate_ratio(); k: p after over p before, because tau = p t. For a symmetric block f is
/// sqrt(r), and k is 1.
///
///     tilt+ = -k f tilt-,   rate+ = -f rate- - (f a + k b) tilt- / w
template <Number T>
Variation<T> variation_over_impact(const T& rate_ratio, const T& frequency_ratio, const T& speed,
                                   const T& before, const T& after)
{
    return {.tilt_by_tilt = -(frequency_ratio * rate_ratio),
            .tilt_by_rate = T(0),
            .rate_by_tilt = -fma(rate_ratio, before, frequency_ratio * after) / speed,
            .rate_by_rate = -rate_ratio};
}

} // namespace overturn
