// What shakes the blocks: the ground, or a floor of a building. Their motions have the same
// quantities, but different names for them. Texts are written for the ground.
#pragma once

#include "overturn/text/names.hpp"

#include <array>
#include <string>
#include <string_view>

namespace overturn {

enum class MotionOf { ground, floor };

/// In job files, result files and records.
template <>
inline constexpr std::array<std::string_view, 2> names_of<MotionOf>{"ground", "floor"};

/// A text about the motion of the ground in the words for this motion: that of a floor has a peak
/// floor acceleration (PFA) instead of a peak ground acceleration (PGA). The text must not contain
/// names that users give, such as those of files.
std::string worded(MotionOf motion_of, std::string_view about_the_ground);

} // namespace overturn
