// Special values of double.
#pragma once

#include <limits>

namespace overturn {

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

} // namespace overturn
