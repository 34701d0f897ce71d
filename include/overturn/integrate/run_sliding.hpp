// Follows a block that may slip to the end of its motion.
#pragma once

#include "overturn/mechanics/block.hpp"
#include "overturn/mechanics/region.hpp"

#include <array>
#include <limits>

namespace overturn {

/// How the motion of a block that may slip ended.
template <class S>
struct SlidingEnd {
    State<S> state;                    ///< at the end of the ground motion, or at a fall before it
    Region region = Region::undecided; ///< undecided if it jams, leaves the ground or is stopped
    bool fell = false;                 ///< during the ground motion
    bool slipped = false;
    /// It slips after the end of the ground motion, before the verdict is known: there is no
    /// margin.
    bool slips_after = false;
    bool jammed = false;
    bool lifted_off = false;
    bool capped = false;
    int impacts = 0; ///< during the ground motion
    int steps = 0;
    S uplift = S(std::numeric_limits<double>::infinity()); ///< phase of the first uplift
    S phase = S(0);        ///< of the end of the ground motion, or of a fall before it
    S time_of_fall = S(0); ///< from that phase on, in units of time; infinite if it stands
    S peak = S(0);         ///< the largest tilt; on the side minus, times alpha+ / alpha- [rad]
    S slide = S(0);        ///< of the base, positive towards the side plus
    S slide_peak = S(0);   ///< its largest absolute value
};

/// A larger tolerance would gain little time, as most steps end at an event.
inline constexpr double loosest_sliding_tolerance = 1e-8;

/// A verdict is confirmed by runs with these, the last one in long double.
inline constexpr std::array tolerances_to_confirm{1e-12, 1e-14, 1e-17};

/// How far a motion is followed after the ground has stopped.
enum class Follow {
    until_decided, ///< the verdict is known
    until_stuck,   ///< the block does not slip any more, or has fallen
    until_rest     ///< the block is at rest, or has fallen
};

/// The largest number of steps of a motion, in addition to one per interval of a record.
inline constexpr int most_sliding_steps = 1 << 18;

/// The tolerance of references in 50 digits: the same order needs few steps.
inline constexpr double sliding_tolerance_in_50_digits = 1e-24;

/// See SlidingMotion. Defined for double, long double and Digits50, under pulses and under records.
template <Number S, class Excitation>
SlidingEnd<S> run_sliding(const Block<S>& block, const S& gyration, const S& friction,
                          const Excitation& excitation, const S& tolerance,
                          Follow follow = Follow::until_stuck);

} // namespace overturn
