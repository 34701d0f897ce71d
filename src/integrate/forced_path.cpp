#include "overturn/integrate/forced_path.hpp"

#include <algorithm>

namespace overturn {

template <Theory theory>
ForcedPath forced_path(const Block<double>& block, const Excitation<double>& excitation)
{
    constexpr Records records{.impacts = true, .error = true, .events = true};
    ForcedStage<Taylor<path_order>, theory, records, double> stage(block, excitation,
                                                                   path_tolerance);
    while (stage.is_active()) {
        stage.advance();
    }
    return {stage.events(), stage.end()};
}

template <Theory theory>
State<double> state_after(const Event<double>& event, const Block<double>& block,
                          const Excitation<double>& excitation, double phase)
{
    const Rocking<double>& from = event.rocking;
    const double unit = 1 / std::max(1.0, excitation.frequency); // as in TaylorStepper
    const double phase_per_unit = excitation.frequency * unit;
    const auto push = excitation.motion.series<path_order>(from.side * excitation.acceleration,
                                                           from.phase, phase_per_unit);
    const auto series = rocking_series<theory, path_order>(from.tilt, from.rate * unit,
                                                           block.slenderness, push, unit);
    const double time = (phase - from.phase) / phase_per_unit;
    return {.tilt = std::max(0.0, value_of_series(series.tilt, time)),
            .rate = value_of_series(series.rate, time) / unit,
            .side = from.side};
}

template ForcedPath forced_path<Theory::nonlinear>(const Block<double>&, const Excitation<double>&);
template ForcedPath forced_path<Theory::linear>(const Block<double>&, const Excitation<double>&);
template State<double> state_after<Theory::nonlinear>(const Event<double>&, const Block<double>&,
                                                      const Excitation<double>&, double);
template State<double> state_after<Theory::linear>(const Event<double>&, const Block<double>&,
                                                   const Excitation<double>&, double);

} // namespace overturn
