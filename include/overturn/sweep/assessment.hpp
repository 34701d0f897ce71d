// What becomes of each of many objects, under each motion and in each direction.
#pragma once

#include "overturn/problem/problem.hpp"
#include "overturn/sweep/verdict_ranges.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace overturn {

/// The width to which the lowest toppling acceleration is refined, over the acceleration [1].
inline constexpr double width_of_lowest = 1e-4;

/// The lowest peak ground acceleration over g at which a block topples, searched upwards in steps
/// of at most `toppling_step`: ranges narrower than the steps may be missed.
struct LowestToppling {
    std::optional<double> pga;       ///< at most `width_of_lowest` below it, the block is safe
    std::optional<double> undecided; ///< the lowest one below it that could not be settled
    double end = 0;                  ///< of the search, if none topples
};

/// lifting: below it, the block is not lifted. included: a further acceleration of the search.
LowestToppling lowest_toppling(const Scene& scene, const BoundaryLine& line, double lifting,
                               double end, double included, const DropRequested& drop_requested);

/// An object under one motion in one direction.
struct ObjectCase {
    std::int64_t object = 0; ///< the row of the table, from 0
    Point point;             ///< with the asked strength, or 0
    double pga = 0;          ///< the asked peak ground acceleration over g
    double size = 0;         ///< R of the side plus [m]; NaN if it is not known
    double lifting_pga = 0;  ///< see lifting_pga()
    double moving_pga = 0;
    LowestToppling lowest{};

    // If a strength is asked for:
    std::optional<Verdict> verdict{};
    double peak = 0;       ///< |theta| / alpha, see the field
    double slide_peak = 0; ///< over R, of a block with friction
};

struct AssessmentQuestion {
    bool has_strength; ///< whether the strength of the points is asked for
    double pga_max;    ///< the end of the search, unless the strength is larger [1]
    int threads = 1;
    /// Called again and again in the thread of the caller.
    std::function<void(std::size_t done, std::size_t all)> progress = nullptr;
};

/// The cases of a problem whose blocks are the rows of a table, row by row. Of a block whose sides
/// are equal, a motion and its mirror image are one case. The verdicts are those of answer_of().
std::vector<ObjectCase> cases_of(const Problem& problem, const AssessmentQuestion& question);

/// What is known of an object under all its motions, in all their directions. Strengths are peak
/// ground accelerations over g.
struct ObjectAnswer {
    std::int64_t object;                 ///< the row of the table, from 0
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
    /// The factor on the strength with which another case topples it, the smallest one found;
    /// infinite if there is none.
    double nearest_factor = std::numeric_limits<double>::infinity();
    bool topples_below = false; ///< in a case that does not topple at the asked strength
    std::int64_t toppling = 0;  ///< number of cases that topple
    std::int64_t undecided = 0;
    std::int64_t cases = 0;
    double peak = 0;  ///< the largest |theta| / alpha; infinite if it topples, NaN if undecided
    double slide = 0; ///< the largest distance [m]; NaN if it is not known
    bool slides = false;
};

/// The answers for all objects, the most vulnerable first: those that topple, that may topple, and
/// that stand; then by the lowest strength that is not safe, and by that which moves them.
std::vector<ObjectAnswer> answers_of(const std::vector<ObjectCase>& cases);

} // namespace overturn
