// What the quantities of a grid must satisfy together.
#pragma once

#include "overturn/problem/grid.hpp"
#include "overturn/problem/scene.hpp"

namespace overturn {

/// Throws GivenError unless the quantities describe the block, its loss at impacts and the motion
/// completely, and what follows from them is allowed.
void expect_valid(const Scene& scene, const Grid& grid);

} // namespace overturn
