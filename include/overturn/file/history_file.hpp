// The result of `overturn history`: HDF5 that is valid netCDF-4 as well.
#pragma once

#include "overturn/file/file_error.hpp"
#include "overturn/job/job.hpp"
#include "overturn/sweep/history.hpp"

#include <string>

namespace overturn {

/// Writes a file in one step, over an older history if there is one. Variables have the dimension
/// `sample` or `event`; the job is that of the one point. Throws FileError; also where something
/// else than a history stands in the way.
void write_history_file(const std::string& path, const Job& job, const History& history);

/// What write_history_file() would refuse, but for a full disk, before anything is computed. Throws
/// FileError.
void expect_room_for_history_file(const std::string& path);

} // namespace overturn
