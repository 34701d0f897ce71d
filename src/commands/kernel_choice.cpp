#include "kernel_choice.hpp"

#include "overturn/text/error.hpp"

namespace overturn {

Kernel kernel_called(std::string_view name)
{
    if (name == "auto") {
        return widest_kernel();
    }
    const Kernel kernel = *enumerator_named<Kernel>(name);
    if (!processor_runs(kernel)) {
        throw Error(exit_code::usage,
                    "--kernel {}: this processor does not support it. The widest "
                    "kernel that it supports is {}.",
                    name, name_of(widest_kernel()));
    }
    if (!is_compiled(kernel)) {
        throw Error(exit_code::usage,
                    "--kernel {}: this build has no kernel {}. Configure it with "
                    "-DOVERTURN_KERNELS=all.",
                    name, name);
    }
    return kernel;
}

} // namespace overturn
