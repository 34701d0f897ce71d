// The result file of a command, before the computation.
#pragma once

#include "commands.hpp"

#include "overturn/file/output_lock.hpp"
#include "overturn/file/stored_result.hpp"
#include "overturn/job/job.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace overturn {

/// The result file of a run.
std::string output_path(const RunOptions& options);

/// Throws Error if the job has fewer tiles than parts.
void expect_divisible(const Job& job, const std::optional<JobPart>& part);

/// Creates the file of the job, or of a part of it, unless it exists. Returns the numbers of its
/// damaged tiles; nullopt if it is complete. lock: of the file. Throws Error.
std::optional<std::vector<std::int64_t>> prepare_output(const Job& job,
                                                        const std::optional<JobPart>& part,
                                                        const std::string& path,
                                                        const OutputLock& lock);

/// Throws Error if a history or an accuracy study cannot be written to the path. lock: of the file.
void expect_study_output(const std::string& path, FileKind kind, const OutputLock& lock);

} // namespace overturn
