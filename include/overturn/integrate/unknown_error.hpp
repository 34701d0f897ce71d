// Whether a run continues once its error is not known any more.
#pragma once

namespace overturn {

/// What happens to a block once it is not certain whether it struck the ground, or how fast. If it
/// will be integrated again anyway, the rest of its motion, perhaps thousands of bounces, is not
/// needed.
enum class OnUnknownError { go_on, stop };

} // namespace overturn
