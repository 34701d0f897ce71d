// The end of the forced stage of a block under a recorded ground motion.
#pragma once

#include "overturn/integrate/forced_end.hpp"
#include "support/random_record.hpp"

namespace overturn {

/// run_forced_stage() with Taylor<order>, outputs impacts and error. Compiled once, in
/// record_point.cpp, for the orders 8, 14 and 20.
template <Theory theory, Directions directions, int order = 14>
ForcedEnd<double> run_record(const RecordPoint& point, double tolerance);

/// The largest tilt [rad].
template <Theory theory, Directions directions>
double peak_under_record(const RecordPoint& point, double tolerance);

/// The tilts at all steps and events: at all samples while the block rocks [rad].
template <Theory theory, Directions directions>
std::vector<double> tilts_at_samples(const RecordPoint& point, double tolerance);

} // namespace overturn
