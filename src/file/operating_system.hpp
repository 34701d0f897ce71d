// Syncing of files to the disk, and error messages of the operating system.
#pragma once

#include <string>

namespace overturn {

/// Syncs a file or folder to the disk, so that it survives a power failure, including what other
/// processes of this machine have written to it. Returns false, with errno, on failure.
bool sync(const std::string& path);

/// A message as part of a sentence: "No space left" becomes "no space left"; "MPI_ERR" is kept.
std::string in_sentence(std::string message);

/// The message of a system error number, such as "no space left on device".
std::string system_reason(int error_number);

} // namespace overturn
