// The questions of the page are answered with Taylor series. Without the kernel of the Runge-Kutta
// method, the module is a twelfth smaller.
#include "sweep/sweep_kernel.hpp"

#include "overturn/text/error.hpp"

namespace overturn {

SweepKernel kernel_double_runge_kutta(Theory /*theory*/, const Outputs& /*outputs*/,
                                      Directions /*directions*/)
{
    throw Error(exit_code::usage, "rk45 is not part of this module. Give taylor.");
}

} // namespace overturn
