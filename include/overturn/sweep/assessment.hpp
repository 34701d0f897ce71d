// What becomes of each of many objects, under each motion and in each direction.
#pragma once

#include "overturn/problem/problem.hpp"
#include "overturn/sweep/verdict_ranges.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace overturn {

/// The width to which the ends of toppling ranges are refined, over the acceleration [1].
inline constexpr double width_of_lowest = 1e-4;

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

/// An object under one motion in one direction.
struct ObjectCase {
    std::int64_t object = 0; ///< its first row of the table, from 0
    std::int64_t row = 0;    ///< the row that is computed; of several, the weakest one
    Shape place;             ///< of this row, along the dimensions of the grid
    Point point;             ///< with the asked strength, or 0
    double pga = 0;          ///< the asked peak ground acceleration over g
    double lifting_pga = 0;  ///< see lifting_pga()
    double moving_pga = 0;
    TopplingStrengths strengths{};

    // If a strength is asked for:
    std::optional<Verdict> verdict{};
    double peak = 0;  ///< |theta| / alpha; infinite if it topples, NaN if undecided
    double slide = 0; ///< the largest distance [m]; NaN if it is not known
    // The factors on the strength, the nearest ones to 1, at which it topples; 0 and infinite if
    // none was found. Of a block that does not topple.
    double factor_below = 0;
    double factor_above = std::numeric_limits<double>::infinity();
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
    bool is_fine = false; ///< see StrengthSearch
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

/// What is known of an object under all its motions, in all their directions. Strengths are peak
/// ground accelerations over g.
struct ObjectAnswer {
    std::int64_t object;                 ///< its first row of the table, from 0
    std::int64_t row;                    ///< the weakest one, in the worst case
    Shape place;                         ///< of the worst case, along the dimensions of the grid
    double lifting_pga;                  ///< the lowest one; infinite if none lifts it
    double moving_pga;                   ///< from which on it lifts or slides
    std::optional<double> toppling_pga;  ///< the lowest one that topples it
    std::optional<double> undecided_pga; ///< the lowest one below it that could not be settled
    double end_of_search;                ///< the lowest one
    /// From which on 50 % and 16 % of the motions topple it, or may: order statistics of the lowest
    /// strengths that are not safe. nullopt if that is above the search.
    std::optional<double> median;
    std::optional<double> percentile_16;

    // If a strength is asked for:
    std::optional<Verdict> verdict; ///< the worst one
    double pga = 0;                 ///< the largest one
    /// The factors on the strength, the nearest ones to 1, with which a case topples it that does
    /// not topple it at the asked strength; 0 and infinite if none was found.
    double factor_below = 0;
    double factor_above = std::numeric_limits<double>::infinity();
    std::int64_t toppling = 0; ///< number of cases that topple
    std::int64_t undecided = 0;
    std::int64_t cases = 0;
    double peak = 0;  ///< the largest |theta| / alpha; infinite if it topples, NaN if undecided
    double slide = 0; ///< the largest distance [m]; NaN if it is not known
    bool slides = false;
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
