// Reads a result file in a child process. HDF5 1.10 crashes on some files that are damaged or
// malicious; then only the child dies, and the parent refuses the file.
#pragma once

#include <functional>
#include <string>

namespace overturn {

/// Calls `read` in a child process, which shares stdout and stderr. Returns exit_code::complete; if
/// `read` throws, the child prints the message, and the exit code of the error is returned. If
/// `is_unwanted` becomes true, the child is killed, and exit_code::stopped is returned.
/// Throws FileError if the child crashes, or exceeds its processor time: one minute, and another
/// per GB of the file. Its memory is limited to 512 MiB plus twice the size of the file.
/// Must not be called between MPI_Init and MPI_Finalize, where a fork is not safe.
int run_in_child(
    const std::string& path, const std::function<void()>& read,
    const std::function<bool()>& is_unwanted = [] { return false; });

} // namespace overturn
