// Result files that are valid HDF5 but not as written by overturn. HDF5 detects most bytes altered
// at random; these files pass it and reach overturn's own checks.
#pragma once

#include "overturn/job/job.hpp"

#include <string>
#include <string_view>

namespace overturn {

/// A spectrum of 2 x 2 points, the job with which such files are examined.
Job job_to_alter();

/// Writes its result file to `path` and alters it by the recipe, which may be any bytes.
/// Attributes, datasets and links are replaced by others of any type, shape and storage, also
/// outside of the file: in `elsewhere`.
void write_altered_result_file(const std::string& path, std::string_view recipe,
                               const std::string& elsewhere);

} // namespace overturn
