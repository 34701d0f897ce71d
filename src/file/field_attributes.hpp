// The attributes of a field in the file: long name, units, and the meaning of codes.
#pragma once

#include "hdf5_handles.hpp"

#include "overturn/problem/fields.hpp"
#include "overturn/problem/scene.hpp"

#include <string>

namespace overturn {

void write_field_attributes(hid_t dataset, Field field, const Scene& scene,
                            const std::string& coordinates);

} // namespace overturn
