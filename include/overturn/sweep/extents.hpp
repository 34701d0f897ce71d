// What the coordinates of a plane or a list amount to in metres, seconds and g.
#pragma once

#include "overturn/sweep/plane.hpp"
#include "overturn/sweep/scene.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// The smallest and the largest of some values.
struct Extent {
    double first;
    double last;

    /// "2 m", or "1 to 2 m" if both differ. unit: begins with a blank unless it is empty.
    std::string text(std::string_view unit) const;
};

/// f of the ends of an axis.
template <class Function>
Extent extent_of(const Axis& axis, const Function& f)
{
    const auto [first, last] = std::minmax({f(axis.first()), f(axis.last())});
    return {first, last};
}

/// f of all values of a list, which is not empty.
template <class Function>
Extent extent_of(const std::vector<double>& values, const Function& f)
{
    Extent extent{f(values.front()), f(values.front())};
    for (const double value : values) {
        extent = {std::min(extent.first, f(value)), std::max(extent.last, f(value))};
    }
    return extent;
}

/// alpha [rad] of the blocks.
Extent slendernesses_of(const Plane& plane);

/// R [m] of the blocks; nullopt if it is not known.
std::optional<Extent> sizes_of(const Scene& scene, const Plane& plane);

/// Periods of the pulse [s]; nullopt under a record, or if the size of the blocks is not known.
std::optional<Extent> periods_of(const Scene& scene, const Plane& plane);

/// Peak ground accelerations over g of all points [1].
Extent accelerations_of(const Scene& scene, const Plane& plane);

} // namespace overturn
