// Values that are allowed, but are probably in another unit. They are computed all the same.
#pragma once

#include "overturn/problem/grid.hpp"
#include "overturn/problem/scene.hpp"

#include <string>

namespace overturn {

/// What looks like a mistake, most often in a unit, as one text without a full stop; empty if
/// nothing does. Judged are alpha, R, the period of the pulse, the amplitude, the peak ground
/// acceleration and r of the blocks, g, samples and time steps of the records, and the directions.
///
/// Every value that is given in metres, seconds, g or radians, and every row of a list, must be
/// plausible. Of the values that follow from dimensionless axes, one is enough: wide axes are
/// usual.
std::string implausible_values(const Scene& scene, const Grid& grid);

} // namespace overturn
