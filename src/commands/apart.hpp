// Reading a result file in a process of its own. HDF5 1.10 crashes on some files that are damaged,
// or made for that, and takes along who reads them: here it is a child that dies, and the parent
// tells.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace overturn {

/// The exit code of `read`, called in a child process that prints as this one would; where it
/// throws, the child complains. Throws FileError if the child crashes, or takes a minute of
/// processor time and another one per GB of the file; its memory ends at 512 MiB and twice the size
/// of the file. Not within an MPI session, whose memory a child must not touch.
int read_apart(const std::string& path, const std::function<int()>& read);

/// For a process that is of use to its parent alone.
void end_with_parent();

/// What overturn answers to other arguments.
struct Answer {
    int exit_code = 0; ///< exit_code::stopped if it was not wanted any more
    std::string output;
    std::string complaint; ///< without "overturn: "; or how the process ended, if it said nothing
};

/// Runs this program once more, with the text as its standard input, and waits for its end or until
/// it is not wanted any more. Within an MPI session too. Throws FileError if it cannot be started.
Answer ask_overturn(const std::vector<std::string>& arguments,
                    const std::function<bool()>& is_unwanted, const std::string& input = {});

} // namespace overturn
