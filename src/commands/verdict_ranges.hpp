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

/// Ranges of a verdict that are shown as one interval.
struct VerdictInterval {
    double first; ///< peak ground acceleration over g
    double last;
    double share = 1; ///< of the interval that has the verdict [1]
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

    /// Of two ranges that meet at `pga`, the verdict of the worse one.
    Verdict verdict_at(double pga) const;

    /// The largest acceleration up to `pga` in the ranges of this verdict that begin below it, and
    /// the smallest one from `pga` on in those that end above it; nullopt if the search has none.
    std::optional<double> nearest_below(Verdict verdict, double pga) const;
    std::optional<double> nearest_above(Verdict verdict, double pga) const;

    /// The ranges of a verdict, ascending. Of more than `most`, those that are closest to each
    /// other are joined, but not the one that ends the search.
    std::vector<VerdictInterval> intervals(Verdict verdict, std::size_t most) const;

    /// Such as "1.1110 to 1.6440 g, 34 % of 1.7000 to 1.8000 g, above 2.1300 g, searched up to 5
    /// g"; at most `most` intervals of each kind. They are rounded outwards, and those that touch
    /// then are joined: what is in none of them is safe.
    std::string text(int decimals, std::size_t most = most_shown) const;

    /// At least 4, enough to tell all ends of the shown intervals from the acceleration `pga`, and
    /// up to 7 to tell them from each other.
    int decimals(double pga) const;

    static constexpr std::size_t most_shown = 6;
};

/// The accelerations over g at which the verdicts between `first` and `last` are searched, before
/// the steps between them are halved.
std::vector<double> scanned_accelerations(const Scene& scene, double first, double last);

/// line: amplitudes in units of g. lifting: below it, the block is not lifted; end: of the search,
/// which ends earlier if the vertical motion cancels gravity. included: an acceleration whose
/// verdict the ranges must agree with; under a record, the steps next to it are smaller, 0.1 % up
/// to 2 % away. drop_requested: see boundary_on().
VerdictRanges verdict_ranges(const Scene& scene, const BoundaryLine& line, double lifting,
                             double end, double included, const DropRequested& drop_requested);

} // namespace overturn
