// The coordinates of points, given or derived. The source is the only place where p follows from R,
// r from r_max, alpha from b and h, and the amplitude from the peak ground acceleration.
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

/// The ground acceleration over g that lifts a block of this slenderness [rad] at rest [1].
double uplift_threshold(Theory theory, double slenderness);

/// The record of a point, in its direction.
Record directed_record(const Scene& scene, const Point& point);

/// The peak ground acceleration over g of a motion of the strength 1: the amplitude of a pulse that
/// excites the block of this point, or the scale of its record.
double pga_of_unit(const Scene& scene, const Point& point);

/// The amplitude of a point from which on the vertical motion cancels gravity at some time;
/// infinite without a vertical motion.
double free_fall_amplitude(const Scene& scene, const Point& point);

/// The largest peak ground acceleration over g at which the motion of this point does not lift its
/// block at rest; infinite if none does.
double lifting_pga(const Scene& scene, const Point& point);

/// The same for a motion that does not move the block at rest: it neither lifts it nor makes it
/// slide.
double moving_pga(const Scene& scene, const Point& point);

/// Whether the block slides before it could lift on either side, so that it never rocks.
bool stays_flat(const Point& point);

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

} // namespace overturn
