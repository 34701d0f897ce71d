// The motion of a request, and how strong it is.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace overturn {

/// The largest acceleration over g that may be asked for. Steps of a search beyond it are too long,
/// or too many.
inline constexpr double largest_pga = 1000;

struct MotionRequest {
    std::string pulse = "one_sine";     ///< its name, without a record
    std::string shape;                  ///< path of its table; empty: none
    std::string component;              ///< of the record, its name or number
    std::optional<double> pga;          ///< over g [1]
    std::optional<double> scale;        ///< of the record [1]
    std::vector<std::string> overrides; ///< of keys of [scene]
    double pga_max = 5;                 ///< the largest acceleration searched, over g [1]

    bool has_strength() const { return pga || scale; }
};

} // namespace overturn
