// GSL: Runge-Kutta Prince-Dormand 8(9) with GSL's step size control; events by repeated steps.
#include "event_in_step.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace overturn::benchmarks {

namespace {

template <class RockingBlock>
int rocking_derivative(double time, const double state[], double derivative[], void* rocking)
{
    derivative[0] = state[1];
    derivative[1] = static_cast<const RockingBlock*>(rocking)->acceleration(state[0], time);
    return GSL_SUCCESS;
}

using StepHandle = std::unique_ptr<gsl_odeiv2_step, decltype(&gsl_odeiv2_step_free)>;
using ControlHandle = std::unique_ptr<gsl_odeiv2_control, decltype(&gsl_odeiv2_control_free)>;
using EvolveHandle = std::unique_ptr<gsl_odeiv2_evolve, decltype(&gsl_odeiv2_evolve_free)>;

} // namespace

template <Sines sines>
std::vector<PeerEnd<double>> solve_by_gsl_rk8pd(const PeerProblem& problem, double tolerance)
{
    gsl_set_error_handler_off();
    const StepHandle step(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, 2), gsl_odeiv2_step_free);
    const ControlHandle control(
        gsl_odeiv2_control_y_new(tolerance * problem.points.front().block.slenderness, tolerance),
        gsl_odeiv2_control_free);
    const EvolveHandle evolve(gsl_odeiv2_evolve_alloc(2), gsl_odeiv2_evolve_free);
    const double first_step = std::pow(tolerance, 1.0 / 8);
    double h = 0; // the next step; kept from flight to flight

    const auto fly = [&]<class RockingBlock>(const RockingBlock& rocking, Moment<double>& now,
                                             Start start) {
        const gsl_odeiv2_system system{rocking_derivative<RockingBlock>, nullptr, 2,
                                       const_cast<RockingBlock*>(&rocking)};
        if (start != Start::sample) { // at a sample, the derivative is known
            gsl_odeiv2_evolve_reset(evolve.get());
        }
        if (start == Start::uplift) {
            h = first_step / rocking.fastest();
        }
        while (now.time < rocking.end()) {
            const Moment<double> before = now;
            if (gsl_odeiv2_evolve_apply(evolve.get(), control.get(), step.get(), &system, &now.time,
                                        rocking.end(), &h, now.state.data()) != GSL_SUCCESS) {
                return Outcome::failure;
            }
            const auto step_to = [&](double length) {
                RockingState<double> state = before.state;
                RockingState<double> error;
                RockingState<double> derivative;
                rocking(state, derivative, before.time);
                gsl_odeiv2_step_apply(step.get(), before.time, length, state.data(), error.data(),
                                      derivative.data(), nullptr, &system);
                return state;
            };
            const auto event = event_in_step(rocking, before, now, tolerance / 8, step_to);
            if (event.outcome != Outcome::piece_end) {
                now = event.moment;
                return event.outcome;
            }
        }
        return Outcome::piece_end;
    };
    return run_points<double, sines>(problem, fly);
}

template std::vector<PeerEnd<double>> solve_by_gsl_rk8pd<Sines::library>(const PeerProblem&,
                                                                         double);
template std::vector<PeerEnd<double>> solve_by_gsl_rk8pd<Sines::overturn>(const PeerProblem&,
                                                                          double);

} // namespace overturn::benchmarks
