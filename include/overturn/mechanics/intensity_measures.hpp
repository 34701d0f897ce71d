// Intensity measures of sampled ground accelerations, which are linear between samples: peaks,
// Arias intensity and significant duration (Arias 1970; Trifunac and Brady 1975); of two horizontal
// components, RotD50 and RotD100, which do not depend on the orientation of the sensors: the median
// and the largest of the peaks in all directions (D. Boore, Bull. Seism. Soc. Am. 100 (2010)
// 1830-1835).
#pragma once

#include "overturn/mechanics/accelerogram.hpp"

#include <span>

namespace overturn {

/// The largest |value|.
double peak_of(std::span<const double> values);

struct IntensityMeasures {
    double pga = 0;                  ///< peak of |a| [g]
    double pgv = 0;                  ///< peak of the velocity at the samples [m/s]
    double arias_intensity = 0;      ///< [m/s]
    double significant_duration = 0; ///< between 5 and 95 % of the Arias intensity [s]
};

/// The intensity measures of an acceleration [g] sampled every `time_step` [s]; gravity [m/s2].
///
///     Arias = pi/(2 gravity) integral of (gravity a)^2 dt,  exact for piecewise linear a
///
/// With fewer than two samples, or if all are 0, only the pga may differ from 0.
IntensityMeasures intensity_measures(std::span<const double> acceleration, double time_step,
                                     double gravity);

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
