// The modes of a block that may slip.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace overturn {

enum class SlidingMode : std::uint8_t { rest, slide, rock, slide_rock };

/// Names in result files, in the order of the enumerators.
inline constexpr std::array<std::string_view, 4> sliding_mode_names{"rest", "slide", "rock",
                                                                    "slide_rock"};

} // namespace overturn
