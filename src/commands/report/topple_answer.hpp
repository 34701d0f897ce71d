// The answer of `overturn topple`, as text.
#pragma once

#include "commands/commands.hpp"

#include "overturn/job/job.hpp"
#include "overturn/sweep/history.hpp"
#include "overturn/sweep/toppling.hpp"

#include <optional>
#include <string>
#include <vector>

namespace overturn {

/// A direction that is computed, and the answer for it.
struct DirectedAnswer {
    Job job;
    std::optional<History> history; ///< if the options ask for it
    ToppleAnswer answer;
};

/// The rows on the block and its motion. directions: how many of these are computed.
void print_block_and_motion(const Job& job, const ToppleOptions& options, std::size_t directions);

/// The sentences of the verdict for every direction; none if no strength is asked for.
std::vector<std::string> verdict_sentences(const std::vector<DirectedAnswer>& all,
                                           const ToppleOptions& options);

void print_answer(const std::vector<DirectedAnswer>& all, const ToppleOptions& options);

} // namespace overturn
