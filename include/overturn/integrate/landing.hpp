// The last correction of a step that was made to end at an event.
#pragma once

#include "overturn/number/number.hpp"

#include <cmath>

namespace overturn {

/// Where a gap vanishes near the end of a step.
template <Number T>
struct Landing {
    T delay;        ///< time from the end of the step to the event, of either sign
    T closing;      ///< speed there, towards it
    mask_t<T> hits; ///< not so where the gap is open and has its minimum above zero
};

/// Newton's correction to second order, from the gap at the end of the step, its rate (negative
/// where it closes) and its acceleration:
///
///     gap + rate delay + acceleration delay^2 / 2 = 0,   closing^2 = rate^2 - 2 acceleration gap
template <Number T>
Landing<T> land(const T& gap, const T& rate, const T& acceleration)
{
    using std::fma;
    using std::sqrt;
    const T zero(scalar_t<T>(0));
    const T one(scalar_t<T>(1));
    const T square = fma(rate, rate, -(acceleration + acceleration) * gap);
    // Within round-off a closed gap may seem never to have been open: then it closes as it is.
    const T closing = sqrt(select<T>(square > zero, square, rate * rate));
    const T denominator = closing - rate;
    const T delay = (gap + gap) / select<T>(denominator > zero, denominator, one);
    return {select<T>(denominator > zero, delay, zero), closing, square >= zero || gap <= zero};
}

} // namespace overturn
