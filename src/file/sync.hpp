// What the system has of a file, on the disk: it outlasts a loss of power then.
#pragma once

#include <string>

namespace overturn {

/// Waits until the file or folder is on the disk. False, with errno, if that failed. Also brings
/// there what other processes of this machine have written into the file.
bool sync(const std::string& path);

} // namespace overturn
