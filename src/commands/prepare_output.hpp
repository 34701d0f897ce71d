// The result file of a command, before the computation.
#pragma once

#include "commands.hpp"

#include "overturn/file/sole_writer.hpp"
#include "overturn/file/stored_result.hpp"
#include "overturn/job/job.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace overturn {

/// The result file of a run.
std::string output_path(const RunOptions& options);

/// Creates the file of the job, whose lock is that of `writer`, unless it exists. Returns the
/// numbers of its damaged tiles; nullopt if it is complete. Throws Error.
std::optional<std::vector<std::int64_t>> prepare_output(const Job& job, const std::string& path,
                                                        const SoleWriter& writer);

/// Throws Error if a history or an accuracy study cannot be written to the path, whose lock is that
/// of `writer`.
void expect_study_output(const std::string& path, FileKind kind, const SoleWriter& writer);

} // namespace overturn
