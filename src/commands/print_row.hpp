// One row of what a command tells: a name, and what there is to say about it.
#pragma once

#include <fmt/format.h>

#include <string_view>

namespace overturn {

inline void print_row(std::string_view name, std::string_view text)
{
    fmt::print("{:<12} {}\n", name, text);
}

} // namespace overturn
