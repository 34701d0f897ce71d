// A point as the kernels take it.
#pragma once

namespace overturn {

/// The coordinates of a point, assumed to be exact.
struct Point {
    double slenderness; ///< [rad]
    double restitution; ///< r [1]
    double amplitude;   ///< a; under records, the factor on the record [1]
    double frequency;   ///< Omega; under records, the samples per time unit 1/p [1]
    int record = 0;     ///< the index of its record among those of the scene, if there are any
};

} // namespace overturn
