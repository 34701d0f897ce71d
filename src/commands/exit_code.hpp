// What the shell and batch systems learn from overturn's exit code.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace overturn {

namespace exit_code {
inline constexpr int complete = 0;
inline constexpr int usage = 2;     ///< the command line is wrong
inline constexpr int job = 65;      ///< the job's content is wrong
inline constexpr int internal = 70; ///< a fault of ours
inline constexpr int output = 74;   ///< disk, permission, a file of another job, damage
inline constexpr int stopped = 85;  ///< stopped by a signal, and resumable
} // namespace exit_code

/// The command line asks for what does not exist, or for what does not run here.
class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A signal has stopped the run, which can be resumed.
class Stopped : public std::runtime_error {
public:
    /// `when` follows "stopped by a signal".
    explicit Stopped(const std::string& when)
        : std::runtime_error("stopped by a signal" + when +
                             ". Run the same command again to resume.")
    {}
};

int exit_code_of(const std::exception& error);

/// What to print of it: on one line, and safe on a terminal.
std::string message_of(const std::exception& error);

/// Prints `overturn: message` and returns the exit code.
int complain(const std::exception& error);

} // namespace overturn
