// What is recorded of a forced stage: said once, from the fields of a job down to the kernels.
#pragma once

namespace overturn {

/// What is wanted beside the state in which the pulse leaves a block.
struct Records {
    // Recorded on the way: a choice at compile time, so that the others pay nothing in a step.
    bool impacts = false;
    bool error = false;  ///< of the margin
    bool peak = false;   ///< the largest tilt; not together with the error
    bool events = false; ///< of a single block only

    // Known at the end of any run.
    bool region = false;
    bool margin = false;
    bool steps = false;
    bool phase = false; ///< of the pulse: its end, or where the block fell
};

/// Whether a run continues once it is not certain whether the block struck the ground, or how fast.
/// One that will be integrated again anyway need not: thousands of bounces may follow.
enum class OnUnknownError { go_on, stop };

} // namespace overturn
