// The motion of the only point of a job, as text.
#pragma once

#include "overturn/job/job.hpp"
#include "overturn/sweep/history.hpp"

namespace overturn {

/// Prints the outcome and the first events.
void print_history(const Job& job, const History& history);

} // namespace overturn
