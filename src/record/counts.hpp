// Samples of a digitiser, in counts.
#pragma once

#include "lines.hpp"

#include <vector>

namespace overturn {

/// The accelerations of counts c with the mean m, which is the offset of the sensor:
///
///     a = (c - m) acceleration / counts
///
/// `counts` is the number of counts of `acceleration`, in any unit. lines: where both are stated.
/// Refuses numbers whose accelerations are not finite.
std::vector<double> acceleration_of_counts(const Lines& lines, std::vector<double> samples,
                                           double acceleration, double counts);

} // namespace overturn
