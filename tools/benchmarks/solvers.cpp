#include "peer.hpp"

namespace overturn::benchmarks {

std::vector<Solver> all_solvers(bool recorded)
{
    std::vector<Solver> solvers = overturn_solvers(recorded);
    solvers.push_back({"odeint_dopri5", solve_by_odeint_dopri5});
    solvers.push_back(
        {"odeint_dopri5_restepping", solve_by_odeint_dopri5_restepping<Sines::library>});
    solvers.push_back(
        {"odeint_dopri5_restepping_our_sines", solve_by_odeint_dopri5_restepping<Sines::overturn>});
    solvers.push_back({"gsl_rk8pd", solve_by_gsl_rk8pd<Sines::library>});
    solvers.push_back({"gsl_rk8pd_our_sines", solve_by_gsl_rk8pd<Sines::overturn>});
    solvers.push_back({"arkode_dopri5", solve_by_arkode});
    if (!recorded) { // a multistep method is a hundred times slower with a kink at every sample
        solvers.push_back({"cvode_adams", solve_by_cvode_adams});
    }
    return solvers;
}

} // namespace overturn::benchmarks
