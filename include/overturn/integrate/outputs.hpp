// What is computed of a forced stage. Used at all levels, from job fields to kernels.
#pragma once

namespace overturn {

/// The outputs in addition to the state at the end of the pulse.
struct Outputs {
    // Updated in every step. Chosen at compile time, so that they cost nothing if not wanted.
    bool impacts = false;
    bool error = false;   ///< of the margin
    bool peak = false;    ///< the largest tilt and how narrowly impacts were avoided
    bool contact = false; ///< what it must bear; only in the nonlinear theory
    bool events = false;  ///< for a single block only

    // Computed from the end of a run.
    bool region = false;
    bool margin = false;
    bool steps = false;
    bool phase = false; ///< at the end of the pulse, or at the fall
    bool slide =
        false; ///< of blocks that may slip; of a kernel, the friction that they need to stick
    bool grazes = false; ///< lowest turn, softest and last impact, which a run with the peak has
};

/// Whether a run continues once it is uncertain whether, or how fast, the block struck the ground.
/// A run that will be repeated anyway can stop: thousands of bounces may follow.
enum class UncertainImpact { go_on, stop };

} // namespace overturn
