// Attributes of files and datasets in the forms that every netCDF-4 reader supports: fixed-length
// UTF-8 text, numbers, and lists of numbers.
#pragma once

#include "hdf5_handles.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace overturn::hdf5 {

/// An empty text is left out: a fixed length cannot be 0.
void write_attribute(hid_t object, const char* name, std::string_view text);
void write_attribute(hid_t object, const char* name, double value);
void write_attribute(hid_t object, const char* name, std::int64_t value);
void write_attribute(hid_t object, const char* name, const std::vector<std::uint8_t>& values);
void write_attribute(hid_t object, const char* name, const std::vector<std::uint16_t>& values);
void write_attribute(hid_t object, const char* name, const std::vector<std::uint32_t>& values);
void write_attribute(hid_t object, const char* name, const std::vector<std::int64_t>& values);

/// Empty if the attribute is missing or is not fixed-length text.
std::string read_text_attribute(hid_t object, const char* name);

bool has_attribute(hid_t object, const char* name);

/// Throw Hdf5Error if the attribute is missing, or is not a number or a list of numbers.
std::int64_t read_integer_attribute(hid_t object, const char* name);
std::vector<std::int64_t> read_integers_attribute(hid_t object, const char* name);

} // namespace overturn::hdf5
