#include "sweep_kernel.hpp"

#include "overturn/text/error.hpp"

#include <array>

namespace overturn {

/// In the order of Integrator.
#define OVERTURN_KERNELS_FOR(isa)                                                                  \
    kernel_##isa##_runge_kutta, kernel_##isa##_taylor_14, kernel_##isa##_taylor_20,                \
        kernel_##isa##_recorded, kernel_##isa##_recorded_31

SweepKernelChoice OVERTURN_KERNELS_FOR(double), OVERTURN_KERNELS_FOR(neon),
    OVERTURN_KERNELS_FOR(avx2), OVERTURN_KERNELS_FOR(avx512);

namespace {

/// The compiled kernels, in the order of Integrator; null pointers for kernels not compiled.
constexpr std::array<SweepKernelChoice*, 5> compiled(Kernel kernel)
{
    switch (kernel) {
#ifdef OVERTURN_KERNEL_double
    case Kernel::one_lane: return {OVERTURN_KERNELS_FOR(double)};
#endif
#ifdef OVERTURN_KERNEL_neon
    case Kernel::neon: return {OVERTURN_KERNELS_FOR(neon)};
#endif
#ifdef OVERTURN_KERNEL_avx2
    case Kernel::avx2: return {OVERTURN_KERNELS_FOR(avx2)};
#endif
#ifdef OVERTURN_KERNEL_avx512
    case Kernel::avx512: return {OVERTURN_KERNELS_FOR(avx512)};
#endif
    default: return {};
    }
}

} // namespace

SweepKernel sweep_kernel(Kernel kernel, Integrator integrator, Theory theory,
                         const Outputs& outputs, Directions directions)
{
    return compiled(kernel)[std::size_t(integrator)](theory, outputs, directions);
}

bool is_compiled(Kernel kernel)
{
    return compiled(kernel)[0] != nullptr;
}

bool processor_runs(Kernel kernel)
{
#ifdef __x86_64__
    // The kernels are compiled for x86-64-v3 and v4; these features identify them.
    const bool is_v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                       __builtin_cpu_supports("bmi2");
    const bool is_v4 = is_v3 && __builtin_cpu_supports("avx512f") &&
                       __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
                       __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd");
    return kernel == Kernel::avx512 ? is_v4 : kernel != Kernel::neon && is_v3;
#elif defined(__aarch64__)
    return kernel == Kernel::one_lane || kernel == Kernel::neon;
#else
    return kernel == Kernel::one_lane;
#endif
}

bool runs_here(Kernel kernel)
{
    return is_compiled(kernel) && processor_runs(kernel);
}

Kernel widest_kernel()
{
    for (const Kernel kernel : {Kernel::avx512, Kernel::avx2, Kernel::neon, Kernel::one_lane}) {
        if (runs_here(kernel)) {
            return kernel;
        }
    }
    if (processor_runs(Kernel::one_lane)) {
        throw Error(exit_code::usage,
                    "this processor cannot run any kernel of this build. Configure "
                    "overturn with -DOVERTURN_KERNELS=all, or build it on this machine.");
    }
    throw Error(exit_code::usage,
                "this processor supports neither AVX2 with FMA nor AVX-512, of which "
                "overturn requires one (Intel processors since 2013, AMD since 2015).");
}

} // namespace overturn
