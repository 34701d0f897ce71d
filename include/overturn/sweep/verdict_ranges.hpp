// The ranges of peak ground acceleration, or of another quantity, in which a block is safe,
// topples, or is undecided.
#pragma once

#include "overturn/sweep/boundary.hpp"
#include "overturn/text/names.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace overturn {

/// The largest step of the scan under a record, over the acceleration [1].
inline constexpr double toppling_step = 0.005;

/// The width to which the ends of toppling ranges are refined, over the acceleration [1].
inline constexpr double width_of_lowest = 1e-4;

/// From the best one to the worst.
enum class Verdict { safe, undecided, topples };

template <>
inline constexpr std::array<std::string_view, 3> names_of<Verdict>{"safe", "undecided", "topples"};

/// The verdict of the region of a block at rest after the motion.
Verdict verdict_of(Region region);

struct VerdictRange {
    double first; ///< peak ground acceleration over g, or value of another quantity
    double last;
    Verdict verdict;
};

struct VerdictRanges {
    /// To the end of the search, ascending and without gaps; empty without a search. Those of an
    /// acceleration begin at 0, and the first one is safe: the block is not lifted.
    std::vector<VerdictRange> all{};
    double begin_of_search = 0;           ///< of an acceleration: that which lifts the block
    std::optional<CoarseSearch> coarse{}; ///< what was searched in wide steps, if anything was
    bool ends_in_free_fall = false; ///< beyond the search, the vertical motion cancels gravity

    bool are_searched() const { return !all.empty(); }
    double end_of_search() const { return all.back().last; }

    std::vector<VerdictRange> with(Verdict verdict) const;

    /// The share of the search in which verdicts could not be settled [1].
    double undecided_share() const;

    /// Of two ranges that meet at the value, the verdict of the worse one.
    Verdict verdict_at(double value) const;

    /// The largest value up to this one in the ranges of this verdict that begin below it, and the
    /// smallest one from this one on in those that end above it; nullopt if the search has none.
    std::optional<double> nearest_below(Verdict verdict, double value) const;
    std::optional<double> nearest_above(Verdict verdict, double value) const;

    /// The least value from which on, and the largest one up to which, all verdicts are safe;
    /// nullopt if that at the end, or at the beginning, is not.
    std::optional<double> safe_from() const;
    std::optional<double> safe_up_to() const;
};

/// The accelerations over g, ascending, at which the verdicts between `first` and `last` are
/// searched, before the steps between them are halved. With `included`, if it is between them;
/// under a record, the steps next to it are smaller, 0.1 % up to 10 % away.
std::vector<double> scanned_accelerations(const Scene& scene, double first, double last,
                                          double included = 0);

/// line: amplitudes in units of g. lifting: below it, the block is not lifted; end: of the search,
/// which ends earlier if the vertical motion cancels gravity. included: an acceleration whose
/// verdict the ranges must agree with, see scanned_accelerations(). drop_requested: see
/// boundary_on().
VerdictRanges verdict_ranges(const Scene& scene, const BoundaryLine& line, double lifting,
                             double end, double included,
                             const DropRequested& drop_requested = nullptr);

/// Along another quantity, between two values. The steps are those of boundary_on().
VerdictRanges verdict_ranges(const Scene& scene, const QuantityLine& line, double first,
                             double last);

/// The worst verdict at each value of ranges of one quantity that were searched from the same first
/// to the same last value.
VerdictRanges worst_of(const std::vector<VerdictRanges>& each);

} // namespace overturn
