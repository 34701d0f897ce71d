// The kernels that run here.
#pragma once

#include "overturn/sweep/kernel.hpp"

#include <vector>

namespace overturn {

inline std::vector<Kernel> every_kernel()
{
    std::vector<Kernel> kernels;
    for (std::size_t kernel = 0; kernel < names_of<Kernel>.size(); ++kernel) {
        if (runs_here(Kernel(kernel))) {
            kernels.push_back(Kernel(kernel));
        }
    }
    return kernels;
}

} // namespace overturn
