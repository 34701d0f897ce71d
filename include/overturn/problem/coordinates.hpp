// The coordinates of points, given or derived, and the points that they describe.
#pragma once

#include "overturn/problem/grid.hpp"
#include "overturn/problem/point.hpp"
#include "overturn/problem/scene.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// r_max (Eq. 17) exists for blocks below this slenderness, arcsin sqrt(2/3) [rad].
inline constexpr double limit_of_r_max = 0.9553166181245093;

/// r_max of a block of this slenderness [rad] (Eq. 17); nullopt if it does not exist.
std::optional<double> r_max_of(double slenderness);

/// The values of a coordinate in a box of points. It may vary along some of the dimensions only.
struct CoordinateValues {
    std::vector<std::size_t> dimensions; ///< along which it varies, slowest first
    std::vector<double> values;          ///< row by row

    double first() const { return values.front(); }
};

/// The coordinates of a box of points.
class Coordinates {
public:
    /// Of all points, or of those in a tile. Both arguments must outlive this object.
    Coordinates(const Scene& scene, const Grid& grid);
    Coordinates(const Scene& scene, const Grid& grid, const Tile& tile);

    /// Whether the grid contains a coordinate, or it follows from those that it contains.
    bool has(std::string_view name) const;

    /// The dimensions along which a coordinate varies, slowest first; has(name) must be true.
    std::vector<std::size_t> dimensions_of(std::string_view name) const;

    /// Those along which at least one of some coordinates varies.
    std::vector<std::size_t> dimensions_of_any(const std::vector<std::string_view>& names) const;

    /// The values of a coordinate; has(name) must be true. See derivations_of() for the names.
    const CoordinateValues& of(std::string_view name) const;

    /// All points of the box, row by row.
    std::vector<Point> points() const;

    /// The values of a coordinate along these dimensions, which contain its own, row by row.
    std::vector<double> along(const std::vector<std::size_t>& dimensions,
                              std::string_view name) const;

private:
    const Scene& scene_;
    const Grid& grid_;
    Shape begin_, count_;
    mutable std::map<std::string, CoordinateValues, std::less<>> known_;
};

/// The factors on each record [1]; infinity and 0 for one to which no point is subjected.
std::vector<Extent> scales_of(const Scene& scene, const Grid& grid);

} // namespace overturn
