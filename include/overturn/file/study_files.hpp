// The results of `overturn history` and `overturn accuracy`: HDF5 that is valid netCDF-4 as well,
// written in one step when everything is computed.
#pragma once

#include "overturn/file/spectrum_summary.hpp"
#include "overturn/job/job.hpp"
#include "overturn/sweep/accuracy.hpp"
#include "overturn/sweep/history.hpp"

#include <string>
#include <vector>

namespace overturn {

/// What the writer of this kind would refuse, but for a full disk, before anything is computed: a
/// folder that is missing or not writable, a file of another kind in the way. Throws FileError.
void expect_room_for(const std::string& path, FileKind kind);

/// Writes over an older history if there is one. Variables have the dimension `sample` or `event`;
/// the job is that of the one point. Throws FileError; also where something else than a history
/// stands in the way.
void write_history_file(const std::string& path, const Job& job, const History& history);

/// Writes over an older accuracy file if there is one. Variables have the dimension setting (a
/// method at a tolerance), and quantile, region or distance. Throws FileError; also where something
/// else than an accuracy file stands in the way.
void write_accuracy_file(const std::string& path, const Job& job, const AccuracySample& sample,
                         const std::vector<AccuracyRow>& rows);

} // namespace overturn
