// Suggests a name for a misspelt one.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace overturn {

/// The name nearest to `word` by edit distance, ignoring case; the first of several equally near
/// ones: at most a third of the longer of the two may differ. Without one, the name nearest in
/// length, in which the word stands between underscores, or the other way round, or with which the
/// word begins; mu is a friction_coefficient. Empty if none is near.
std::string_view nearest_name(std::string_view word, std::span<const std::string_view> names);

/// " Did you mean ...?" with that name after a prefix; empty if none is near.
std::string suggestion(std::string_view word, std::span<const std::string_view> names,
                       std::string_view prefix = "");

} // namespace overturn
