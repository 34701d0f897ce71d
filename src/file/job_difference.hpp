// How two different jobs differ, in their resolved texts.
#pragma once

#include <string>
#include <string_view>

namespace overturn {

/// Shows the first line that differs. whose: of the other job, such as "this job".
std::string differing_line(std::string_view stored, std::string_view given, std::string_view whose);

/// Describes the difference of the job of a file from the given one, and what to do about it.
std::string first_difference(std::string_view stored, std::string_view given);

} // namespace overturn
