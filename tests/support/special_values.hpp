// Special values of double.
#pragma once

#include <limits>

namespace overturn {

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace overturn
