// The bytes of a job file.
#pragma once

#include <string>

namespace overturn {

/// The whole file. Throws JobError if it cannot be read or is larger than a job can be.
std::string file_text(const std::string& path);

} // namespace overturn
