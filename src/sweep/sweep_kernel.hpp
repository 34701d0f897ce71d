// The kernels integrate the forced stage of points, from plain arrays to plain arrays. Each is
// compiled by sweep_kernel.cpp for one method, either pulses or records, and one instruction set.
#pragma once

#include "overturn/integrate/outputs.hpp"
#include "overturn/mechanics/pulse_excitation.hpp"
#include "overturn/mechanics/record_excitation.hpp"
#include "overturn/mechanics/region.hpp"
#include "overturn/problem/fields.hpp"
#include "overturn/problem/point.hpp"
#include "overturn/problem/scene.hpp"
#include "overturn/sweep/kernel.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace overturn {

/// The bits of Outcome::flags besides those of the field `status`, and sets of bits.
namespace outcome_flag {
inline constexpr std::uint8_t fell = 64;
inline constexpr std::uint8_t in_doubt = 128; ///< only if the error is an output, see ForcedEnd
/// The stored ones. resolve() sets `unresolved`; a point in `free_fall` is not integrated.
inline constexpr std::uint8_t of_status = status::came_to_rest | status::cap_was_hit |
                                          status::not_finite | status::unresolved |
                                          status::free_fall;
/// The integration was stopped, or did not begin: the state is meaningless.
inline constexpr std::uint8_t without_end =
    status::cap_was_hit | status::not_finite | status::free_fall;
} // namespace outcome_flag

/// The outcome of the forced stage of a point. A kernel writes the values of the second group only
/// if they are outputs.
struct Outcome {
    double tilt;        ///< |theta| [rad]
    double rate;        ///< d|theta| / d tau [rad]
    double side;        ///< +1 or -1: the sign of theta
    std::uint8_t flags; ///< of the field `status`, and outcome_flag

    Region region;
    double margin;         ///< [1]
    double error;          ///< of the margin
    double impacts;        ///< count
    double steps;          ///< tried
    double phase;          ///< end of the motion, or phase of the fall [rad or samples]
    double peak;           ///< the largest |theta| [rad]
    double lowest_turn;    ///< see ForcedEnd [rad]
    double softest_impact; ///< see ForcedEnd [rad]
    double last_impact;    ///< see ForcedEnd [rad]
    double friction;       ///< see ContactDemand [1]
    double normal;         ///< see ContactDemand [1]

    State<double> end() const { return {tilt, rate, side}; }
    bool has(std::uint8_t any_of_flags) const { return (flags & any_of_flags) != 0; }

    /// The value of the field `impacts`. recorded: whether the ground motion is a record, under
    /// which a block may be lifted again after a bounce series.
    std::uint16_t stored_impacts(bool recorded) const
    {
        return !recorded && has(status::came_to_rest)
                   ? impact_count::bounce_series
                   : std::uint16_t(std::min(impacts, double(impact_count::largest)));
    }

    /// A magnitude at the end with the sign of theta; NaN if the integration did not reach the end.
    double with_sign(double magnitude) const
    {
        return has(outcome_flag::without_end) ? std::numeric_limits<double>::quiet_NaN()
               : side > 0                     ? magnitude
                                              : 0.0 - magnitude; // not -0
    }
};

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
