// Taylor coefficients in t of the pulses f(phase + rate t), computed by recurrences, and bounds of
// the series and the tails of the Ricker wavelets. The values of the pulses are in pulse.hpp.
#pragma once

#include "overturn/mechanics/pulse.hpp"
#include "overturn/number/unrolled.hpp"

#include <cmath>
#include <numbers>

namespace overturn {

template <int count, Number T>
using Coefficients = std::array<T, std::size_t(count)>;

/// The solution of f'' = -rate^2 f that starts with f and f' at t = 0.
template <int count, Number T>
Coefficients<count, T> harmonic_series(const Coefficients<2, T>& start, const T& rate)
{
    using S = scalar_t<T>;
    const T curvature = -(rate * rate);
    Coefficients<count, T> f{start[0], start[1]};
    unrolled<count - 2>(
        [&]<int k>() { f[k + 2] = f[k] * (curvature * T(S(1) / ((k + 1) * (k + 2)))); });
    return f;
}

/// scale exp(-(z + slope t)^2 / 2), from g' = -slope (z + slope t) g.
template <int count, Number T>
Coefficients<count, T> gaussian_series(const T& scale, const T& z, const T& slope)
{
    using S = scalar_t<T>;
    const T linear = -(slope * z);
    const T quadratic = -(slope * slope);
    Coefficients<count, T> g{scale * exponential_decay(T(z * z * T(0.5)))};
    g[1] = linear * g[0];
    unrolled<count - 2>(
        [&]<int k>() { g[k + 2] = fma(linear, g[k + 1], quadratic * g[k]) * T(S(1) / (k + 2)); });
    return g;
}

/// The product of a series g with a polynomial p of few terms.
template <std::size_t count, std::size_t terms, Number T>
std::array<T, count> product(const std::array<T, terms>& p, const std::array<T, count>& g)
{
    std::array<T, count> f;
    for (std::size_t k = 0; k < count; ++k) {
        f[k] = p[0] * g[k];
        for (std::size_t i = 1; i < terms && i <= k; ++i) {
            f[k] = fma(p[i], g[k - i], f[k]);
        }
    }
    return f;
}

/// Value and slope of scale f(phase + rate t) at t = 0, where f is the pulse on the smooth piece
/// that contains or begins at the phase `on`; scale [1], phases [rad], rate [rad per unit of t].
/// Not for wavelets. These pulses satisfy f'' = -rate^2 f, or f'' = 0 if they are linear.
template <class Pulse, Number T>
Coefficients<2, T> value_and_slope(const T& scale, const T& phase, const T& rate,
                                   [[maybe_unused]] const T& on)
{
    using S = scalar_t<T>;
    if constexpr (std::same_as<Pulse, Rectangular>) {
        return {scale, T(0)};
    } else if constexpr (std::same_as<Pulse, Triangular>) {
        const T slope(2 / pi<S>());
        const mask_t<T> rises = on < T(pi<S>() / 2);
        const T x = phase * slope;
        const T steep = scale * rate * slope;
        return {scale * select<T>(rises, x, 2 - x), select<T>(rises, steep, -steep)};
    } else {
        const auto [sine, cosine] = sine_and_cosine_of_period(phase);
        if constexpr (std::same_as<Pulse, OneCosine>) {
            return {scale * cosine, -(scale * rate * sine)};
        } else { // OneSine; wavelets are instantiated, too, but never called
            return {scale * sine, scale * rate * cosine};
        }
    }
}

/// The wavelet is the m-th derivative of a Gaussian of z = phase / sqrt(m), scaled.
constexpr int derivative_of_gaussian(PulseKind wavelet)
{
    return wavelet == PulseKind::symmetric_ricker ? 2 : 3;
}

/// An upper bound of |f^(order)| of a wavelet. By Cramer's inequality, the n-th derivative of
/// exp(-z^2 / 2) is below 1.0865 sqrt(n!).
inline double largest_derivative_of_wavelet(PulseKind wavelet, int order)
{
    const int m = derivative_of_gaussian(wavelet);
    double square = 1.0865 * 1.0865; // of the bound
    for (int n = 2; n <= order + m; ++n) {
        square *= n;
    }
    for (int i = 0; i < order; ++i) {
        square /= m;
    }
    return std::sqrt(square);
}

/// The first `count` Taylor coefficients in t of scale f(phase + rate t) for a wavelet f.
template <PulseKind wavelet, int count, Number T>
Coefficients<count, T> wavelet_series(const T& scale, const T& phase, const T& rate)
{
    using S = scalar_t<T>;
    constexpr int m = derivative_of_gaussian(wavelet);
    const T to_z(sqrt(S(m)) / m);
    const T z = phase * to_z;
    const T slope = rate * to_z;
    if constexpr (wavelet == PulseKind::symmetric_ricker) {
        // x^2 = z^2 / 2 and 1 - 2 x^2 = 1 - z^2.
        const std::array<T, 3> p{fma(-z, z, T(1)), z * slope * -2, -(slope * slope)};
        return product(p, gaussian_series<count>(scale, z, slope));
    } else {
        // z (z^2 - 3) increases by 3 (z^2 - 1) slope t + 3 z slope^2 t^2 + slope^3 t^3.
        const T square = z * z;
        const std::array<T, 4> p{z * (square - 3), 3 * slope * (square - 1), 3 * z * slope * slope,
                                 slope * slope * slope};
        return product(p, gaussian_series<count>(T(scale * T(S(50) / 69)), z, slope));
    }
}

/// The phase [rad] after which |f| of a wavelet stays below 2^log2_level, to within a percent; at
/// least 6 sqrt(2). With z = phase / sqrt m, |f| <= z^3 exp(-z^2 / 2).
template <Number T>
T end_of_tail(PulseKind wavelet, const T& log2_level)
{
    T square(100); // z^2 = 2 ln (z^3 / level), by iteration
    for (int i = 0; i < 4; ++i) {
        square = (rough_log2(square) * T(1.5) - log2_level) * T(2 * std::numbers::ln2);
        square = greater<T>(square, 36);
    }
    return sqrt(square * derivative_of_gaussian(wavelet));
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
    using S = scalar_t<T>;
    const int m = derivative_of_gaussian(wavelet); // and z = phase / sqrt(m)
    const T linear = abs(phase) * step * T(S(1) / m);
    const T square = step * step * T(S(4 * count) / m * (S(1) + S(m) / (count - 1)));
    return (linear + sqrt(fma(linear, linear, square))) * T(S(1) / (2 * count));
}

} // namespace overturn
