// The exit codes of overturn, for the shell and batch systems, and the messages of errors.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace overturn {

namespace exit_code {
inline constexpr int complete = 0;
inline constexpr int usage = 2;     ///< the command line; an unsupported processor or launcher
inline constexpr int job = 65;      ///< the job is wrong
inline constexpr int internal = 70; ///< an internal error of overturn
inline constexpr int output = 74;   ///< disk, permission, a file of another job, a damaged file
inline constexpr int stopped = 85;  ///< by a signal or a silent rank; resumable
} // namespace exit_code

/// The command line is wrong, or asks for something that this machine does not support.
class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A signal stopped the run, which can be resumed.
class Stopped : public std::runtime_error {
public:
    /// `when` is appended to "stopped by a signal".
    explicit Stopped(const std::string& when)
        : std::runtime_error("stopped by a signal" + when +
                             ". Run the same command again to resume.")
    {}
};

int exit_code_of(const std::exception& error);

/// The message of an error, safe to print on a terminal.
std::string message_of(const std::exception& error);

/// Prints `overturn: message` to stderr and returns the exit code.
int complain(const std::exception& error);

} // namespace overturn
