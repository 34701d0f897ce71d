// The lane widths for which the kernels of the forced stage are compiled, and their support by this
// processor. For each width there is a function per method, theory and set of outputs, see
// src/sweep/sweep_kernel.hpp.
#pragma once

#include "overturn/text/names.hpp"

namespace overturn {

/// A lane width with its instruction set, as --kernel names it. Where one function is meant, a
/// kernel is one of those compiled for this width. All widths give identical bits. one_lane
/// computes one point at a time. On x86-64 it uses the instructions of avx2; there and on 64-bit
/// ARM, where neon has two lanes, it is for debugging and comparison.
enum class Kernel { one_lane, neon, avx2, avx512 };

/// From the least to the most preferred.
template <>
inline constexpr std::array<std::string_view, 4> names_of<Kernel>{"double", "neon", "avx2",
                                                                  "avx512"};

/// Whether the kernel is part of this build; see the CMake option OVERTURN_KERNELS.
bool is_compiled(Kernel kernel);

/// Whether this processor supports the instructions of the kernel.
bool processor_runs(Kernel kernel);

/// is_compiled() and processor_runs().
bool runs_here(Kernel kernel);

/// The widest kernel that runs here. Throws Error.
Kernel widest_kernel();

} // namespace overturn
