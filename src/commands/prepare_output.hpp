// Prepares the output of a run, on rank 0: examines an existing file and finds its damaged tiles,
// or creates a new file. Signals are checked between tiles and stop it.
#pragma once

#include "overturn/file/sole_writer.hpp"
#include "overturn/job/job.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace overturn {

/// Creates the file of the job, whose lock is that of `writer`, unless it exists. Returns its
/// damaged tiles, which are to be recomputed; nullopt if the file is complete. Throws Error.
std::optional<std::vector<std::int64_t>> prepare_output(const Job& job, const std::string& path,
                                                        const SoleWriter& writer);

} // namespace overturn
