// Errors that the user can correct, and the exit codes of overturn for shells and batch systems.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace overturn {

namespace exit_code {
inline constexpr int complete = 0;
inline constexpr int usage = 2;     ///< the command line; an unsupported processor or launcher
inline constexpr int job = 65;      ///< the job, a record or a table is wrong
inline constexpr int internal = 70; ///< an internal error of overturn
inline constexpr int output = 74;   ///< disk, permission, a file of another job, a damaged file
inline constexpr int stopped = 85;  ///< by a signal or a silent rank; resumable
} // namespace exit_code

/// The message names the place, what was found, what is allowed and what to do.
class Error : public std::runtime_error {
public:
    /// code: one of exit_code, other than complete.
    Error(int code, const std::string& message) : std::runtime_error(message), code_(code) {}

    /// The message is formatted as by fmt::format().
    template <class Argument, class... Others>
    Error(int code, fmt::format_string<Argument, Others...> text, Argument&& argument,
          Others&&... others)
        : Error(code, fmt::format(text, std::forward<Argument>(argument),
                                  std::forward<Others>(others)...))
    {}

    int code() const { return code_; }

private:
    int code_;
};

} // namespace overturn
