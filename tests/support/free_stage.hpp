// The free stage by plain numerical integration: the reference for the regions.
#pragma once

#include "overturn/mechanics/energy_criteria.hpp"

#include <cmath>

namespace overturn {

/// The region of a block that the pulse left standing.
template <Theory theory, class T>
Region region_after_pulse(const State<T>& state, const Block<T>& block)
{
    return Region(int(region_code_after_pulse<theory>(state, block)));
}

struct FreeOutcome {
    bool falls = false;
    int impacts = 0; ///< before overturning
    double side = 0; ///< to which it overturns: +1 or -1
};

/// Classical Runge-Kutta on |theta|'' = -sin(alpha - |theta|) with steps of a hundredth of 1/p,
/// until the block is overturned, or has lost so much energy at impacts that it cannot reach either
/// top. block: as seen from the side of the state.
inline FreeOutcome watch_free_stage(State<double> state, Block<double> block)
{
    const double h = 0.01;
    const auto pull = [&](double tilt) { return -std::sin(block.slenderness - tilt); };
    FreeOutcome outcome;
    while (state.tilt < std::acos(0.0)) {
        const double k1 = pull(state.tilt);
        const double k2 = pull(state.tilt + h / 2 * state.rate);
        const double k3 = pull(state.tilt + h / 2 * (state.rate + h / 2 * k1));
        const double k4 = pull(state.tilt + h * (state.rate + h / 2 * k2));
        const State<double> next{state.tilt + h * (state.rate + h / 6 * (k1 + k2 + k3)),
                                 state.rate + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), state.side};
        if (next.tilt >= 0) {
            state = next;
            continue;
        }
        // The velocity at the impact from the energy, conserved since the last impact (Eq. 5).
        const double alpha = block.slenderness;
        const double below = std::cos(alpha - state.tilt) - std::cos(alpha);
        const double speed = std::sqrt(state.rate * state.rate + 2 * below);
        state = {0, block.rate_ratio() * speed, -state.side};
        block = block.turned();
        ++outcome.impacts;
        const double energy = block.size * state.rate * state.rate / 2; // over m g
        const auto barrier = [](double size, double alpha_of_side) {
            return size * (1 - std::cos(alpha_of_side));
        };
        if (energy < barrier(block.size, block.slenderness) &&
            energy < barrier(block.other.size, block.other.slenderness)) {
            return outcome;
        }
        if (outcome.impacts > 10) {
            return outcome;
        }
    }
    outcome.falls = true;
    outcome.side = state.side;
    return outcome;
}

} // namespace overturn
