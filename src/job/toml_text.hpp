// Formats jobs and their values as TOML.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace overturn {

struct Job;

/// The canonical text of a job, from which read_job reads an equal job: in fixed order, with all
/// defaults.
std::string resolved_text(const Job& job);

/// The text in double quotes, with quotes, backslashes and control characters escaped.
std::string in_quotes(std::string_view text);

/// The shortest text from which the same double is read, always with the syntax of a float.
std::string float_text(double value);

/// The text itself, or its beginning and "..." if it is longer than `longest` bytes.
std::string shortened(std::string_view text, std::size_t longest);

/// The text with each control character, such as a newline, replaced by a space.
std::string on_one_line(std::string text);

} // namespace overturn
