// What shakes the ground under one block, dimensionless: a pulse with an amplitude, a frequency and
// the phases at which it lifts a block at rest.
#pragma once

#include "overturn/mechanics/pulse.hpp"

namespace overturn {

template <class Pulse, Number T>
struct Excitation {
    T acceleration;                      ///< a_p / g [1]; negative: the mirrored pulse
    T frequency;                         ///< Omega = omega_p / p [1]
    std::array<T, Pulse::lobes> uplifts; ///< from uplift_phases() [rad]
    scalar_t<T> begin;                   ///< phase at which the pulse begins and ends [rad]
    scalar_t<T> end;

    /// Acceleration of the ground over g at a phase [1].
    T ground(const T& phase) const { return acceleration * Pulse::value(phase); }
};

} // namespace overturn
