// The end of the forced stage of a block, with its region and margin (Eqs. 11-20).
#pragma once

#include "overturn/mechanics/energy_criteria.hpp"

#include <limits>

namespace overturn {

/// The end of the forced stage. Counts are whole numbers stored as T.
template <Number T>
struct ForcedEnd {
    State<T> state;       ///< at the end of the pulse, or where |theta| reached pi/2
    mask_t<T> fell;       ///< |theta| reached pi/2
    mask_t<T> rested;     ///< came to rest after a bounce series
    mask_t<T> capped;     ///< stopped after too many steps: the state is meaningless
    mask_t<T> not_finite; ///< stopped at a non-finite number: the state is meaningless
    T impacts{};          ///< not those of a bounce series that died out; an output
    T steps;              ///< steps tried
    T phase;              ///< at the end of the motion, or at the fall [rad or samples]
    /// Only if they are outputs:
    T error{};            ///< bound on the error of the margin, to first order; infinite if unknown
    mask_t<T> in_doubt{}; ///< the error is not smaller than |margin|, or there is no margin
    T peak{};             ///< the largest tilt; on the side minus, times alpha+ / alpha- [rad]
    T softest_impact{};   ///< the smallest speed of the impacts that would not occur at a smaller
                          ///< speed, because the block accelerates outward; with the peak
                          ///< under a pulse [rad]
    T last_impact{};      ///< the speed of the last impact; with the peak under a pulse [rad]
    T lowest_turn{};      ///< the lowest tilt at which the block turned outward without an impact;
                          ///< with the peak; infinite if there is none [rad]

    mask_t<T> is_stopped() const { return capped || not_finite; }
};

/// The code of the region of each lane, as a number.
template <Theory theory, Number T>
T region_code_of(const ForcedEnd<T>& end, const Block<T>& block)
{
    const auto code = [](Region region) { return T(int(region)); };
    const T fallen = select<T>(end.state.side > 0, code(Region::F_plus), code(Region::F_minus));
    const T decided =
        select<T>(end.fell, fallen, region_code_after_pulse<theory>(end.state, block));
    return select<T>(end.is_stopped(), code(Region::undecided), decided);
}

template <Theory theory, Number T>
    requires(lanes_v<T> == 1)
Region region_of(const ForcedEnd<T>& end, const Block<T>& block)
{
    return Region(int(region_code_of<theory>(end, block)));
}

/// The margin of each lane [1]; NaN if the point is undecided.
template <Theory theory, Number T>
T margin_of(const ForcedEnd<T>& end, const Block<T>& block)
{
    const T decided = select<T>(end.fell, margin_of_fall<theory>(end.state.rate, block),
                                margin_after_pulse<theory>(end.state, block));
    return select<T>(end.is_stopped(), T(std::numeric_limits<scalar_t<T>>::quiet_NaN()), decided);
}

} // namespace overturn
