// How long the next step may be, from the error of the last one.
#pragma once

#include "overturn/number/number.hpp"

#include <cmath>

namespace overturn {

/// error^(3/16), from square roots: IEEE rounds them alike at every lane width. The exponent for a
/// method of order 5 is 1/5; a little less damps the control.
template <Number T>
T step_error_power(const T& error)
{
    using std::sqrt;
    const T eighth = sqrt(sqrt(sqrt(error)));
    return eighth * sqrt(eighth);
}

/// Factor for the step size after a step with this error, in units of the tolerance: 0.9
/// error^(-3/16) within [0.2, 4]; 0.2 if the error is not a number.
template <Number T>
T step_size_factor(const T& error)
{
    using S = scalar_t<T>;
    const T shortest(S(1) / 5);
    const S safety = S(9) / 10;
    // 4 is the bound of the factor, set where nothing is divided by an error of 0 yet.
    const T power = greater<T>(step_error_power(error), T(safety / 4));
    const T factor = T(safety) / power;
    const T grown = select<T>(factor > shortest, factor, shortest);
    return select<T>(error == error, grown, shortest);
}

} // namespace overturn
