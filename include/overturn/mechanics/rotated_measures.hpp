// Intensity measures of two horizontal components that do not depend on the orientation of the
// sensors: RotD50 and RotD100, the median and the largest of the peaks in all directions (D. Boore,
// Bull. Seism. Soc. Am. 100 (2010) 1830-1835).
#pragma once

#include "overturn/mechanics/accelerogram.hpp"

namespace overturn {

struct RotatedMeasures {
    double pga_rotd50 = 0;  ///< [g]
    double pga_rotd100 = 0; ///< [g]
    double pgv_rotd50 = 0;  ///< [m/s]
    double pgv_rotd100 = 0; ///< [m/s]
};

/// Those of a record with two components, over the directions 0, 1, ..., 179 degrees; the peaks
/// of psi + 180 are those of psi. gravity [m/s2].
RotatedMeasures rotated_measures(const Accelerogram& record, double gravity);

} // namespace overturn
