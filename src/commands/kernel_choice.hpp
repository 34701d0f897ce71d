// The kernel that --kernel asks for.
#pragma once

#include "overturn/sweep/kernel.hpp"

#include <string_view>

namespace overturn {

/// auto: the widest one that runs here. Throws UsageError if this processor cannot run the kernel,
/// or if it was not compiled; ProcessorError if none runs here.
Kernel kernel_called(std::string_view name);

} // namespace overturn
