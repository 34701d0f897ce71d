// The kernels integrate the forced stage of points, from plain arrays to plain arrays. Each is
// compiled by sweep_kernel.cpp for one method, either pulses or records, and one instruction set.
#pragma once

#include "overturn/integrate/outputs.hpp"
#include "overturn/mechanics/pulse_excitation.hpp"
#include "overturn/mechanics/record_excitation.hpp"
#include "overturn/problem/scene.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/sweep/outcome.hpp"

namespace overturn {

/// The task of a kernel, which writes the outcomes of the chosen points.
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

    Outcome* outcomes; ///< of all points
};

using SweepKernel = void (*)(const KernelTask& task);

/// The function that each kernel object defines: returns the kernel for a theory and these outputs.
using SweepKernelChoice = SweepKernel(Theory theory, const Outputs& outputs, Directions directions);

/// Selects a kernel, in kernel.cpp; runs_here(kernel) must be true. directions: those of the
/// record.
SweepKernel sweep_kernel(Kernel kernel, Integrator integrator, Theory theory,
                         const Outputs& outputs, Directions directions);

} // namespace overturn
