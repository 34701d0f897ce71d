// How much a plane asks for. In floating point, which cannot overflow here.
#pragma once

#include "overturn/sweep/fields.hpp"
#include "overturn/sweep/plane.hpp"

#include <vector>

namespace overturn {

/// What can be addressed, with room to spare [bytes].
inline constexpr long double most_bytes = 0x1p62L;

struct PlaneSize {
    long double points;
    long double bytes;
};

inline PlaneSize size_of(const Plane& plane, const std::vector<Field>& fields)
{
    long double points = 1;
    for (const Axis* axis :
         {&plane.frequency, &plane.amplitude, &plane.restitution, &plane.slenderness}) {
        points *= static_cast<long double>(axis->size());
    }
    std::size_t bytes_of_point = 0;
    for (const Field field : fields) {
        bytes_of_point += bytes_per_point(field);
    }
    return {points, points * static_cast<long double>(bytes_of_point)};
}

} // namespace overturn
