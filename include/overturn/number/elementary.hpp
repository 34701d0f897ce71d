// Sine, cosine and exponential on the ranges used in rocking, computed with +, * and fma only: no
// branches, no tables, identical bits in a double and in every lane of a pack.
// In double, the error is below 1.5 ulp of the result; for the cosine, below 1.5 ulp of 1.
#pragma once

#include "overturn/number/number.hpp"

#include <array>
#include <concepts>

namespace overturn {

namespace minimax {

// Minimax polynomials in t = x^2 for |x| <= 1.65, a little more than pi/2 because trial steps may
// overshoot: sin x = x + x t S(t) to 5.4e-17, cos x = 1 - t/2 + t^2 C(t) to 2.1e-17 (Remez,
// coefficients rounded).
inline constexpr std::array<double, 8> sine{
    -0x1.5555555555555p-3,  0x1.1111111111086p-7,  -0x1.a01a01a0112cap-13, 0x1.71de3a511300fp-19,
    -0x1.ae64542079949p-26, 0x1.6123a06459d48p-33, -0x1.ae3813f8133ddp-41, 0x1.8703938097091p-49};
inline constexpr std::array<double, 7> cosine{
    0x1.5555555555467p-5,  -0x1.6c16c16c0ad64p-10, 0x1.a01a0198d908ap-16, -0x1.27e4f939992ffp-22,
    0x1.1eecc899c8fe1p-29, -0x1.9349801bdb3f5p-37, 0x1.9e4a888fdbd74p-45};

} // namespace minimax

/// 1 / n! for n = 0, 1, ..., 13.
inline constexpr auto inverse_factorials = [] {
    std::array<double, 14> inverses{1};
    double factorial = 1;
    for (std::size_t n = 1; n < inverses.size(); ++n) {
        factorial *= double(n);
        inverses[n] = 1 / factorial;
    }
    return inverses;
}();

/// c[0] + c[1] t + c[2] t^2 + ... by Horner's rule.
template <Number T, class Coefficient, std::size_t N>
T polynomial(const std::array<Coefficient, N>& c, const T& t)
{
    T sum(c[N - 1]);
    for (std::size_t i = N - 1; i-- > 0;) {
        sum = fma(sum, t, T(c[i]));
    }
    return sum;
}

/// x^n.
template <int n, Number T>
T power(const T& x)
{
    static_assert(n >= 1);
    if constexpr (n == 1) {
        return x;
    } else {
        const T half = power<n / 2>(x);
        return n % 2 == 0 ? T(half * half) : T(half * half * x);
    }
}

/// sin x and cos x for |x| <= pi/2 [rad]. Slightly beyond, double is smooth but less accurate.
template <Number T>
SineAndCosine<T> sine_and_cosine(const T& x)
{
    if constexpr (std::same_as<scalar_t<T>, double>) {
        const T t = x * x;
        const T sine = fma(x * t, polynomial(minimax::sine, t), x);
        const T half = fma(t, T(-0.5), T(1));
        return {sine, fma(t * t, polynomial(minimax::cosine, t), half)};
    } else {
        return {sin(x), cos(x)};
    }
}

/// pi in two parts: with fma, the product of the first with a small integer is exact.
inline constexpr double pi_high = 0x1.921fb54442d18p+1;
inline constexpr double pi_low = 0x1.1a62633145c07p-53;

/// sin x and cos x for -pi/2 <= x <= 5 pi/2 [rad], the range of a pulse of one period.
template <Number T>
SineAndCosine<T> sine_and_cosine_of_period(const T& x)
{
    if constexpr (std::same_as<scalar_t<T>, double>) {
        const T k = select<T>(x > 0.5 * pi_high, 1, 0) + select<T>(x > 1.5 * pi_high, 1, 0);
        // As in the next function, but written again: in a function of its own, to which the sign
        // is passed, these lines make Runge-Kutta steps with AVX-512 4 % slower.
        const T reduced = fma(k, T(-pi_low), fma(k, T(-pi_high), x));
        const auto [sine, cosine] = sine_and_cosine(reduced);
        const T sign = select<T>(k == 1, -1, 1);
        return {sign * sine, sign * cosine};
    } else {
        return sine_and_cosine(x);
    }
}

/// x - k pi for an integer |k| < 2^20.
template <Number T>
T less_multiple_of_pi(const T& x, const T& k)
{
    if constexpr (has_fused_multiply_add) {
        return fma(k, T(-pi_low), fma(k, T(-pi_high), x));
    } else {
        constexpr double pi_highest = 0x1.921fb544p+1; // the products with the first two are exact
        return x - k * T(pi_highest) - k * T(pi_high - pi_highest) - k * T(pi_low);
    }
}

/// sin x and cos x for |x| < 2^20 [rad]; in the range of one period, the values of
/// sine_and_cosine_of_period(), which is faster.
template <Number T>
SineAndCosine<T> sine_and_cosine_of_cycles(const T& x)
{
    if constexpr (std::same_as<scalar_t<T>, double>) {
        // A number is rounded to an integer at 1.5 * 2^52. In any rounding mode, this is one of the
        // two integers next to x / pi; the nearest is at most one off. The differences are exact,
        // too: multiples of 2^-51.
        constexpr double inverse_pi = 0x1.45f306dc9c882p-2; // rounded down: pi/2 to k = 0
        constexpr double rounder = 0x1.8p+52;
        const T guess = fma(x, T(inverse_pi), T(rounder)) - rounder;
        const T rest = fma(guess, T(-pi_high), x);
        const T above = select<T>(rest > 0.5 * pi_high, 1, 0);
        const T below = select<T>(rest < -0.5 * pi_high, 1, 0);
        const T k = guess + (above - below);
        const T odd = k - 2 * (fma(k, T(0.5), T(rounder)) - rounder); // -1, 0 or 1
        const auto [sine, cosine] = sine_and_cosine(less_multiple_of_pi(x, k));
        const T sign = fma(-2 * odd, odd, T(1));
        return {sign * sine, sign * cosine};
    } else {
        return sine_and_cosine(x);
    }
}

/// exp(-x) for 0 <= x <= 700.
template <Number T>
T exponential_decay(const T& x)
{
    if constexpr (std::same_as<scalar_t<T>, double>) {
        // exp(-x) = 2^-k exp(k ln 2 - x), k the integer nearest to x / ln 2, rounded at 1.5 * 2^52.
        // |k ln 2 - x| <= ln(2)/2, where the series up to 1/13! has an error of 4e-18.
        constexpr double rounder = 0x1.8p+52;
        constexpr double log2_of_e = 0x1.71547652b82fep+0;
        constexpr double ln2_high = 0x1.62e42fefa39efp-1;
        constexpr double ln2_low = 0x1.abc9e3b39803fp-56;
        const T k = fma(x, T(log2_of_e), T(rounder)) - T(rounder);
        const T rest = fma(k, T(ln2_low), fma(k, T(ln2_high), -x));
        return polynomial(inverse_factorials, rest) * number_traits<T>::power_of_two(-k);
    } else {
        return exp(-x);
    }
}

/// log2 x for a normal x > 0, to within 1e-3. For choosing step sizes, not for results.
/// Returns a number below -1022 for smaller x, including 0, and one above 1023 for non-finite x.
template <Number T>
T rough_log2(const T& x)
{
    if constexpr (std::same_as<scalar_t<T>, double>) {
        // Interpolated at the Chebyshev nodes of [1, 2].
        constexpr std::array<double, 4> cubic{-2.13623207, 3.01116215, -1.02680491, 0.15270028};
        const auto [mantissa, exponent] = number_traits<T>::split(x);
        return polynomial(cubic, mantissa) + exponent;
    } else if constexpr (has_estimate<T>) {
        return T(rough_log2(estimate_of(x)));
    } else {
        return x == 0 ? T(-200000) : T(log2(x)); // log2(0) is infinite
    }
}

/// 2^x for |x| < 1000, to within one part in 10^4; see rough_log2().
template <Number T>
T rough_power_of_two(const T& x)
{
    if constexpr (std::same_as<scalar_t<T>, double>) {
        // Interpolated at the Chebyshev nodes of [-1/2, 1/2].
        constexpr std::array<double, 4> cubic{0.99992456, 0.69313673, 0.24263948, 0.05583828};
        constexpr double rounder = 0x1.8p+52;
        const T k = (x + T(rounder)) - T(rounder);
        return polynomial(cubic, T(x - k)) * number_traits<T>::power_of_two(k);
    } else if constexpr (has_estimate<T>) {
        return T(rough_power_of_two(estimate_of(x)));
    } else {
        return pow(T(2), x);
    }
}

/// The largest power of two that is at most x; x > 0 and normal.
template <Number T>
T power_of_two_below(const T& x)
{
    if constexpr (std::same_as<scalar_t<T>, double>) {
        return number_traits<T>::power_of_two(number_traits<T>::split(x).exponent);
    } else if constexpr (has_estimate<T>) {
        return T(power_of_two_below(estimate_of(x)));
    } else {
        return ldexp(T(1), int(ilogb(x)));
    }
}

/// pi in the scalar type.
template <class S>
[[gnu::always_inline]] inline S pi() // see value_of()
{
    return number_traits<S>::pi();
}

} // namespace overturn
