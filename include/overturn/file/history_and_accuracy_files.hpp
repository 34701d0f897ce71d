// The result files of `overturn history` and `overturn accuracy`: HDF5 that is also valid netCDF-4,
// written as a whole at the end of the computation.
#pragma once

#include "overturn/file/stored_result.hpp"
#include "overturn/job/job.hpp"
#include "overturn/sweep/accuracy.hpp"
#include "overturn/sweep/history.hpp"

#include <string>
#include <vector>

namespace overturn {

/// Throws Error if a file of this kind cannot be written: the folder is missing or not
/// writable, or a file of another kind has the name. To be called before the computation.
void expect_room_for(const std::string& path, FileKind kind);

/// Replaces an existing history. Variables have the dimension `sample` or `event`; the job has a
/// single point. Throws Error, also if the path exists and is not a history.
void write_history_file(const std::string& path, const Job& job, const History& history);

/// Replaces an existing accuracy study. Variables have the dimension `setting` (a method at a
/// tolerance), and quantile, region or distance. Throws Error, also if the path exists and is
/// not an accuracy study.
void write_accuracy_file(const std::string& path, const Job& job, const AccuracySample& sample,
                         const std::vector<AccuracyRow>& rows);

} // namespace overturn
