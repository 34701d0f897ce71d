// Result files that are sound HDF5 and yet not what overturn writes. Bytes altered at random are
// mostly noticed by HDF5; these get past it, to our own checks.
#pragma once

#include "overturn/job/job.hpp"

#include <string>
#include <string_view>

namespace overturn {

/// A spectrum of 2 x 2 points; what such a file is examined for.
Job job_to_alter();

/// Writes its result file to `path`, and alters it as the recipe says: any bytes are one.
/// Attributes, datasets and links are replaced by others of any type, shape and storage, also
/// outside of the file: in `elsewhere`.
void write_altered_result_file(const std::string& path, std::string_view recipe,
                               const std::string& elsewhere);

} // namespace overturn
