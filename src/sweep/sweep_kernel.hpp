// The kernels: a whole tile through the forced stage, with plain arrays in and out. Each is
// compiled for one pulse and one instruction set, see sweep_kernel.cpp.
#pragma once

#include "overturn/mechanics/block.hpp"

#include <cstdint>

namespace overturn {

/// The points of a tile: every row, at one acceleration of the ground, has every frequency.
struct TilePoints {
    double slenderness; ///< alpha [rad]
    double restitution; ///< r [1]
    int rows;
    int columns;
    const double* acceleration; ///< a_p / g, one per row [1]
    const double* uplifts;      ///< uplift phases, rows x lobes of the pulse [rad]
    const double* frequency;    ///< Omega, one per column [1]
    double begin;               ///< phases at which the pulse begins and ends [rad]
    double end;
    double tolerance; ///< see Numerics
};

/// How one point left the forced stage.
struct PointEnd {
    double tilt;    ///< |theta| [rad]
    double rate;    ///< d|theta| / d tau [rad]
    double impacts; ///< as counted
    bool plus;      ///< theta is positive
    bool fell;
    bool rested;
    bool capped;
    bool not_finite;
};

/// Fills rows x columns ends, frequency fastest.
using SweepKernel = void (*)(const TilePoints& points, PointEnd* ends);

/// The methods that the kernels are compiled for: a Taylor series is written out for its order.
enum class Integrator { runge_kutta, taylor_14, taylor_20 };

/// What each kernel source defines: the kernel for a method and a theory, with or without counting
/// impacts.
using SweepKernelChoice = SweepKernel (*)(Integrator integrator, Theory theory, bool count_impacts);

} // namespace overturn
