// The checksum of the values of a dataset.
#pragma once

#include "hdf5_handles.hpp"

#include <cstdint>
#include <string>

namespace overturn {

/// The XXH64 of shape and values of a dataset of doubles or characters, in hexadecimal digits.
/// bytes_of_file: limits the size of a damaged dataset. Throws Hdf5Error if it is malformed.
std::string dataset_checksum(hid_t dataset, std::uint64_t bytes_of_file);

} // namespace overturn
