// The quantities that describe a block, its ground motion and the integration: names, units and
// allowed values.
#pragma once

#include <cmath>
#include <string_view>

namespace overturn {

/// A quantity as it is named in job files, lists and result files.
struct Quantity {
    std::string_view name;
    std::string_view units;    ///< as in result files; "1" if dimensionless
    std::string_view interval; ///< of the allowed values
    bool (*is_inside)(double); ///< for all values except NaN
    std::string_view reason;   ///< for the interval

    bool allows(double value) const { return !std::isnan(value) && is_inside(value); }
};

/// The quantity of this name, or nullptr.
const Quantity* find_quantity(std::string_view name);

/// The same for a name that is known to exist.
const Quantity& quantity(std::string_view name);

} // namespace overturn
