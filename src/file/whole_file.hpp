// Result files that are written in one step when everything is computed: complete, or not there.
#pragma once

#include "netcdf.hpp"

#include "overturn/file/study_files.hpp"

namespace overturn {

/// Makes a file of this kind with what `write` puts into it, in place of an older one of the kind.
/// Throws FileError.
void write_whole_file(const std::string& path, FileKind kind, const Job& job,
                      const std::function<void(hid_t file)>& write);

} // namespace overturn
