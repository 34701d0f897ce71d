// The search for flips of the verdict along any path of points.
#pragma once

#include "overturn/sweep/boundary.hpp"

#include <functional>
#include <vector>

namespace overturn {

/// The points along which verdicts are searched. Their motion varies continuously.
struct Path {
    std::function<std::vector<Point>(const std::vector<double>&)> at; ///< the points at values
    /// What steps and widths are shares of, at a value: a strength itself, or the whole range of
    /// another quantity.
    std::function<double(double)> scale;
};

/// Where a search begins.
struct FlipScan {
    std::vector<double> values;    ///< ascending, computed first
    std::vector<double> undecided; ///< further ones, known to be undecided
};

/// The flips between the values of a scan, see boundary_on().
Boundary flips_along(const Path& path, const Scene& scene, const FlipScan& scan,
                     const FlipSearch& search, Kernel kernel);

} // namespace overturn
