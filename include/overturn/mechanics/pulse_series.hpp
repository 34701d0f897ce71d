// Taylor coefficients in t of the pulses f(phase + rate t), computed by recurrences. Their values
// are in pulse.hpp.
#pragma once

#include "overturn/mechanics/pulse.hpp"
#include "overturn/number/unrolled.hpp"

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
    using arithmetic::fma;
    using S = scalar_t<T>;
    const T linear = -(slope * z);
    const T quadratic = -(slope * slope);
    Coefficients<count, T> g{scale * exponential_decay(T(z * z * T(S(0.5))))};
    g[1] = linear * g[0];
    unrolled<count - 2>(
        [&]<int k>() { g[k + 2] = fma(linear, g[k + 1], quadratic * g[k]) * T(S(1) / (k + 2)); });
    return g;
}

/// The product of a series g with a polynomial p of few terms.
template <std::size_t count, std::size_t terms, Number T>
std::array<T, count> product(const std::array<T, terms>& p, const std::array<T, count>& g)
{
    using arithmetic::fma;
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
        return {scale, T(S(0))};
    } else if constexpr (std::same_as<Pulse, Triangular>) {
        const T slope(2 / pi<S>());
        const mask_t<T> rises = on < T(Triangular::kink<S>());
        const T x = phase * slope;
        const T steep = scale * rate * slope;
        return {scale * select<T>(rises, x, T(S(2)) - x), select<T>(rises, steep, -steep)};
    } else {
        const auto [sine, cosine] = sine_and_cosine_of_period(phase);
        if constexpr (std::same_as<Pulse, OneCosine>) {
            return {scale * cosine, -(scale * rate * sine)};
        } else { // a wavelet is instantiated, too, but never called
            static_assert(std::same_as<Pulse, OneSine> || is_wavelet<Pulse>);
            return {scale * sine, scale * rate * cosine};
        }
    }
}

/// The first `count` Taylor coefficients in t of scale f(phase + rate t) for a wavelet f.
template <class Wavelet, int count, Number T>
Coefficients<count, T> wavelet_series(const T& scale, const T& phase, const T& rate)
{
    using arithmetic::fma;
    using std::sqrt;
    using S = scalar_t<T>;
    static_assert(is_wavelet<Wavelet>);
    if constexpr (std::same_as<Wavelet, SymmetricRicker>) {
        // With z = phase / sqrt 2, x^2 = z^2 / 2 and 1 - 2 x^2 = 1 - z^2.
        const T to_z(sqrt(S(2)) / 2);
        const T z = phase * to_z;
        const T slope = rate * to_z;
        const std::array<T, 3> p{fma(-z, z, T(S(1))), z * slope * T(S(-2)), -(slope * slope)};
        return product(p, gaussian_series<count>(scale, z, slope));
    } else {
        // z (z^2 - 3) increases by 3 (z^2 - 1) slope t + 3 z slope^2 t^2 + slope^3 t^3.
        const T to_z(sqrt(S(3)) / 3);
        const T z = phase * to_z;
        const T slope = rate * to_z;
        const T three(S(3));
        const T square = z * z;
        const std::array<T, 4> p{z * (square - three), three * slope * (square - T(S(1))),
                                 three * z * slope * slope, slope * slope * slope};
        return product(p, gaussian_series<count>(T(scale * T(S(50) / 69)), z, slope));
    }
}

} // namespace overturn
