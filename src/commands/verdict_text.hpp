// The sentence that gives a verdict: also how close the asked strength is to those that topple the
// block, because a verdict at one strength hides a near miss.
#pragma once

#include "toppling.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace overturn {

/// Such as "does not topple at 0.95 g; topples at 0.9889 g (4.1 % more)". Of the other
/// restitutions, the worst one is named if it is worse than the requested one. Strengths are
/// rounded towards the asked one. scale: the asked strength if it is a factor on the record. place:
/// follows the strength, such as " in direction 180". The answer must have a verdict.
std::string verdict_sentence(const ToppleAnswer& answer, const std::optional<double>& scale,
                             std::string_view place = "");

} // namespace overturn
