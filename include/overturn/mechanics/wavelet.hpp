// Bounds of the tails and of the series of the Ricker wavelets.
#pragma once

#include "overturn/mechanics/pulse.hpp"

namespace overturn {

/// The wavelet is the m-th derivative of a Gaussian of z = phase / sqrt(m), scaled.
constexpr int derivative_of_gaussian(PulseKind wavelet)
{
    return wavelet == PulseKind::symmetric_ricker ? 2 : 3;
}

/// The phase [rad] after which |f| of a wavelet stays below 2^log2_level, to within a percent; at
/// least 6 sqrt(2). With z = phase / sqrt m, |f| <= z^3 exp(-z^2 / 2).
template <Number T>
T end_of_tail(PulseKind wavelet, const T& log2_level)
{
    using std::sqrt;
    using S = scalar_t<T>;
    const T least(S(36));
    T square(S(100)); // z^2 = 2 ln (z^3 / level), by iteration
    for (int i = 0; i < 4; ++i) {
        square = (rough_log2(square) * T(S(1.5)) - log2_level) * T(2 * number_traits<S>::ln_two());
        square = greater<T>(square, least);
    }
    return sqrt(square * T(S(derivative_of_gaussian(wavelet))));
}

/// An upper bound q of the ratio of successive terms of a wavelet's series: if |f[k] t^k| is at
/// most M / q for k = count - 2 and at most M for k = count - 1, the j-th term after these is at
/// most M q^j. From the recurrence for the m-th derivative of a Gaussian at z, x = slope t:
///
///     k f[k] t^k = -z x f[k-1] t^(k-1) - x^2 (1 + m / (k - 1)) f[k-2] t^(k-2)
///
/// phase, step = rate t [rad].
template <int count, Number T>
T following_ratio(PulseKind wavelet, const T& phase, const T& step)
{
    using arithmetic::fma;
    using std::abs;
    using std::sqrt;
    using S = scalar_t<T>;
    const int m = derivative_of_gaussian(wavelet); // and z = phase / sqrt(m)
    const T linear = abs(phase) * step * T(S(1) / m);
    const T square = step * step * T(S(4 * count) / m * (S(1) + S(m) / (count - 1)));
    return (linear + sqrt(fma(linear, linear, square))) * T(S(1) / (2 * count));
}

} // namespace overturn
