// The strengths of a motion at which a block topples, as far as an assessment needs them.
#pragma once

#include "overturn/sweep/verdict_ranges.hpp"

#include <optional>

namespace overturn {

/// The peak ground accelerations over g at which a block topples, as far as they were searched.
struct TopplingStrengths {
    std::optional<double> lowest{};
    std::optional<double> undecided{}; ///< the lowest one below it that could not be settled
    double end = 0;                    ///< of the search
    // Of a block that does not topple at the asked strength, the nearest ones:
    std::optional<double> below{};
    std::optional<double> above{};
};

/// How the strengths of a line are searched.
struct StrengthSearch {
    double lifting;        ///< below it, the block is not lifted
    double end;            ///< ends earlier if the vertical motion cancels gravity
    double asked = 0;      ///< a further acceleration of the search; 0 if none is asked for
    bool topples_at_asked; ///< the verdict there, if one is asked for
    bool is_fine = false;  ///< as verdict_ranges(), instead of in steps of at most `toppling_step`
};

/// In steps, ranges that are narrower may be missed. The ends of ranges are refined: at most
/// `width_of_lowest` away, the block does not topple.
TopplingStrengths toppling_strengths(const Scene& scene, const BoundaryLine& line,
                                     const StrengthSearch& search);

} // namespace overturn
