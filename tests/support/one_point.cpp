// Compiled once per pulse: OVERTURN_PULSE comes from CMake.
#include "support/one_point.hpp"

namespace overturn {

template <class Method, class Pulse, Theory theory, bool watched>
ForcedEnd<double> run_in_doubles(const Block<double>& block,
                                 const Excitation<Pulse, double>& excitation, double tolerance)
{
    return run_forced_stage<Method, Pulse, theory, Records{.impacts = true, .error = watched}>(
        block, excitation, tolerance);
}

#define OVERTURN_INSTANTIATE(method, theory, watched)                                              \
    template ForcedEnd<double> run_in_doubles<method, OVERTURN_PULSE, theory, watched>(            \
        const Block<double>&, const Excitation<OVERTURN_PULSE, double>&, double);
#define OVERTURN_INSTANTIATE_METHOD(method)                                                        \
    OVERTURN_INSTANTIATE(method, Theory::nonlinear, false)                                         \
    OVERTURN_INSTANTIATE(method, Theory::nonlinear, true)                                          \
    OVERTURN_INSTANTIATE(method, Theory::linear, false)                                            \
    OVERTURN_INSTANTIATE(method, Theory::linear, true)
OVERTURN_INSTANTIATE_METHOD(RungeKutta)
OVERTURN_INSTANTIATE_METHOD(Taylor<14>)
OVERTURN_INSTANTIATE_METHOD(Taylor<20>)

} // namespace overturn
