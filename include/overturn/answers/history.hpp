// The motion of the only point of a job.
#pragma once

#include "overturn/job/job.hpp"
#include "overturn/sweep/history.hpp"

namespace overturn {

/// With at least as many samples as the record. Throws Error if the motion overflows; a spectrum
/// flags such a point instead.
History history_of_only_point(const Job& job, HistoryView view = {});

} // namespace overturn
