// Prepares the output of a run, on rank 0: examines an existing file and finds its damaged tiles,
// or creates a new file. Signals are checked between tiles and stop it.
#pragma once

#include "overturn/job/job.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace overturn {

/// Examines the file at the path in a child process, because HDF5 may crash on it. Returns
/// exit_code::complete if it is absent or belongs to the job, else another code after printing a
/// message. Throws FileError and Stopped. To be called before MPI_Init.
int examine_in_child(const Job& job, const std::string& path);

/// Creates the file of the job unless it exists. Returns its damaged tiles, which are to be
/// recomputed; nullopt if the file is complete. Throws FileError and Stopped.
std::optional<std::vector<std::int64_t>> prepare_output(const Job& job, const std::string& path);

} // namespace overturn
