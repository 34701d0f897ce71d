// The lane widths for which the kernels of the forced stage are compiled, and their support by this
// processor. For each width there is a function per method, theory and set of outputs, see
// src/sweep/sweep_kernel.hpp.
#pragma once

#include <array>
#include <string_view>

namespace overturn {

/// A lane width with its instruction set, as --kernel names it. Where one function is meant, a
/// kernel is one of those compiled for this width. All widths give identical bits. one_lane
/// computes one point at a time. On x86-64 it uses the instructions of avx2; there and on 64-bit
/// ARM, where neon has two lanes, it is for debugging and comparison.
enum class Kernel { one_lane, neon, avx2, avx512 };

/// From the narrowest to the widest.
inline constexpr std::array<std::string_view, 4> kernel_names{"double", "neon", "avx2", "avx512"};
constexpr std::string_view name_of(Kernel kernel)
{
    return kernel_names[std::size_t(kernel)];
}

/// Whether the kernel is part of this build; see the CMake option OVERTURN_KERNELS.
bool is_compiled(Kernel kernel);

/// Whether this processor supports the instructions of the kernel.
bool processor_runs(Kernel kernel);

/// is_compiled() and processor_runs().
bool runs_here(Kernel kernel);

/// The widest kernel that runs here. Throws Error.
Kernel widest_kernel();

/// The kernel of this name, one of kernel_names; of "auto", the widest one. Throws Error if it does
/// not run here.
Kernel kernel_called(std::string_view name);

} // namespace overturn
