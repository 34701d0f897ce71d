// A point as the kernels take it.
#pragma once

#include "overturn/mechanics/block.hpp"

#include <limits>

namespace overturn {

/// The coordinates of a point, assumed to be exact.
struct Point {
    Block<double> block{0, 0}; ///< as seen from its side plus
    /// a, see scaled_pulse(); under records, the factor on the record [1]. Negative: the mirrored
    /// motion, which is the direction of 180 degrees.
    double amplitude;
    /// Omega, of a block with two different sides omega_p in the unit of its p; under records,
    /// the samples per unit of time [1]
    double frequency;
    /// The index of its record among those of Scene::records(), if there are any. It counts from 0;
    /// the coordinate `motion` counts from 1.
    int record = 0;
    /// The radius of gyration about the centre of mass over R of the side plus; of a box by default
    /// [1]. Only the forces of the contact depend on it.
    double gyration = 0.57735026918962576; // 1 / sqrt(3)
    /// Between block and base [1]; infinite if the block cannot slip.
    double friction = std::numeric_limits<double>::infinity();
    double direction = 0; ///< of the motion, if there are two horizontal components [degree]
};

} // namespace overturn
