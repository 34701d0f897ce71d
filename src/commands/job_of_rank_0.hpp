// The job of a run on all of its ranks.
#pragma once

#include "overturn/farm/mpi_session.hpp"
#include "overturn/job/job.hpp"

#include <optional>

namespace overturn {

/// The job that rank 0 has read, with its records and blocks, on all ranks: only rank 0 reads
/// files. read: the job on rank 0. Collective.
Job job_of_rank_0(const MpiSession& session, std::optional<Job> read, bool is_boundary);

} // namespace overturn
