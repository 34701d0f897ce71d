// Whether one block topples under one motion, and at which strengths, or at which values of another
// quantity: from a request, through a job, to sentences and JSON. Everything is computed as by
// `run`, `boundary` and `history`.
#pragma once

#include "overturn/answers/motion_request.hpp"
#include "overturn/job/job.hpp"
#include "overturn/problem/quantity.hpp"
#include "overturn/sweep/history.hpp"
#include "overturn/sweep/toppling.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace overturn {

/// A quantity whose values between two ends are searched, instead of those of the strength.
struct VariedQuantity {
    const Quantity* quantity;
    double first;
    double last;
};

/// A block, a motion, and what is asked for.
struct ToppleRequest : MotionRequest {
    std::map<std::string, double> block; ///< quantities of the block, by name
    std::optional<double> direction;     ///< [degree]
    std::optional<double> period;        ///< of the pulse [s]
    std::string record;                  ///< path; empty: a pulse
    std::optional<double> restitution;
    std::optional<double> velocity_restitution;   ///< its root
    std::optional<double> restitution_of_maximum; ///< default, without the others: 1
    bool without_search = false;                  ///< only the verdict at the asked strength
    bool other_restitutions = true;               ///< whether ranges of others are searched, too
    bool with_history = false;                    ///< at the asked strength
    std::optional<VariedQuantity> vary;
};

/// The job of each direction that is computed, with a single point, or with values of the varied
/// quantity. If no strength is asked for, its motion is 0. axes: overrides that give keys of
/// [plane] several values instead. Throws Error.
std::vector<Job> jobs_of(const ToppleRequest& request, const std::vector<std::string>& axes = {});

/// A direction that is computed, and the answer for it.
struct DirectedAnswer {
    Job job;
    std::optional<History> history; ///< if the request asks for it
    ToppleAnswer answer;
};

/// The answers for all directions, the worst one first. Throws Error if the motion is 0 in a
/// direction. progress: called again and again, with the numbers of restitutions that are computed,
/// and of all.
std::vector<DirectedAnswer>
answers_for(std::vector<Job> jobs, const ToppleRequest& request, int threads,
            const std::function<void(std::size_t done, std::size_t all)>& progress);

/// The sentences of the verdict for every direction; none if no strength is asked for.
std::vector<std::string> verdict_sentences(const std::vector<DirectedAnswer>& all,
                                           const ToppleRequest& request);

/// A direction that is computed, and the ranges of the varied quantity in it.
struct DirectedRanges {
    Job job;
    double direction; ///< [degree]
    VerdictRanges ranges;
};

/// The ranges of the varied quantity for all directions. Throws Error if the motion is 0 in one.
std::vector<DirectedRanges> ranges_for(const std::vector<Job>& jobs, const ToppleRequest& request);

/// The step of the search for ranges, before steps are halved.
double step_of_search(const Scene& scene, const VariedQuantity& vary);

/// The worst verdict of all directions at each value.
VerdictRanges worst_of(const std::vector<DirectedRanges>& all);

/// From which value on, and up to which, nothing topples, such as "from width = 0.5987 m on, up to
/// 1.2 m, nothing topples at 0.9 g". Values are rounded so that they are safe.
std::string sentence_of(const VerdictRanges& ranges, const ToppleRequest& request);

/// Such as " m"; empty without units.
std::string unit_of(const Quantity& quantity);

/// JSON for programs: the answer for the worst direction, and the answers for all. Numbers that are
/// not finite are null.
std::string json_of(const std::vector<DirectedAnswer>& all, const ToppleRequest& request);

/// The same with a varied quantity: the worst verdicts of all directions, and those of each.
std::string json_of(const std::vector<DirectedRanges>& all, const ToppleRequest& request);

} // namespace overturn
