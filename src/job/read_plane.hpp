// [plane] and [block]: the four axes.
#pragma once

#include "overturn/sweep/fields.hpp"
#include "overturn/sweep/plane.hpp"
#include "toml_reading.hpp"

#include <vector>

namespace overturn {

/// Reads the plane of a job whose points, with these fields, can be counted and addressed.
Plane read_plane(const Entry& job, const std::vector<Field>& fields);

} // namespace overturn
