// A point as the kernels take it.
#pragma once

#include "overturn/mechanics/block.hpp"

namespace overturn {

/// The coordinates of a point, assumed to be exact.
struct Point {
    Block<double> block; ///< as seen from its side plus
    double amplitude;    ///< a, see scaled_pulse(); under records, the factor on the record [1]
    /// Omega, of a block with two different sides omega_p in the unit of its pace; under records,
    /// the samples per unit of time [1]
    double frequency;
    int record = 0;       ///< the index of its record among those of the scene, if there are any
    double direction = 0; ///< of the motion, if there are two horizontal components [degree]
};

} // namespace overturn
