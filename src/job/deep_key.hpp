// Finds keys with so many parts that parsing them would overflow the stack.
#pragma once

#include <cstddef>
#include <string_view>

namespace overturn {

/// Maximum number of parts of a dotted key; those of a job have at most three.
inline constexpr std::size_t most_key_parts = 16;

/// The position of a key with more parts in a TOML text; npos if there is none. toml++ creates
/// nested tables for the parts, and destroys them recursively.
std::size_t find_deep_key(std::string_view text);

} // namespace overturn
