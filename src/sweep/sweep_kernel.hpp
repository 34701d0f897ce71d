// The kernels: points through the forced stage, with plain arrays in and out. Each source is
// compiled for one method and one instruction set, see sweep_kernel.cpp.
#pragma once

#include "overturn/integrate/records.hpp"
#include "overturn/mechanics/block.hpp"
#include "overturn/mechanics/ground_motion.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/sweep/plane.hpp"

#include <cstdint>

namespace overturn {

/// What the ground does to the blocks of one slenderness at one amplitude.
struct Push {
    double acceleration;          ///< a_p / g [1]
    UpliftPhases<double> uplifts; ///< [rad]
};

/// What a kernel is asked to do.
struct KernelTask {
    const GroundMotion<double>& motion;
    const PlanePoint* points;
    const int* push_of_point; ///< its number in `pushes`, ascending
    const Push* pushes;
    double tolerance; ///< see Numerics
    Records records;
    OnUnknownError on_unknown_error;

    const int* chosen; ///< which points to compute, ascending; nullptr: the first chosen_count
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
inline constexpr std::uint8_t unresolved = 16; ///< set by ends_of() alone, see resolve.cpp
inline constexpr std::uint8_t in_doubt = 32;   ///< with the error, see ForcedEnd
inline constexpr std::uint8_t undecided = capped | not_finite;
} // namespace end_flag

/// Where points left the forced stage: one value each. A kernel writes those of the points that it
/// computes, and of the last ones those that the records ask for.
struct PointEnds {
    double* tilt;        ///< |theta| [rad]
    double* rate;        ///< d|theta| / d tau [rad]
    double* side;        ///< +1 or -1: the sign of theta
    std::uint8_t* flags; ///< see end_flag

    std::uint8_t* region; ///< its code
    double* margin;       ///< [1]
    double* impacts;      ///< as counted
    double* error;        ///< of the margin
    double* steps;        ///< tried
    double* phase;        ///< of the pulse, at a fall its own [rad]
    double* peak;         ///< the largest |theta| [rad]
};

using SweepKernel = void (*)(const KernelTask& task, const PointEnds& ends);

/// What each kernel source defines: the kernel for a theory and what it records on the way.
using SweepKernelChoice = SweepKernel (*)(Theory theory, const Records& records);

/// One of them, of a kernel for which runs_here() is true.
SweepKernel sweep_kernel(Kernel kernel, Integrator integrator, Theory theory,
                         const Records& records);

} // namespace overturn
