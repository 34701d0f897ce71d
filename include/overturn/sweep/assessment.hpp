// What becomes of each of many objects, under each motion and in each direction.
#pragma once

#include "overturn/problem/problem.hpp"
#include "overturn/sweep/verdict_ranges.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace overturn {

/// An object under one motion in one direction, or the worst of several such cases. Strengths are
/// peak ground accelerations over g.
struct ObjectCase {
    std::int64_t object;    ///< its first row of the table, from 0
    std::int64_t row;       ///< the row that is computed; of several, the weakest one
    Shape place;            ///< of this row in the worst case, along the dimensions of the grid
    double lifting_pga = 0; ///< see lifting_pga(); infinite if none lifts it
    double moving_pga = 0;  ///< from which on it lifts or slides
    std::optional<double> toppling_pga{};  ///< the lowest one that topples it
    std::optional<double> undecided_pga{}; ///< the lowest one below it that could not be settled
    double end_of_search = 0;

    // If a strength is asked for:
    std::optional<Verdict> verdict{};
    double pga = 0; ///< the asked one
    /// The factors on the strength, the nearest ones to 1, at which an object topples that stands
    /// at the asked one; 0 and infinite if none was found.
    double factor_below = 0;
    double factor_above = infinity;
    double peak = 0;  ///< |theta| / alpha; infinite if it topples, NaN if undecided
    double slide = 0; ///< the largest distance [m]; NaN if it is not known

    bool slides() const { return slide != 0; }
};

/// What a row of the table is a part of.
struct PartOfObject {
    std::int64_t object; ///< its first row, from 0
    std::int64_t sample; ///< equal in rows that are azimuths of one object
    auto operator<=>(const PartOfObject&) const = default;
};

struct AssessmentQuestion {
    bool has_strength;    ///< whether the strength of the points is asked for
    double pga_max;       ///< the end of the search, unless the strength is larger [1]
    bool is_fine = false; ///< whether strengths are searched as by verdict_ranges()
    /// Of each row; empty: each is an object. The rows of one object are its azimuths: under a
    /// motion, it topples if it topples in one of them. Samples are different cases.
    std::span<const PartOfObject> parts{};
    int threads = 1;
    /// Called again and again in the thread of the caller.
    std::function<void(std::size_t done, std::size_t all)> progress = nullptr;
};

/// The cases of a problem whose blocks are the rows of a table, object by object. Of a block whose
/// sides are equal, a motion and its mirror image are one case, unless it is a part of an object.
/// The verdicts are those of answer_of().
std::vector<ObjectCase> cases_of(const Problem& problem, const AssessmentQuestion& question);

/// What is known of an object under all its motions, in all their directions.
struct ObjectAnswer : ObjectCase {
    /// From which on 50 % and 16 % of the motions topple it, or may: order statistics of the lowest
    /// strengths that are not safe. nullopt if that is above the search.
    std::optional<double> median{};
    std::optional<double> percentile_16{};
    std::int64_t toppling = 0; ///< number of cases that topple at the asked strength
    std::int64_t undecided = 0;
    std::int64_t cases = 0;
};

/// The answers for all objects, the most vulnerable first: those that topple, that may topple, and
/// that stand; then by the lowest strength that is not safe, and by that which moves them.
std::vector<ObjectAnswer> answers_of(const std::vector<ObjectCase>& cases);

/// The widths from which on an object stands at the asked strength.
struct LeastWidths {
    std::int64_t object; ///< the row of the table, from 0
    double width;        ///< its own [m]
    double end;          ///< of the search, which begins with this width [m]
    /// Of the cases, ascending: the width from which on each is safe, infinite if it is not at the
    /// end. From the last one on, all are [m].
    std::vector<double> safe_from;
};

/// The range above a least width that is searched again, in as many steps as all, over the width.
inline constexpr double range_of_finer_search = 0.1;

/// Of the object of these cases; nullopt if the table does not have its width. Height, offsets and
/// friction stay, and so does the share of r_max, if that is given instead of r. The search is that
/// of ranges_along(), up to three times the width, if such a block is possible, and then in
/// finer steps above each width that is found, until nothing topples there.
std::optional<LeastWidths> least_widths_of(const Problem& problem,
                                           std::span<const ObjectCase> cases, int threads);

} // namespace overturn
