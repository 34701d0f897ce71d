// The forced stage of a scene that records nothing, as the kernels compile it. Compiled twice, see
// without_records.py: with the headers as they are, and with all that they record cut out.
#include "overturn/integrate/forced_stage.hpp"
#include "overturn/number/pack.hpp"

namespace overturn {

using T = Pack<xsimd::fma3<xsimd::avx2>>;

template <class Method>
ForcedEnd<T> lean_stage(const Block<T>& block, const Excitation<T>& excitation, double tolerance)
{
    return run_forced_stage<Method, Theory::nonlinear, Records{}>(block, excitation, tolerance);
}

template ForcedEnd<T> lean_stage<RungeKutta>(const Block<T>&, const Excitation<T>&, double);
template ForcedEnd<T> lean_stage<Taylor<14>>(const Block<T>&, const Excitation<T>&, double);

} // namespace overturn
