// What the two steppers share: where a rocking block is, and where a step has brought it.
// A stepper follows the motion on one side; impacts, rest and uplift are the forced stage's.
#pragma once

#include "overturn/integrate/error_growth.hpp"

namespace overturn {

/// A block on its way through the pulse.
template <Number T>
struct Rocking {
    T phase; ///< of the pulse [rad]
    T tilt;  ///< |theta| [rad]
    T rate;  ///< d|theta| / d tau [rad]
    T side;  ///< +1 or -1: the sign of theta
};

/// The end of a step: after as long as the stepper dared, or at the first event on the way.
template <Number T>
struct StepEnd {
    T phase;           ///< exactly the pulse's last one where it is reached [rad]
    T tilt;            ///< 0 where it strikes, pi/2 where it falls [rad]
    T rate;            ///< [rad]
    mask_t<T> moved;   ///< elsewhere the step was given up, and is tried again
    mask_t<T> strikes; ///< the ground, with -rate
    mask_t<T> falls;   ///< tilt has reached pi/2
    mask_t<T> broken;  ///< a number is not finite, and no other step would be
};

/// A step that has watched its errors.
template <Number T>
struct WatchedStepEnd : StepEnd<T> {
    StepErrors<T> errors;
};

} // namespace overturn
