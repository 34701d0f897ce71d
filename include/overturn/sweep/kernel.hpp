// The lane widths in which the forced stage can run, and what this processor can do.
#pragma once

#include <array>
#include <stdexcept>
#include <string_view>

namespace overturn {

/// All give the same bits. one_lane is to read and to compare with: it has the instructions of
/// avx2, but computes one point at a time.
enum class Kernel { one_lane, avx2, avx512 };

inline constexpr std::array<std::string_view, 3> kernel_names{"double", "avx2", "avx512"};
constexpr std::string_view name_of(Kernel kernel)
{
    return kernel_names[std::size_t(kernel)];
}

/// CMake's option OVERTURN_KERNELS decides.
bool is_compiled(Kernel kernel);

/// Whether this processor has the instructions of the kernel.
bool processor_runs(Kernel kernel);

/// is_compiled() and processor_runs().
bool runs_here(Kernel kernel);

/// This processor can run no kernel that was compiled.
class ProcessorError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The widest kernel that runs here. Throws ProcessorError.
Kernel widest_kernel();

} // namespace overturn
