// [scene], [numerics] and [output].
#pragma once

#include "overturn/sweep/fields.hpp"
#include "overturn/sweep/scene.hpp"
#include "toml_reading.hpp"

#include <vector>

namespace overturn {

Scene read_scene(const Entry& job);
Numerics read_numerics(const Entry& job);
std::vector<Field> read_fields(const Entry& job);

} // namespace overturn
