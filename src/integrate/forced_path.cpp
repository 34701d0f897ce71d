// Compiled once per pulse: OVERTURN_PULSE comes from CMake.
#include "overturn/integrate/forced_path.hpp"

#include <algorithm>

namespace overturn {

template <class Pulse, Theory theory>
ForcedPath forced_path(const Block<double>& block, const Excitation<Pulse, double>& excitation)
{
    constexpr Records records{.impacts = true, .error = true, .milestones = true};
    ForcedStage<Taylor<path_order>, Pulse, theory, records, double> stage(block, excitation,
                                                                          path_tolerance);
    while (stage.is_active()) {
        stage.advance();
    }
    return {stage.milestones(), stage.end()};
}

template <class Pulse, Theory theory>
State<double> state_after(const Milestone<double>& milestone, const Block<double>& block,
                          const Excitation<Pulse, double>& excitation, double phase)
{
    const Rocking<double>& from = milestone.rocking;
    const double unit = 1 / std::max(1.0, excitation.frequency); // as a stepper's, see there
    const double phase_per_unit = excitation.frequency * unit;
    const auto push = pulse_series<Pulse, path_order>(from.side * excitation.acceleration,
                                                      from.phase, phase_per_unit);
    const auto series = rocking_series<theory, path_order>(from.tilt, from.rate * unit,
                                                           block.slenderness, push, unit);
    const double time = (phase - from.phase) / phase_per_unit;
    return {.tilt = std::max(0.0, value_of_series(series.tilt, time)),
            .rate = value_of_series(series.rate, time) / unit,
            .side = from.side};
}

#define OVERTURN_INSTANTIATE(pulse, theory)                                                        \
    template ForcedPath forced_path<pulse, theory>(const Block<double>&,                           \
                                                   const Excitation<pulse, double>&);              \
    template State<double> state_after<pulse, theory>(                                             \
        const Milestone<double>&, const Block<double>&, const Excitation<pulse, double>&, double);
OVERTURN_INSTANTIATE(OVERTURN_PULSE, Theory::nonlinear)
OVERTURN_INSTANTIATE(OVERTURN_PULSE, Theory::linear)

} // namespace overturn
