// From the quantities that a user gives to a grid of points.
#pragma once

#include "overturn/problem/grid.hpp"
#include "overturn/problem/scene.hpp"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace overturn {

enum class GivenAs { number, axis, column };

/// A quantity as a user gives it: a number, an axis, or a column of a table.
struct Given {
    const Quantity* quantity;
    std::string label; ///< as the user spells it, such as "plane.pga"; of a column, its name
    Axis values;
    GivenAs as;
};

/// An error in the given quantities. The message follows the name of the quantity and begins with a
/// blank; it does not include the place.
class GivenError : public std::runtime_error {
public:
    GivenError(std::int64_t row, std::string_view quantity, const std::string& message)
        : std::runtime_error(message), row_(row), quantity_(quantity)
    {}

    static constexpr std::int64_t no_row = -1;

    std::int64_t row() const { return row_; } ///< from 0, or no_row
    /// The name of the quantity, which may be missing.
    const std::string& quantity() const { return quantity_; }

private:
    std::int64_t row_;
    std::string quantity_;
};

/// The grid of these quantities, which must describe the block, its loss at impacts, and the
/// strength and the rate of the motion, each in one way. The values must be allowed, each on its
/// own. Under records, one quantity is the motion. Throws GivenError.
Grid grid_of(const Scene& scene, std::vector<Given> given);

} // namespace overturn
