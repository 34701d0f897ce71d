// How a job and its values are written in TOML.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace overturn {

struct Job;

/// The canonical text of a job, which read_job reads back to an equal job: fixed order, every
/// default spelled out.
std::string resolved_text(const Job& job);

/// The text in double quotes; quotes, backslashes and control characters escaped.
std::string in_quotes(std::string_view text);

/// The shortest text that reads back to the same double, always recognisable as a float.
std::string float_text(double value);

/// The text itself, or its beginning and "..." if it is longer than `longest` bytes.
std::string shortened(std::string_view text, std::size_t longest);

/// The text with a space for each control character, as ends of lines are.
std::string on_one_line(std::string text);

} // namespace overturn
