// Boost.odeint: Dormand-Prince 5(4) with odeint's step size control. Events are found in two ways:
// on the dense output, as a user of odeint would do it, and by repeated steps.
#include "event_in_step.hpp"

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/dense_output_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace overturn::benchmarks {

namespace {

namespace odeint = boost::numeric::odeint;

using Stepper = odeint::runge_kutta_dopri5<RockingState<double>>;

/// The first step of a flight from rest.
double first_step(double tolerance, double fastest)
{
    return std::pow(tolerance, 0.2) / fastest;
}

double allowed_error(double tolerance, const PeerProblem& problem)
{
    return tolerance * problem.points.front().block.slenderness;
}

} // namespace

std::vector<PeerEnd<double>> solve_by_odeint_dopri5(const PeerProblem& problem, double tolerance)
{
    auto dense = odeint::make_dense_output<Stepper>(allowed_error(tolerance, problem), tolerance);
    double h = 0; // the next step; kept from flight to flight
    const auto fly = [&](const auto& rocking, Moment<double>& now, Start start) {
        if (start == Start::uplift) {
            h = first_step(tolerance, rocking.fastest());
        }
        dense.initialize(now.state, now.time, h);
        while (true) {
            const double wanted = dense.current_time_step();
            const double left = rocking.end() - dense.current_time();
            const double reached_last = dense.current_time() + left; // rounded
            if (wanted > left) {
                // A step beyond the end with interpolation is no faster.
                dense.initialize(dense.current_state(), dense.current_time(), left);
            }
            dense.do_step(std::cref(rocking));
            const Moment<double> before{dense.previous_time(), dense.previous_state()};
            now = {dense.current_time(), dense.current_state()};
            if (!(now.time > before.time)) {
                return Outcome::failure;
            }
            const bool last = now.time >= reached_last;
            h = last ? std::max(wanted, dense.current_time_step()) : dense.current_time_step();
            const auto step_to = [&](double length) {
                RockingState<double> state;
                dense.calc_state(before.time + length, state);
                return state;
            };
            const auto event = event_in_step(rocking, before, now, tolerance / 8, step_to);
            if (event.outcome != Outcome::piece_end) {
                now = event.moment;
                return event.outcome;
            }
            if (last) {
                return Outcome::piece_end;
            }
        }
    };
    return run_points<double>(problem, fly);
}

template <Sines sines>
std::vector<PeerEnd<double>> solve_by_odeint_dopri5_restepping(const PeerProblem& problem,
                                                               double tolerance)
{
    auto controlled =
        odeint::make_controlled<Stepper>(allowed_error(tolerance, problem), tolerance);
    Stepper plain;
    double h = 0; // the next step; kept from flight to flight
    // At `now`: the last stage of a step is the first stage of the next.
    RockingState<double> derivative;

    const auto fly = [&](const auto& rocking, Moment<double>& now, Start start) {
        const auto system = std::cref(rocking);
        if (start == Start::uplift) {
            h = first_step(tolerance, rocking.fastest());
        }
        if (start != Start::sample) {
            rocking(now.state, derivative, now.time);
        }
        while (true) {
            const Moment<double> before = now;
            const double left = rocking.end() - now.time;
            const double wanted = h;
            const bool last = left <= h;
            h = last ? left : h;
            if (now.time + h == now.time && !last) {
                return Outcome::failure;
            }
            // A step that overwrites `now` directly is a tenth slower.
            RockingState<double> after;
            RockingState<double> derivative_after;
            if (controlled.try_step(system, now.state, derivative, now.time, after,
                                    derivative_after, h) == odeint::fail) {
                continue;
            }
            now.state = after;
            const auto step_to = [&](double length) {
                RockingState<double> state;
                RockingState<double> unused;
                plain.do_step(system, before.state, derivative, before.time, state, unused, length);
                return state;
            };
            const auto event = event_in_step(rocking, before, now, tolerance / 8, step_to);
            if (event.outcome != Outcome::piece_end) {
                now = event.moment;
                return event.outcome;
            }
            derivative = derivative_after;
            if (last) {
                h = std::max(h, wanted);
                return Outcome::piece_end;
            }
        }
    };
    return run_points<double, sines>(problem, fly);
}

template std::vector<PeerEnd<double>>
solve_by_odeint_dopri5_restepping<Sines::library>(const PeerProblem&, double);
template std::vector<PeerEnd<double>>
solve_by_odeint_dopri5_restepping<Sines::overturn>(const PeerProblem&, double);

} // namespace overturn::benchmarks
