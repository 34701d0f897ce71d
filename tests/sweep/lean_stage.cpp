// The forced stage of a scene that records nothing, as compiled in the kernels. Compiled twice, see
// without_records.py: with the original headers, and with all records removed.
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
