// Result files that are written in one step when everything is computed: complete, or not there.
#pragma once

#include "netcdf.hpp"

#include "overturn/file/file_error.hpp"

#include <functional>
#include <string>

namespace overturn {

/// What write_whole_file() would refuse, but for a full disk, before anything is computed: a folder
/// that is missing or not writable, a file of another kind in the way. Throws FileError.
void expect_room_for(const std::string& path, const char* kind);

/// Makes a file of this kind (its attribute `kind`) with what `write` puts into it, in place of an
/// older one of the kind. Throws FileError.
void write_whole_file(const std::string& path, const char* kind, const Job& job,
                      const std::function<void(hid_t file)>& write);

} // namespace overturn
