// The answer of `overturn topple`, as text.
#pragma once

#include "commands/commands.hpp"

#include "overturn/answers/topple.hpp"

#include <vector>

namespace overturn {

void print_answer(const std::vector<DirectedAnswer>& all, const ToppleOptions& options);

void print_varied(const std::vector<DirectedRanges>& all, const ToppleOptions& options);

} // namespace overturn
