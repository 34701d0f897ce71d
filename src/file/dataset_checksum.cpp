#include "dataset_checksum.hpp"

#include "own_dataset.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <vector>

namespace overturn {

std::string dataset_checksum(hid_t dataset, std::uint64_t bytes_of_file)
{
    const bool is_text = has_type(dataset, H5T_C_S1);
    constexpr const char* malformed = "a coordinate is malformed";
    demand(is_text || has_type(dataset, H5T_IEEE_F64LE), malformed);
    const std::vector<hsize_t> shape = shape_of(dataset);
    hsize_t bytes = is_text ? 1 : sizeof(double);
    for (const hsize_t length : shape) {
        demand(length > 0 && bytes <= bytes_of_file / length, malformed);
        bytes *= length;
    }
    std::vector<char> values(bytes);
    hdf5::check(H5Dread(dataset, is_text ? H5T_C_S1 : H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL,
                        H5P_DEFAULT, values.data()));
    const std::uint64_t seed = XXH64(shape.data(), shape.size() * sizeof(hsize_t), 0);
    return fmt::format("{:016x}", std::uint64_t(XXH64(values.data(), values.size(), seed)));
}

} // namespace overturn
