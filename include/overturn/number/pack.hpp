// Pack: a SIMD register of doubles. Its operations (+, -, *, /, fma, sqrt, comparisons, selection)
// follow IEEE 754 in each lane, so every lane has the same bits as a scalar double.
#pragma once

#include "overturn/number/number.hpp"

#include <xsimd/xsimd.hpp>

#ifdef __AVX512F__
namespace xsimd {

/// xsimd 8.1 rounds twice here: it has no fma for AVX-512 and falls back to x * y + z.
inline batch<double, avx512dq> fma(const batch<double, avx512dq>& x,
                                   const batch<double, avx512dq>& y,
                                   const batch<double, avx512dq>& z)
{
    return _mm512_fmadd_pd(x, y, z);
}

} // namespace xsimd
#endif

namespace overturn {

/// `Architecture` is an xsimd architecture. It is a template parameter so that the kernels of two
/// instruction sets in one program share no function.
template <class Architecture>
using Pack = xsimd::batch<double, Architecture>;

template <class Architecture>
struct number_traits<xsimd::batch<double, Architecture>> {
    using pack = xsimd::batch<double, Architecture>;
    using scalar = double;
    using estimate = pack;
    using mask = xsimd::batch_bool<double, Architecture>;
    using integers = xsimd::batch<std::uint64_t, Architecture>;
    static constexpr int lanes = int(pack::size);
    static pack select(const mask& condition, const pack& yes, const pack& no)
    {
        return xsimd::select(condition, yes, no);
    }
    static pack lesser(const pack& a, const pack& b) { return xsimd::min(a, b); }
    static pack greater(const pack& a, const pack& b) { return xsimd::max(a, b); }
    /// 2^k for an integer k in [-1022, 1023], see number_traits<double>.
    static pack power_of_two(const pack& k)
    {
        const pack shifted = k + pack(number_traits<double>::exponent_shifter);
        return xsimd::bitwise_cast<pack>(xsimd::bitwise_cast<integers>(shifted) << 52);
    }
    /// See number_traits<double>.
    static SplitNumber<pack> split(const pack& x)
    {
        using Lane = number_traits<double>;
        const integers bits = xsimd::bitwise_cast<integers>(x);
        const integers mantissa = (bits & integers(Lane::mantissa_bits)) | integers(Lane::one_bits);
        const integers exponent = (bits >> 52) | integers(Lane::two_to_52_bits);
        return {xsimd::bitwise_cast<pack>(mantissa),
                xsimd::bitwise_cast<pack>(exponent) - pack(Lane::exponent_shifter)};
    }
    static pack load(const double* from) { return pack::load_unaligned(from); }
    static void store(double* to, const pack& number) { number.store_unaligned(to); }
    /// index: from 0 to 2^52.
    static pack gathered(const double* from, const pack& index)
    {
        using Signed = xsimd::batch<std::int64_t, Architecture>;
        return pack::gather(from, xsimd::bitwise_cast<Signed>(whole(index)));
    }
    /// A pair is one load of 16 bytes.
    static std::array<pack, 2> gathered_pair(const double* from, const pack& index)
    {
        alignas(64) std::uint64_t at[std::size_t(lanes)];
        whole(index).store_aligned(at);
        return pairs_at(from, at, Architecture());
    }
    static bool any(const mask& condition) { return xsimd::any(condition); }

private:
    static integers whole(const pack& index)
    {
        return xsimd::bitwise_cast<integers>(index + pack(0x1p+52)) ^
               integers(number_traits<double>::two_to_52_bits);
    }
#ifdef __aarch64__
    static std::array<pack, 2> pairs_at(const double* from, const std::uint64_t* at, xsimd::neon64)
    {
        const float64x2_t first = vld1q_f64(from + at[0]);
        const float64x2_t second = vld1q_f64(from + at[1]);
        return {vzip1q_f64(first, second), vzip2q_f64(first, second)};
    }
#endif
#ifdef __AVX2__
    static __m256d two_pairs(const double* first, const double* second)
    {
        return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(first)),
                                    _mm_loadu_pd(second), 1);
    }
    static std::array<pack, 2> pairs_at(const double* from, const std::uint64_t* at,
                                        xsimd::fma3<xsimd::avx2>)
    {
        const __m256d even = two_pairs(from + at[0], from + at[2]);
        const __m256d odd = two_pairs(from + at[1], from + at[3]);
        return {_mm256_unpacklo_pd(even, odd), _mm256_unpackhi_pd(even, odd)};
    }
#endif
#ifdef __AVX512F__
    static std::array<pack, 2> pairs_at(const double* from, const std::uint64_t* at,
                                        xsimd::avx512dq)
    {
        const auto four_pairs = [&](int first) {
            return _mm512_insertf64x4(
                _mm512_castpd256_pd512(two_pairs(from + at[first], from + at[first + 2])),
                two_pairs(from + at[first + 4], from + at[first + 6]), 1);
        };
        const __m512d even = four_pairs(0);
        const __m512d odd = four_pairs(1);
        return {_mm512_unpacklo_pd(even, odd), _mm512_unpackhi_pd(even, odd)};
    }
#endif
};

} // namespace overturn
