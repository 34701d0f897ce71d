// The attributes of a field in the file: long name, units, and the meaning of codes.
#pragma once

#include "hdf5_handles.hpp"

#include "overturn/sweep/fields.hpp"

#include <string>

namespace overturn {

void write_field_attributes(hid_t dataset, Field field, const std::string& coordinates);

} // namespace overturn
