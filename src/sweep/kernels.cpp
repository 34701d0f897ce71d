#include "kernels.hpp"

#include <array>

namespace overturn {

#define OVERTURN_DECLARE(isa)                                                                      \
    SweepKernel kernel_##isa##_runge_kutta(Theory, const Records&);                                \
    SweepKernel kernel_##isa##_taylor_14(Theory, const Records&);                                  \
    SweepKernel kernel_##isa##_taylor_20(Theory, const Records&);
#define OVERTURN_LIST(isa)                                                                         \
    {                                                                                              \
        kernel_##isa##_runge_kutta, kernel_##isa##_taylor_14, kernel_##isa##_taylor_20             \
    }

// What is compiled in is said by CMake.
#ifdef OVERTURN_KERNEL_double
OVERTURN_DECLARE(double)
#endif
#ifdef OVERTURN_KERNEL_avx2
OVERTURN_DECLARE(avx2)
#endif
#ifdef OVERTURN_KERNEL_avx512
OVERTURN_DECLARE(avx512)
#endif

namespace {

/// In the order of Integrator.
constexpr std::array<SweepKernelChoice, 3> choices(Kernel kernel)
{
    switch (kernel) {
#ifdef OVERTURN_KERNEL_double
    case Kernel::one_lane: return OVERTURN_LIST(double);
#endif
#ifdef OVERTURN_KERNEL_avx2
    case Kernel::avx2: return OVERTURN_LIST(avx2);
#endif
#ifdef OVERTURN_KERNEL_avx512
    case Kernel::avx512: return OVERTURN_LIST(avx512);
#endif
    default: return {};
    }
}

} // namespace

SweepKernel sweep_kernel(Kernel kernel, Integrator integrator, Theory theory,
                         const Records& records)
{
    return choices(kernel)[std::size_t(integrator)](theory, records);
}

} // namespace overturn
