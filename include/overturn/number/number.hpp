// The number abstraction: the physics is written once for double, SIMD lanes, 31 and 50 digits.
// A new number type specialises number_traits.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <numbers>

namespace overturn {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Whether the processor has an instruction for fma. WebAssembly has none, and the function of the
/// C library takes longer than a step.
#ifdef __wasm__
inline constexpr bool has_fused_multiply_add = false;
#else
inline constexpr bool has_fused_multiply_add = true;
#endif

/// The fused multiply-add of the physics; that of other numbers is found in their namespaces. Code
/// that needs the exact product asks for has_fused_multiply_add.
namespace arithmetic {
[[gnu::always_inline]] inline double fma(double a, double b, double c)
{
    return has_fused_multiply_add ? std::fma(a, b, c) : a * b + c;
}
/// Rounded twice: a fused one would take a hundred times longer.
inline long double fma(long double a, long double b, long double c)
{
    return a * b + c;
}
} // namespace arithmetic
using arithmetic::fma;

/// The elementary functions of double; those of other numbers are found in their namespaces.
using std::abs, std::cbrt, std::ceil, std::exp, std::expm1, std::floor, std::ilogb, std::isinf,
    std::ldexp, std::log, std::log2, std::nearbyint, std::pow, std::sqrt;
using std::acos, std::asin, std::asinh, std::atan, std::cos, std::cosh, std::sin, std::sinh,
    std::tan;

template <class T>
struct number_traits;

/// Traits of a scalar number: any() returns the mask itself.
template <class T>
struct scalar_number_traits {
    using scalar = T;
    using estimate = T;
    using mask = bool;
    static constexpr int lanes = 1;
    static T select(bool condition, const T& yes, const T& no) { return condition ? yes : no; }
    static T lesser(const T& a, const T& b) { return a < b ? a : b; }
    static T greater(const T& a, const T& b) { return a > b ? a : b; }
    static T pi() { return std::numbers::pi_v<T>; }
    static bool any(bool mask) { return mask; }
    static T load(const T* from) { return *from; }
    static void store(T* to, const T& number) { *to = number; }
    static T gathered(const double* from, const T& index) { return T(from[std::size_t(index)]); }
    static std::array<T, 2> gathered_pair(const double* from, const T& index)
    {
        return {T(from[std::size_t(index)]), T(from[std::size_t(index) + 1])};
    }
};

/// A positive number is mantissa * 2^exponent.
template <class T>
struct SplitNumber {
    T mantissa;
    T exponent;
};

template <>
struct number_traits<double> : scalar_number_traits<double> {
    /// 2^k for an integer k in [-1022, 1023].
    static double power_of_two(double k)
    {
        return std::bit_cast<double>(std::bit_cast<std::uint64_t>(k + exponent_shifter) << 52);
    }
    /// k plus this has k + 1023, the biased exponent of a double, in its lowest bits.
    static constexpr double exponent_shifter = 0x1p+52 + 1023;

    /// A normal x > 0 as mantissa * 2^exponent, 1 <= mantissa < 2; for smaller x, exponent = -1023.
    static SplitNumber<double> split(double x)
    {
        const auto bits = std::bit_cast<std::uint64_t>(x);
        return {std::bit_cast<double>((bits & mantissa_bits) | one_bits),
                std::bit_cast<double>((bits >> 52) | two_to_52_bits) - exponent_shifter};
    }

    static constexpr std::uint64_t mantissa_bits = 0x000fffffffffffff;
    static constexpr std::uint64_t one_bits = 0x3ff0000000000000;       // bits of 1.0
    static constexpr std::uint64_t two_to_52_bits = 0x4330000000000000; // bits of 2^52
};

template <>
struct number_traits<long double> : scalar_number_traits<long double> {};

/// The type of one lane.
template <class T>
using scalar_t = typename number_traits<T>::scalar;

/// The result of a comparison of two numbers: one boolean per lane.
template <class T>
using mask_t = typename number_traits<T>::mask;

template <class T>
inline constexpr int lanes_v = number_traits<T>::lanes;

template <class T>
concept Number = requires(T a, T b) {
    typename number_traits<T>::scalar;
    typename number_traits<T>::mask;
    a + b;
    (a * b);
    a / b;
    -a;
};

/// The number type of errors, peaks and step sizes: T itself, except that those of a DoubleDouble
/// are in double.
template <class T>
using estimate_t = typename number_traits<T>::estimate;
template <class T>
inline constexpr bool has_estimate = !std::same_as<T, estimate_t<T>>;

/// The number of terms of a power series that are computed in all digits of T. The others are so
/// small that doubles suffice; steps are chosen accordingly.
template <class T, int count>
inline constexpr int full_terms = has_estimate<T> ? count / 2 : count;

template <class T>
const T& estimate_of(const T& x)
{
    return x;
}

template <class T>
struct SineAndCosine {
    T sine;
    T cosine;
};

/// Loads the lanes of a number from memory.
template <Number T>
T load(const scalar_t<T>* lanes)
{
    return number_traits<T>::load(lanes);
}

template <Number T>
std::array<scalar_t<T>, lanes_v<T>> lanes_of(const T& number)
{
    std::array<scalar_t<T>, lanes_v<T>> lanes;
    number_traits<T>::store(lanes.data(), number);
    return lanes;
}

/// Lane by lane: from[index]; the index is a whole number.
template <Number T>
T gathered(const double* from, const T& index)
{
    return number_traits<T>::gathered(from, index);
}

/// Lane by lane: from[index] and from[index + 1].
template <Number T>
std::array<T, 2> gathered_pair(const double* from, const T& index)
{
    return number_traits<T>::gathered_pair(from, index);
}

/// Lane by lane: `yes` where the mask is true, `no` elsewhere.
template <Number T>
T select(const mask_t<T>& mask, const T& yes, const T& no)
{
    return number_traits<T>::select(mask, yes, no);
}

/// Lane by lane: a where a < b, b elsewhere (also where either is NaN). One instruction; select()
/// takes two.
template <Number T>
T lesser(const T& a, const T& b)
{
    return number_traits<T>::lesser(a, b);
}

/// Lane by lane: a where a > b, b elsewhere (also where either is NaN).
template <Number T>
T greater(const T& a, const T& b)
{
    return number_traits<T>::greater(a, b);
}

/// Calls body(). All functions that it calls are inlined.
template <Number T, class Body>
[[gnu::flatten]] auto flattened(const Body& body)
{
    return body();
}

/// Calls body(), flattened if a number fits in a register: calls would pass registers through
/// memory and limit out-of-order execution.
template <Number T, class Body>
auto straight_line(const Body& body)
{
    if constexpr (std::same_as<scalar_t<T>, double>) {
        return flattened<T>(body);
    } else {
        return body();
    }
}

/// Whether the mask is true in at least one lane. T cannot be deduced: any<T>(mask).
template <Number T>
bool any(const mask_t<T>& mask)
{
    return number_traits<T>::any(mask);
}

} // namespace overturn
