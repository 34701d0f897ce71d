// What happens to the output before a run computes: rank 0 looks what stands there, makes the file,
// and finds tiles that are not as they were written. A signal to stop ends it at any time.
#pragma once

#include "commands.hpp"

#include "overturn/job/job.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace overturn {

inline constexpr int go_on = -1; ///< there is something to compute; no exit code

struct Prepared {
    int verdict = go_on;               ///< or the exit code, if there is nothing left to do
    std::vector<std::int64_t> damaged; ///< tiles to be computed again
};

/// The options' job, or the one of its boundary. Throws JobError.
Job read_job_of(const RunOptions& options);

/// Makes sure that a file for the job stands at the path, and that what is marked as done in it can
/// be trusted. Throws FileError.
Prepared prepare_output(const Job& job, const RunOptions& options, const std::string& path);

/// Makes the file, and computes nothing; returns the exit code. For a process of its own, that of a
/// run which holds the lock on the file, or of tools/join_spectra.
int make_output(const RunOptions& options);

} // namespace overturn
