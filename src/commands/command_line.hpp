// The command line: which subcommand is meant, with which options; help and version.
#pragma once

#include <functional>

namespace overturn {

struct Command {
    std::function<int()> execute; ///< returns the exit code
    bool on_every_rank = false;   ///< false: a launcher's other ranks have nothing to do
};

/// Throws UsageError.
Command read_command_line(int argc, const char* const* argv);

} // namespace overturn
