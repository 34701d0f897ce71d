#include "support/one_point.hpp"

namespace overturn {

template <class Method, Theory theory, bool with_error>
ForcedEnd<double> run_in_doubles(const Block<double>& block,
                                 const PulseExcitation<double>& excitation, double tolerance)
{
    return run_forced_stage<Method, theory, Outputs{.impacts = true, .error = with_error}>(
        block, excitation, tolerance);
}

#define OVERTURN_INSTANTIATE(method, theory, with_error)                                           \
    template ForcedEnd<double> run_in_doubles<method, theory, with_error>(                         \
        const Block<double>&, const PulseExcitation<double>&, double);
#define OVERTURN_INSTANTIATE_METHOD(method)                                                        \
    OVERTURN_INSTANTIATE(method, Theory::nonlinear, false)                                         \
    OVERTURN_INSTANTIATE(method, Theory::nonlinear, true)                                          \
    OVERTURN_INSTANTIATE(method, Theory::linear, false)                                            \
    OVERTURN_INSTANTIATE(method, Theory::linear, true)
OVERTURN_INSTANTIATE_METHOD(RungeKutta)
OVERTURN_INSTANTIATE_METHOD(Taylor<14>)
OVERTURN_INSTANTIATE_METHOD(Taylor<20>)

} // namespace overturn
