// The ranges of peak ground acceleration in which a block is safe, topples, or is undecided.
#pragma once

#include "overturn/sweep/boundary.hpp"

#include <optional>
#include <string>
#include <vector>

namespace overturn {

/// The largest step of the scan under a record, over the acceleration [1].
inline constexpr double toppling_step = 0.005;

enum class Verdict { safe, topples, undecided };

/// The largest number of this many decimals that is at most the value; the printed number is never
/// above the value.
double rounded_down(double value, int decimals);
inline double rounded_up(double value, int decimals)
{
    return -rounded_down(-value, decimals);
}

/// The verdict of the region of a block at rest after the motion.
Verdict verdict_of(Region region);

struct VerdictRange {
    double first; ///< peak ground acceleration over g
    double last;
    Verdict verdict;
};

struct VerdictRanges {
    /// From 0 to the end of the search, ascending and without gaps. The first one is safe: the
    /// block is not lifted.
    std::vector<VerdictRange> all;
    double lifting = 0;                   ///< the acceleration that lifts the block, over g
    std::optional<CoarseSearch> coarse{}; ///< what was searched in wide steps, if anything was
    bool ends_in_free_fall = false; ///< beyond the search, the vertical motion cancels gravity

    double end_of_search() const { return all.back().last; }

    std::vector<VerdictRange> with(Verdict verdict) const;

    /// The share of the search above the acceleration that lifts the block in which verdicts could
    /// not be settled [1].
    double undecided_share() const;

    /// Such as "1.1110 to 1.6440 g, above 2.1300 g, searched up to 5 g"; at most `most` ranges of
    /// each kind, including the last one. Ranges are rounded outwards, and those that touch then
    /// are joined: what is in none of them is safe.
    std::string text(int decimals, std::size_t most) const;

    /// At least 4, enough to tell all ends of the ranges from the acceleration `pga`, and up to 7
    /// to tell them from each other.
    int decimals(double pga) const;
};

/// The accelerations over g at which the verdicts between `first` and `last` are searched, before
/// the steps between them are halved.
std::vector<double> scanned_accelerations(const Scene& scene, double first, double last);

/// line: amplitudes in units of g. lifting: below it, the block is not lifted; end: of the search,
/// which ends earlier if the vertical motion cancels gravity. included: an acceleration whose
/// verdict the ranges must agree with. drop_requested: see boundary_on().
VerdictRanges verdict_ranges(const Scene& scene, const BoundaryLine& line, double lifting,
                             double end, double included, const DropRequested& drop_requested);

} // namespace overturn
