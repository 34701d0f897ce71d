// What happens to the output before a run computes: rank 0 examines what is there, makes the file,
// and finds tiles that are not as they were written. A signal to stop ends it at any time.
#pragma once

#include "overturn/job/job.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace overturn {

/// Whether a file at the path, which may crash HDF5, is safe to open and belongs to the job:
/// exit_code::complete, or another one after a message. Throws FileError and Stopped. To be called
/// before MPI_Init.
int examine_in_child(const Job& job, const std::string& path);

/// Makes sure that a file for the job exists at the path. Returns its damaged tiles, which are to
/// be computed again; nothing if it is complete. Throws FileError and Stopped.
std::optional<std::vector<std::int64_t>> prepare_output(const Job& job, const std::string& path);

} // namespace overturn
