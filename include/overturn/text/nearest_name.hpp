// Suggests a name for a misspelt one.
#pragma once

#include <span>
#include <string_view>

namespace overturn {

/// The name nearest to `word` by edit distance, ignoring case; the first of several equally near
/// ones. Empty if none is near: at most a third of the longer of the two may differ.
std::string_view nearest_name(std::string_view word, std::span<const std::string_view> names);

} // namespace overturn
