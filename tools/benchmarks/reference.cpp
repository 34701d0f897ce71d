// The reference: Runge-Kutta-Fehlberg 7(8) of Boost.odeint in long double.
#include "event_in_step.hpp"

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <algorithm>
#include <functional>

namespace overturn::benchmarks {

std::vector<PeerEnd<long double>> solve_reference(const PeerProblem& problem, double tolerance)
{
    namespace odeint = boost::numeric::odeint;
    using S = long double;
    using Stepper = odeint::runge_kutta_fehlberg78<RockingState<S>, S>;
    const S allowed = S(tolerance) * problem.points.front().block.slenderness;
    auto controlled = odeint::make_controlled<Stepper>(allowed, S(tolerance));
    Stepper plain;

    S h = 0; // the next step; kept from sample to sample
    const auto fly = [&](const auto& rocking, Moment<S>& now, Start start) {
        const auto system = std::cref(rocking);
        // Short compared with the pulse and with the time unit of the block: the quintic of a step
        // shows every gap that closes and opens again within it.
        const S longest = S(1) / 10 / rocking.fastest();
        if (start != Start::sample) {
            h = longest;
        }
        while (true) {
            const Moment<S> before = now;
            const S left = rocking.end() - now.time;
            const S wanted = std::min(h, longest);
            const bool last = left <= wanted;
            h = last ? left : wanted;
            if (h < longest * std::numeric_limits<S>::epsilon() && !last) {
                return Outcome::failure;
            }
            if (controlled.try_step(system, now.state, now.time, h) == odeint::fail) {
                continue;
            }
            const auto step_to = [&](const S& length) {
                RockingState<S> state = before.state;
                plain.do_step(system, state, before.time, length);
                return state;
            };
            const S sharpness = std::numeric_limits<S>::epsilon() / 1024;
            const auto event = event_in_step(rocking, before, now, sharpness, step_to);
            if (event.outcome != Outcome::piece_end) {
                now = event.moment;
                return event.outcome;
            }
            if (last) {
                h = std::max(h, wanted);
                return Outcome::piece_end;
            }
        }
    };
    return run_points<S>(problem, fly);
}

} // namespace overturn::benchmarks
