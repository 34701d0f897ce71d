// Reading a result file in a process of its own. HDF5 1.10 crashes on some files that are damaged,
// or made for that, and takes its process with it: here a child dies, and the parent refuses the
// file.
#pragma once

#include <functional>
#include <string>

namespace overturn {

/// Calls `read` in a child process, which prints as this one would. Returns exit_code::complete, or
/// the exit code of what `read` throws, after the child has complained. If `is_unwanted` becomes
/// true meanwhile, the child is killed, and the result is exit_code::stopped.
/// Throws FileError if the child crashes, or takes a minute of processor time and another one per
/// GB of the file; its memory is limited to 512 MiB and twice the size of the file.
/// Not between MPI_Init and MPI_Finalize, where a fork is not safe.
int run_in_child(
    const std::string& path, const std::function<void()>& read,
    const std::function<bool()>& is_unwanted = [] { return false; });

} // namespace overturn
