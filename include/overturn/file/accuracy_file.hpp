// The result of `overturn accuracy`: HDF5 that is valid netCDF-4 as well.
#pragma once

#include "overturn/file/file_error.hpp"
#include "overturn/job/job.hpp"
#include "overturn/sweep/accuracy.hpp"

#include <string>
#include <vector>

namespace overturn {

/// Writes a file in one step, over an older accuracy file if there is one. Variables have the
/// dimension setting (a method at a tolerance), and quantile, region or distance. Throws FileError;
/// also where something else than an accuracy file stands in the way.
void write_accuracy_file(const std::string& path, const Job& job, const AccuracySample& sample,
                         const std::vector<AccuracyRow>& rows);

/// What write_accuracy_file() would refuse, but for a full disk, before anything is computed: a
/// folder that is missing or not writable, another file in the way. Throws FileError.
void expect_room_for_accuracy_file(const std::string& path);

} // namespace overturn
