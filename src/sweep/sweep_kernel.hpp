// The kernels: a whole tile through the forced stage, with plain arrays in and out. Each is
// compiled for one pulse and one instruction set, see sweep_kernel.cpp.
#pragma once

#include "overturn/integrate/in_doubt.hpp"
#include "overturn/mechanics/block.hpp"
#include "overturn/sweep/integrator.hpp"

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
    InDoubt in_doubt;

    const int* chosen; ///< which points to compute, counted row by row; nullptr: all
    int chosen_count;

    bool (*drop_requested)(const void* context); ///< asked now and then: leave the rest alone?
    const void* context;
};

/// How a point left the forced stage, in the bits of PointEnds::flags.
namespace end_flag {
inline constexpr std::uint8_t fell = 1;
inline constexpr std::uint8_t rested = 2;
inline constexpr std::uint8_t capped = 4;
inline constexpr std::uint8_t not_finite = 8;
inline constexpr std::uint8_t unresolved = 16; ///< set by ends_of() alone, see resolve.hpp
inline constexpr std::uint8_t in_doubt = 32;   ///< told with the error, see ForcedEnd
inline constexpr std::uint8_t undecided = capped | not_finite;
} // namespace end_flag

/// Where the points of a tile left the forced stage: rows x columns values each, frequency fastest;
/// a kernel touches those of the points that it computes.
struct PointEnds {
    double* tilt;        ///< |theta| [rad]
    double* rate;        ///< d|theta| / d tau [rad]
    double* side;        ///< +1 or -1: the sign of theta
    std::uint8_t* flags; ///< see end_flag
    double* impacts;     ///< as counted; nullptr if nobody asks
    double* error;       ///< of the margin; nullptr if nobody asks
    double* steps;       ///< tried; nullptr if nobody asks
    double* phase;       ///< of the pulse, at a fall its own [rad]; nullptr if nobody asks
    double* peak;        ///< the largest |theta| [rad]; nullptr if nobody asks
};

/// What a kernel keeps a record of beside the end; errors and peaks with the impacts.
enum class Recorded { nothing, impacts, error, peak };

using SweepKernel = void (*)(const TilePoints& points, const PointEnds& ends);

/// What each kernel source defines: the kernel for a method, a theory and what it records.
using SweepKernelChoice = SweepKernel (*)(Integrator integrator, Theory theory, Recorded recorded);

/// The fields that take some computing, from the ends of the forced stage. Compiled for each
/// instruction set, see field_kernel.cpp.
struct FieldKernels {
    void (*regions)(Theory, const Block<double>&, const PointEnds&, int points, std::uint8_t* to);
    void (*margins)(Theory, const Block<double>&, const PointEnds&, int points, double* to);
};

} // namespace overturn
