// The reference: Runge-Kutta-Fehlberg 7(8) of Boost.odeint in long double.
#include "event_in_step.hpp"

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <algorithm>
#include <functional>

namespace overturn::benchmarks {

std::vector<PeerEnd<long double>> solve_reference(const Problem& problem, double tolerance)
{
    namespace odeint = boost::numeric::odeint;
    using S = long double;
    using Stepper = odeint::runge_kutta_fehlberg78<RockingState<S>, S>;
    const S allowed = S(tolerance) * problem.points.front().slenderness;
    auto controlled = odeint::make_controlled<Stepper>(allowed, S(tolerance));
    Stepper plain;

    const auto fly = [&](const Rocking<S>& rocking, Moment<S>& now, bool) {
        const auto system = std::cref(rocking);
        // Short compared with the pulse and with the time unit of the block: the quintic of a step
        // shows every gap that closes and opens again within it.
        const S longest = S(1) / 10 / std::max(S(1), rocking.frequency());
        S h = longest;
        while (true) {
            const Moment<S> before = now;
            const S left = rocking.end() - now.time;
            const bool last = left <= std::min(h, longest);
            h = last ? left : std::min(h, longest);
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
            if (event.outcome != Outcome::pulse_end) {
                now = event.moment;
                return event.outcome;
            }
            if (last) {
                return Outcome::pulse_end;
            }
        }
    };
    return run_points<S>(problem, fly);
}

} // namespace overturn::benchmarks
