// Whether one block topples under one motion in one direction, and at which peak accelerations.
#pragma once

#include "overturn/problem/problem.hpp"
#include "overturn/sweep/verdict_ranges.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace overturn {

struct RestitutionAnswer {
    double share; ///< r / r_max; NaN if there is no r_max
    double ratio; ///< r
    VerdictRanges ranges;
};

/// What is asked of a problem with a single point.
struct ToppleQuestion {
    bool has_strength;              ///< whether the strength of the point is asked for
    std::optional<double> pga;      ///< its peak acceleration over g, if that is given [1]
    double pga_max;                 ///< the end of the search, unless the strength is larger [1]
    bool searches = true;           ///< for ranges; otherwise only the verdict at the strength
    bool other_restitutions = true; ///< for ranges of others than the requested one as well
    int threads = 1;
    /// Called again and again in the thread of the caller, with the numbers of restitutions that
    /// are computed, and of all.
    std::function<void(std::size_t done, std::size_t all)> progress = nullptr;
};

/// What becomes of a block that may slip.
struct SlipAnswer {
    double friction = 0;     ///< between block and base
    bool stays_flat = false; ///< it slides before it could lift
    double moving_pga = 0;   ///< from which on it slides or lifts, over g
    /// If a strength is asked for: of the base over R of the side plus; NaN if undecided.
    double slide = 0;
    double slide_peak = 0;
    std::optional<Verdict> without; ///< the verdict of the block that cannot slip
};

struct ToppleAnswer {
    double direction = 0;                  ///< of the motion [degree]
    std::optional<Verdict> verdict;        ///< nullopt if no strength is asked for
    double peak = 0;                       ///< |theta| / alpha
    std::optional<double> friction_demand; ///< see the field; nullopt in the linear theory
    /// For each toppling range of the requested restitution: the largest friction from uplift to
    /// its lower end, where the verdict is not undecided, NaN if one is unknown; empty in the
    /// linear theory.
    std::vector<double> friction_to_topple;
    std::optional<SlipAnswer> slip; ///< with a friction coefficient
    double pga = 0;                 ///< of the point
    double unit = 0;                ///< of the strength 1: of the record that is not scaled
    double lifting_pga = 0;
    std::vector<RestitutionAnswer>
        by_restitution; ///< the requested one first; without a search only it

    const RestitutionAnswer& requested() const { return by_restitution.front(); }
};

/// The point of a problem that has a single one.
Point only_point_of(const Problem& problem);

/// alpha of the block of that point [rad]; nullopt if it has two sides.
std::optional<double> only_slenderness_of(const Problem& problem);

/// The values of a field of type double at all points, row by row, as accurate as possible.
std::vector<double> accurate_values(Problem problem, Field field, int threads = 1);

/// The verdict of a block with this value of the field `peak`.
Verdict verdict_of_peak(double peak);

/// The directions of the motion that are computed [degree]: the given one. Without it the motion as
/// it stands and, if the sides of a block differ, its mirror image, because either may be worse.
std::vector<double> directions_of(const Problem& problem);

/// The motion must not be 0 in this direction.
ToppleAnswer answer_of(const Problem& problem, const ToppleQuestion& question);

/// The ranges of a quantity of the block, or of its loss at impacts, between two values, in which
/// the block of the first point of a problem topples under the motion of this point. The value of
/// the quantity there, if there is one, is not used; all values between the two must be allowed.
VerdictRanges ranges_along(const Problem& problem, const Quantity& quantity, double first,
                           double last);

/// Whether the answer for one direction of a motion is worse than that for another one: the block
/// topples, or may topple; or it topples closer to the asked strength; without one, at less.
bool is_worse(const ToppleAnswer& one, const ToppleAnswer& other);

/// The share of the restitutions' searches in which verdicts are undecided, the largest one [1].
double undecided_share(const ToppleAnswer& answer);

} // namespace overturn
