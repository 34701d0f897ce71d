// A problem as bytes, to be sent to other processes of the same program on the same kind of
// machine.
#pragma once

#include "overturn/problem/problem.hpp"

#include <string>
#include <string_view>

namespace overturn {

std::string bytes_of(const Problem& problem);

/// bytes: of bytes_of().
Problem problem_of(std::string_view bytes);

} // namespace overturn
