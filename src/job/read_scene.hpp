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

/// Refuses a tolerance at which the errors that the job asks for are not known.
void expect_known_errors(const Entry& job, const Numerics& numerics,
                         const std::vector<Field>& fields);

} // namespace overturn
