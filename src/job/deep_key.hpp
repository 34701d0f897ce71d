// Keys with so many parts that no stack is long enough for the tables they make.
#pragma once

#include <cstddef>
#include <string_view>

namespace overturn {

/// Parts that a dotted key of a TOML text may have; a job's have three.
inline constexpr std::size_t most_key_parts = 16;

/// Where the text has a key of more parts; npos if it has none. toml++ makes a table within a table
/// of each part, and takes them apart by recursion.
std::size_t find_deep_key(std::string_view text);

} // namespace overturn
