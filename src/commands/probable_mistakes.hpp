// Warnings of values and columns that are allowed, but probably not what was meant.
#pragma once

#include "overturn/job/job.hpp"

namespace overturn {

/// Prints to stderr what looks like a mistake in the units, and misspelt columns of a table.
void warn_of_probable_mistakes(const Job& job);

} // namespace overturn
