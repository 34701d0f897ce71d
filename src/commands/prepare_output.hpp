// Prepares the output of a run, on rank 0: examines an existing file and finds its damaged tiles,
// or creates a new file. Signals are checked between tiles and stop it.
#pragma once

#include "overturn/file/sole_writer.hpp"
#include "overturn/job/job.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace overturn {

/// The result file before the computation.
struct PreparedOutput {
    bool is_complete;                  ///< nothing is left to compute
    std::vector<std::int64_t> damaged; ///< finished tiles that have to be recomputed
};

/// Creates the file of the job, whose lock is that of `writer`, unless it exists. Throws Error.
PreparedOutput prepare_output(const Job& job, const std::string& path, const SoleWriter& writer);

} // namespace overturn
