// Files on the disk, and the messages of the operating system as part of our sentences.
#pragma once

#include <string>

namespace overturn {

/// Waits until the file or folder is on the disk, where it outlasts a loss of power. False, with
/// errno, if that failed. Also brings there what other processes of this machine have written into
/// the file.
bool sync(const std::string& path);

/// "No space left" becomes "no space left"; "MPI_ERR" stays.
std::string in_sentence(std::string message);

/// What an error number of the system means, as in "no space left on device".
std::string system_reason(int error_number);

} // namespace overturn
