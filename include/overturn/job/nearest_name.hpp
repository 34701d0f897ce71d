// The name that a misspelt one was probably meant to be.
#pragma once

#include <span>
#include <string_view>

namespace overturn {

/// The name nearest to `word` by edit distance, capital letters aside, or nothing if none is near:
/// a third of the longer of the two may differ. The first of several equally near ones.
std::string_view nearest_name(std::string_view word, std::span<const std::string_view> names);

} // namespace overturn
