#include "sweep_kernel.hpp"

#include "overturn/text/error.hpp"

#include <array>
#include <iterator>

namespace overturn {

/// In the order of Integrator.
#define OVERTURN_KERNELS_FOR(name)                                                                 \
    kernel_##name##_runge_kutta, kernel_##name##_taylor_14, kernel_##name##_taylor_20,             \
        kernel_##name##_recorded, kernel_##name##_recorded_31

// OVERTURN_TARGETS, which CMake defines, is OVERTURN_TARGET(name) of each target of this build.
#define OVERTURN_TARGET(name) extern SweepKernelChoice OVERTURN_KERNELS_FOR(name);
OVERTURN_TARGETS
#undef OVERTURN_TARGET

namespace {

/// The compiled kernels, in the order of Integrator; null pointers for kernels not compiled.
constexpr std::array<SweepKernelChoice*, 5> compiled([[maybe_unused]] Kernel kernel)
{
#define OVERTURN_TARGET(name)                                                                      \
    if (name_of(kernel) == #name) {                                                                \
        return {OVERTURN_KERNELS_FOR(name)};                                                       \
    }
    OVERTURN_TARGETS
#undef OVERTURN_TARGET
    return {};
}

#ifdef __x86_64__
constexpr bool is_x86 = true;

// The kernels are compiled for x86-64-v3 and v4; these features identify them.
bool is_v3()
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
           __builtin_cpu_supports("bmi2");
}

bool is_v4()
{
    return is_v3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512cd");
}
#else
constexpr bool is_x86 = false;
bool is_v3()
{
    return false;
}
bool is_v4()
{
    return false;
}
#endif

bool is_arm()
{
#ifdef __aarch64__
    return true;
#else
    return false;
#endif
}

bool is_v3_or_other()
{
    return !is_x86 || is_v3();
}

/// Whether the processor runs a kernel, in the order of the enumerators.
constexpr bool (*requirements[])() = {is_v3_or_other, is_arm, is_v3, is_v4};
static_assert(std::size(requirements) == names_of<Kernel>.size());

} // namespace

SweepKernel sweep_kernel(Kernel kernel, Integrator integrator, Theory theory,
                         const Outputs& outputs, Directions directions)
{
    return compiled(kernel)[std::size_t(integrator)](theory, outputs, directions);
}

bool is_compiled([[maybe_unused]] Kernel kernel)
{
    return compiled(kernel)[0] != nullptr;
}

bool processor_runs(Kernel kernel)
{
    return requirements[std::size_t(kernel)]();
}

bool runs_here(Kernel kernel)
{
    return is_compiled(kernel) && processor_runs(kernel);
}

Kernel widest_kernel()
{
    for (std::size_t i = names_of<Kernel>.size(); i-- > 0;) {
        if (runs_here(Kernel(i))) {
            return Kernel(i);
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
