// JSON for programs. Numbers that are not finite are null.
#pragma once

#include "topple_answer.hpp"
#include "varied_answer.hpp"

#include "overturn/farm/farm.hpp"
#include "overturn/sweep/kernel.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace overturn {

/// The answer of `overturn topple` for the worst direction, and the answers for all.
std::string json_of(const std::vector<DirectedAnswer>& all, const ToppleOptions& options);

/// The answer of `overturn topple --vary`: the worst verdicts of all directions, and those of each.
std::string json_of(const std::vector<DirectedRanges>& all, const ToppleOptions& options);

/// The sidecar of a result file: what varies from run to run. hosts: of the ranks. seconds: of the
/// run. Begins with `sidecar_beginning`.
std::string sidecar_of(const FarmReport& report, const std::vector<std::string>& hosts,
                       Kernel kernel, std::chrono::system_clock::time_point start, double seconds);

} // namespace overturn
