// Which kernel serves a run: one of those that were compiled.
#pragma once

#include "sweep_kernel.hpp"

#include "overturn/sweep/integrator.hpp"
#include "overturn/sweep/kernel.hpp"

namespace overturn {

/// runs_here(kernel).
SweepKernel sweep_kernel(Kernel kernel, Integrator integrator, Theory theory,
                         const Records& records);

} // namespace overturn
