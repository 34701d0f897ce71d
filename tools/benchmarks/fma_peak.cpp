// Measures the peak rate of fused multiply-adds of this core: independent chains in registers, at
// the width of the widest kernel.
#include "peer.hpp"

#include "overturn/sweep/compute_tile.hpp"

#include <algorithm>
#include <array>
#include <chrono>

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace overturn::benchmarks {

namespace {

/// Prevents the compiler from optimizing a value.
template <class Lanes>
void hide(Lanes& lanes)
{
    asm volatile("" : "+x"(lanes));
}

/// The best rate of several samples of a few milliseconds each. `multiply_add(x, y, z)` is x y + z.
template <int width, class Lanes, class MultiplyAdd>
double best_rate(const MultiplyAdd& multiply_add, Lanes factor, Lanes addend)
{
    using Clock = std::chrono::steady_clock;
    constexpr int chains = 12; // two units with four cycles of latency require eight
    constexpr int rounds = 1 << 20;
    constexpr int samples = 15;
    double best = 0;
    for (int sample = 0; sample < samples; ++sample) {
        std::array<Lanes, chains> chain;
        chain.fill(addend);
        hide(factor);
        const auto begin = Clock::now();
        for (int round = 0; round < rounds; ++round) {
#pragma GCC unroll 16
            for (Lanes& link : chain) {
                link = multiply_add(link, factor, addend);
                hide(link);
            }
        }
        const std::chrono::duration<double> elapsed = Clock::now() - begin;
        best = std::max(best, double(rounds) * chains * width / elapsed.count());
    }
    return best;
}

} // namespace

double fma_peak_per_second()
{
#if defined(__AVX512F__)
    if (widest_kernel() == Kernel::avx512) {
        return best_rate<8>(
            [](__m512d x, __m512d y, __m512d z) { return _mm512_fmadd_pd(x, y, z); },
            _mm512_set1_pd(0.5), _mm512_set1_pd(1.0));
    }
#endif
#if defined(__FMA__)
    if (widest_kernel() != Kernel::one_lane) {
        return best_rate<4>(
            [](__m256d x, __m256d y, __m256d z) { return _mm256_fmadd_pd(x, y, z); },
            _mm256_set1_pd(0.5), _mm256_set1_pd(1.0));
    }
#endif
    return best_rate<1>([](double x, double y, double z) { return __builtin_fma(x, y, z); }, 0.5,
                        1.0);
}

} // namespace overturn::benchmarks
