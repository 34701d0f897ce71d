// The message and the exit code of an exception that ends a command.
#pragma once

#include "overturn/text/error.hpp"

#include <exception>
#include <string>

namespace overturn {

/// That of an Error, otherwise exit_code::internal.
int exit_code_of(const std::exception& error);

/// The message of an error, safe to print on a terminal.
std::string message_of(const std::exception& error);

/// Prints `overturn: message` to stderr and returns the exit code.
int complain(const std::exception& error);

/// `when` is appended to "stopped by a signal".
Error stopped_by_signal(const std::string& when);

} // namespace overturn
