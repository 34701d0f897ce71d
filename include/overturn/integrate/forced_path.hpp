// The forced stage of one block in full: where it was at any time.
#pragma once

#include "overturn/integrate/forced_stage.hpp"

namespace overturn {

/// What integrates a path, as finely as doubles allow.
inline constexpr int path_order = 20;
inline constexpr double path_tolerance = 1e-13;

/// The way from rest to the end of the pulse, or to a fall.
struct ForcedPath {
    std::vector<Event<double>> events; ///< in order
    ForcedEnd<double> end;
};

template <Theory theory>
ForcedPath forced_path(const Block<double>& block, const Excitation<double>& excitation);

/// The block between an event, from which on it rocks, and the next one: at a phase [rad] that lies
/// between theirs. It is the series of the step itself that is evaluated.
template <Theory theory>
State<double> state_after(const Event<double>& event, const Block<double>& block,
                          const Excitation<double>& excitation, double phase);

} // namespace overturn
