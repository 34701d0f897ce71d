// The kernels integrate the forced stage of points, with plain arrays as input and output. Each is
// compiled by sweep_kernel.cpp for one method, either pulses or records, and one instruction set.
#pragma once

#include "overturn/integrate/outputs.hpp"
#include "overturn/mechanics/pulse_excitation.hpp"
#include "overturn/mechanics/record_excitation.hpp"
#include "overturn/problem/point.hpp"
#include "overturn/problem/scene.hpp"
#include "overturn/sweep/kernel.hpp"

#include <cstdint>

namespace overturn {

/// The input of a kernel.
struct KernelTask {
    const PulseMotion<double>& pulse; ///< unless there is a record
    const Accelerogram* record;
    const Point* points;
    bool are_symmetric;        ///< all blocks
    const int* pulse_of_point; ///< index into `pulses`, ascending; only under a pulse
    const ScaledPulse<double>* pulses;
    double tolerance; ///< see Numerics
    Outputs outputs;
    UncertainImpact uncertain_impact;

    const int* chosen; ///< points to compute, ascending
    int chosen_count;

    bool (*drop_requested)(const void* context); ///< called regularly; true ends the computation
    const void* context;
};

/// The bits of OutcomePointers::flags.
namespace outcome_flag {
inline constexpr std::uint8_t fell = 1;
inline constexpr std::uint8_t rested = 2;
inline constexpr std::uint8_t capped = 4;
inline constexpr std::uint8_t not_finite = 8;
inline constexpr std::uint8_t unresolved = 16; ///< set only by outcomes_of(), see resolve.cpp
inline constexpr std::uint8_t in_doubt = 32;   ///< only if the error is an output, see ForcedEnd
inline constexpr std::uint8_t free_fall = 64;  ///< not integrated, see PointRun
/// The integration was stopped, or did not begin: the state is meaningless.
inline constexpr std::uint8_t without_end = capped | not_finite | free_fall;
} // namespace outcome_flag

/// The outcomes of the forced stage, one value per point. A kernel writes the points that it
/// computes; it writes the arrays of the second group only if they are outputs.
struct OutcomePointers {
    double* tilt;        ///< |theta| [rad]
    double* rate;        ///< d|theta| / d tau [rad]
    double* side;        ///< +1 or -1: the sign of theta
    std::uint8_t* flags; ///< see outcome_flag

    std::uint8_t* region;   ///< region code
    double* margin;         ///< [1]
    double* impacts;        ///< count
    double* error;          ///< of the margin
    double* steps;          ///< tried
    double* phase;          ///< end of the motion, or phase of the fall [rad or samples]
    double* peak;           ///< the largest |theta| [rad]
    double* lowest_turn;    ///< see ForcedEnd [rad]
    double* softest_impact; ///< see ForcedEnd [rad]
    double* last_impact;    ///< see ForcedEnd [rad]
    double* friction;       ///< see ContactDemand [1]
    double* normal;         ///< see ContactDemand [1]
};

using SweepKernel = void (*)(const KernelTask& task, const OutcomePointers& outcomes);

/// The function that each kernel object defines: returns the kernel for a theory and these outputs.
using SweepKernelChoice = SweepKernel (*)(Theory theory, const Outputs& outputs,
                                          Directions directions);

/// Selects a kernel, in kernel.cpp; runs_here(kernel) must be true. directions: those of the
/// record.
SweepKernel sweep_kernel(Kernel kernel, Integrator integrator, Theory theory,
                         const Outputs& outputs, Directions directions);

} // namespace overturn
