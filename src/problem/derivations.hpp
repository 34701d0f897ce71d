// Which coordinate follows from which others, and how.
#pragma once

#include "overturn/problem/grid.hpp"
#include "overturn/problem/scene.hpp"

#include <array>
#include <string_view>

namespace overturn {

/// A coordinate that follows from at most five others; the constant default of a quantity follows
/// from none.
struct Derivation {
    using Values = std::array<double, 5>; ///< of the others

    std::string_view name;
    std::array<std::string_view, 5> from;
    double (*value)(const Scene& scene, const Values& of);
    Under motion = Under::any_motion;
};

/// The derivation of a coordinate that the grid does not contain; nullptr if there is none.
const Derivation* derivation_of(std::string_view name, const Scene& scene, const Grid& grid);

} // namespace overturn
