// Suggests a name for a misspelt one.
#pragma once

#include <span>
#include <string_view>

namespace overturn {

/// The name nearest to `word` by edit distance, ignoring case; the first of several equally near
/// ones: at most a third of the longer of the two may differ. Without one, the first name that
/// begins with the word and an underscore, or the other way round; mu is a friction_coefficient.
/// Empty if none is near.
std::string_view nearest_name(std::string_view word, std::span<const std::string_view> names);

} // namespace overturn
