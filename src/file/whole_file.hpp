// Result files that are written as a whole at the end of the computation: complete, or absent.
#pragma once

#include "netcdf.hpp"

#include "overturn/file/study_files.hpp"

namespace overturn {

/// Creates a file of this kind with the content that `write` adds; replaces an existing file of the
/// same kind. Throws Error.
void write_whole_file(const std::string& path, FileKind kind, const Job& job,
                      const std::function<void(hid_t file)>& write);

} // namespace overturn
