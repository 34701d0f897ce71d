// The kernel that the option --kernel names.
#pragma once

#include "overturn/sweep/kernel.hpp"

#include <string_view>

namespace overturn {

/// The kernel of this name; of "auto", the widest one. Throws Error if it does not run here.
Kernel kernel_called(std::string_view name);

} // namespace overturn
