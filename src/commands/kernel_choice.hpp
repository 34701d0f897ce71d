// The kernel chosen by --kernel.
#pragma once

#include "overturn/sweep/kernel.hpp"

#include <string_view>

namespace overturn {

/// auto: the widest kernel of this build that the processor supports. Throws Error if the processor
/// does not support the kernel, or any of this build, or if it was not compiled.
Kernel kernel_called(std::string_view name);

} // namespace overturn
