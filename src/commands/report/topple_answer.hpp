// The answer of `overturn topple`, as text.
#pragma once

#include "commands/commands.hpp"

#include "overturn/answers/topple.hpp"

#include <vector>

namespace overturn {

/// The rows on the block and its motion. directions: how many of these are computed.
void print_block_and_motion(const Job& job, const ToppleOptions& options, std::size_t directions);

void print_answer(const std::vector<DirectedAnswer>& all, const ToppleOptions& options);

void print_varied(const std::vector<DirectedRanges>& all, const ToppleOptions& options);

} // namespace overturn
