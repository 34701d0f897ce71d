// The forced stage of one block in full: its state at any time.
#pragma once

#include "overturn/integrate/forced_stage.hpp"
#include "overturn/mechanics/record_excitation.hpp"

namespace overturn {

/// The order and tolerance for a path, as accurate as doubles allow.
inline constexpr int path_order = 20;
inline constexpr double path_tolerance = 1e-13;

/// The path from rest to the end of the pulse, or to the fall.
struct ForcedPath {
    std::vector<Event<double>> events; ///< in order
    ForcedEnd<double> end;
};

/// block, excitation: as seen from the side plus; excitation: PulseExcitation<double> or
/// RecordExcitation<double, Directions::both>.
template <Theory theory, class Excitation>
ForcedPath forced_path(const Block<double>& block, const Excitation& excitation);

/// The state at a phase [rad] between an event, after which the block rocks, and the next one.
/// Evaluates the series of the step itself.
template <Theory theory, class Excitation>
State<double> state_after(const Event<double>& event, const Block<double>& block,
                          const Excitation& excitation, double phase);

} // namespace overturn
