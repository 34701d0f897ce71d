// The largest tilt, and how narrowly impacts were avoided or had to happen.
#pragma once

#include "overturn/integrate/observers/observer.hpp"

#include <limits>

namespace overturn {

/// with_impacts: also the speeds of impacts, for filling.
template <Theory theory, Number T, bool with_impacts>
struct Extremes : Observer {
    void pass_step(const Block<T>&, const auto&, const Rocking<T>&, const auto& step,
                   const mask_t<T>& lanes)
    {
        peak = select<T>(lanes, greater<T>(step.extremes.peak, peak), peak);
        lowest_turn =
            select<T>(lanes, lesser<T>(step.extremes.lowest_turn, lowest_turn), lowest_turn);
    }

    void pass_impact(const Block<T>& block, const auto& excitation, const Rocking<T>& now,
                     const mask_t<T>& lanes, const mask_t<T>& rests)
    {
        if constexpr (with_impacts) {
            const T push = now.side * excitation.ground(now.phase);
            const mask_t<T> outward = Equations<theory>::acceleration(block, T(0), push) > 0;
            softest_impact = select<T>(lanes && !rests && outward && -now.rate < softest_impact,
                                       -now.rate, softest_impact);
            last_impact = select<T>(lanes && !rests, -now.rate, last_impact);
        }
    }

    /// The peak remains the largest share of alpha, times the alpha of the side.
    void change_sides(const T& factor) { peak = peak * factor; }

    void complete(ForcedEnd<T>& end, const Block<T>& block, const Block<T>& from_plus, const auto&,
                  const Rocking<T>&) const
    {
        end.peak = any<T>(!block.is_symmetric())
                       ? peak * (from_plus.slenderness / block.slenderness)
                       : peak;
        end.lowest_turn = lowest_turn;
        end.softest_impact = softest_impact;
        end.last_impact = last_impact;
    }

    static T none() { return T(std::numeric_limits<scalar_t<T>>::infinity()); }

    T peak = T(0); ///< of the side on which the block rocks
    T lowest_turn = none();
    T softest_impact = none();
    T last_impact = none();
};

} // namespace overturn
