// Parses the command line: the subcommand and its options; help, version, and the texts that are
// installed with the program: manual page and bash completion.
#pragma once

#include <functional>

namespace overturn {

struct Command {
    std::function<int()> execute; ///< returns the exit code
    bool on_every_rank = false;   ///< false: only rank 0 executes the command
};

/// Throws Error.
Command read_command_line(int argc, const char* const* argv);

} // namespace overturn
