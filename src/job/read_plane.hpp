// [plane] and [block]: the four axes.
#pragma once

#include "overturn/sweep/fields.hpp"
#include "overturn/sweep/plane.hpp"
#include "toml_reading.hpp"

#include <vector>

namespace overturn {

/// What can be addressed, with room to spare [bytes].
inline constexpr long double most_bytes = 0x1p62L;

/// How much a plane asks for: in floating point, which cannot overflow here.
struct PlaneSize {
    long double points;
    long double bytes; ///< of these fields
};
PlaneSize size_of(const Plane& plane, const std::vector<Field>& fields);

/// Reads the plane of a job whose points, with these fields, can be counted and addressed.
Plane read_plane(const Entry& job, const std::vector<Field>& fields);

} // namespace overturn
