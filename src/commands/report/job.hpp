// What a job contains, for people.
#pragma once

#include "overturn/job/job.hpp"

namespace overturn {

/// Prints everything about the motion and the blocks.
void print_job(const Job& job);

} // namespace overturn
