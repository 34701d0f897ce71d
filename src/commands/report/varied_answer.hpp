// The answer of `overturn topple --vary`, as text.
#pragma once

#include "commands/commands.hpp"

#include "overturn/job/job.hpp"
#include "overturn/sweep/verdict_ranges.hpp"

#include <string>
#include <vector>

namespace overturn {

/// A direction that is computed, and the ranges of the varied quantity in it.
struct DirectedRanges {
    Job job;
    double direction; ///< [degree]
    VerdictRanges ranges;
};

/// The step of the search for ranges, before steps are halved.
double step_of_search(const Scene& scene, const VariedQuantity& vary);

/// The worst verdict of all directions at each value.
VerdictRanges worst_of(const std::vector<DirectedRanges>& all);

/// From which value on, and up to which, nothing topples, such as "from width = 0.5987 m on, up to
/// 1.2 m, nothing topples at 0.9 g". Values are rounded so that they are safe.
std::string sentence_of(const VerdictRanges& ranges, const ToppleOptions& options);

void print_varied(const std::vector<DirectedRanges>& all, const ToppleOptions& options);

} // namespace overturn
