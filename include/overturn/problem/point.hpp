// A point as the kernels take it, and the ground accelerations that move its block.
#pragma once

#include "overturn/mechanics/block.hpp"
#include "overturn/problem/scene.hpp"

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

/// The ground acceleration over g that lifts a block of this slenderness [rad] at rest [1].
double uplift_threshold(Theory theory, double slenderness);

/// The record of a point, in its direction.
Record directed_record(const Scene& scene, const Point& point);

/// The peak ground acceleration over g of a motion of the strength 1: the amplitude of a pulse that
/// excites the block of this point, or the scale of its record.
double pga_of_unit(const Scene& scene, const Point& point);

/// The amplitude of a point from which on the vertical motion cancels gravity at some time;
/// infinite without a vertical motion.
double free_fall_amplitude(const Scene& scene, const Point& point);

/// The largest peak ground acceleration over g at which the motion of this point does not lift its
/// block at rest; infinite if none does.
double lifting_pga(const Scene& scene, const Point& point);

/// The same for a motion that does not move the block at rest: it neither lifts it nor makes it
/// slide.
double moving_pga(const Scene& scene, const Point& point);

/// Whether the block has a friction coefficient.
bool may_slip(const Point& point);

/// Whether the block slides before it could lift on either side, so that it never rocks.
bool stays_flat(const Point& point);

} // namespace overturn
