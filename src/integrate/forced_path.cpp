#include "overturn/integrate/forced_path.hpp"

#include <algorithm>

namespace overturn {

template <Theory theory, class Excitation>
ForcedPath forced_path(const Block<double>& block, const Excitation& excitation)
{
    constexpr Outputs outputs{.impacts = true, .error = true, .events = true};
    ForcedStage<Taylor<path_order>, theory, outputs, double, Excitation> stage(block, excitation,
                                                                               path_tolerance);
    while (stage.is_active()) {
        stage.advance();
    }
    return {stage.events(), stage.end()};
}

template <Theory theory, class Excitation>
State<double> state_after(const Event<double>& event, const Block<double>& block,
                          const Excitation& excitation, double phase)
{
    const Rocking<double>& from = event.rocking;
    const Block<double> seen = seen_from(from.side, block);
    const double frequency = excitation.frequency / (block.is_symmetric() ? 1 : seen.pace);
    const double unit = 1 / std::max(1.0, frequency); // as in TaylorStepper
    const double phase_per_unit = frequency * unit;
    const auto push = excitation.template series<path_order>(from.side * excitation.acceleration,
                                                             from.phase, phase_per_unit);
    const auto series = rocking_series<theory, path_order>(from.tilt, from.rate * unit,
                                                           seen.slenderness, push, unit);
    const double time = (phase - from.phase) / phase_per_unit;
    return {.tilt = std::max(0.0, value_of_series(series.tilt, time)),
            .rate = value_of_series(series.rate, time) / unit,
            .side = from.side};
}

#define OVERTURN_INSTANTIATE(theory, Excitation)                                                   \
    template ForcedPath forced_path<theory, Excitation>(const Block<double>&, const Excitation&);  \
    template State<double> state_after<theory, Excitation>(                                        \
        const Event<double>&, const Block<double>&, const Excitation&, double);
using Recorded = RecordExcitation<double, Directions::both>;
OVERTURN_INSTANTIATE(Theory::nonlinear, PulseExcitation<double>)
OVERTURN_INSTANTIATE(Theory::linear, PulseExcitation<double>)
OVERTURN_INSTANTIATE(Theory::nonlinear, Recorded)
OVERTURN_INSTANTIATE(Theory::linear, Recorded)

} // namespace overturn
