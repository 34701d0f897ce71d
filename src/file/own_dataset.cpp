#include "own_dataset.hpp"

#include <fmt/format.h>
#include <xxhash.h>

namespace overturn {

using hdf5::check;
using hdf5::Handle;

namespace {

/// The number of names (hard links) of an object.
unsigned count_names(hid_t object)
{
#if H5_VERSION_GE(1, 12, 0)
    H5O_info2_t info = {};
    check(H5Oget_info3(object, &info, H5O_INFO_BASIC));
#else
    H5O_info_t info = {};
    check(H5Oget_info(object, &info));
#endif
    return info.rc;
}

/// With the path in the file; its beginning if it is long.
std::string name_of(hid_t object)
{
    std::string name(64, '\0');
    check(H5Iget_name(object, name.data(), name.size()));
    return name.substr(0, name.find('\0'));
}

/// As by h5repack, which may shorten values more than anything else in the file.
bool is_compressed(hid_t creation)
{
    return check(H5Pget_nfilters(creation)) > 0;
}

constexpr std::uint64_t largest_compression = 1032; // of deflate: 258 equal bytes take two bits

/// Whether all values are stored, or as many chunks of them as given. This also reads the whole
/// chunk index, so that a damaged index is found, or crashes HDF5, before the file is used.
bool is_stored(hid_t dataset, hid_t creation, const hdf5::Extents& shape, hsize_t bytes_per_value,
               const std::optional<std::int64_t>& chunks)
{
    hdf5::Extents chunk(shape.size(), 1);
    if (H5Pget_layout(creation) == H5D_CHUNKED) {
        check(H5Pget_chunk(creation, int(chunk.size()), chunk.data()));
    }
    hsize_t all = 1;
    hsize_t bytes_of_chunk = bytes_per_value;
    for (std::size_t i = 0; i < shape.size(); ++i) {
        require(chunk[i] >= 1, "a dataset has empty chunks");
        all *= (shape[i] + chunk[i] - 1) / chunk[i];
        bytes_of_chunk *= chunk[i];
    }
    const hsize_t expected = (chunks ? hsize_t(*chunks) : all) * bytes_of_chunk;
    return H5Dget_storage_size(dataset) == expected || is_compressed(creation);
}

} // namespace

void require(bool condition, std::string_view what_is_wrong)
{
    if (!condition) {
        throw hdf5::Hdf5Error(std::string(what_is_wrong));
    }
}

Handle open_own_dataset(hid_t file, const std::string& name)
{
    // The groups on the path, and the dataset itself.
    for (std::size_t end = name.find('/');; end = name.find('/', end + 1)) {
        H5L_info_t link = {};
        check(H5Lget_info(file, name.substr(0, end).c_str(), &link, H5P_DEFAULT));
        require(link.type == H5L_TYPE_HARD, "a dataset is a link to another object");
        if (end == name.npos) {
            break;
        }
    }
    Handle dataset = hdf5::open_dataset(file, name);
    const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
    require(check(H5Pget_external_count(creation)) == 0 && H5Pget_layout(creation) != H5D_VIRTUAL,
            "the values of a dataset are stored in another file");
    require(count_names(dataset) == 1, "a dataset has two names");
    return dataset;
}

hdf5::Extents shape_of(hid_t dataset)
{
    const Handle space(H5Dget_space(dataset), H5Sclose);
    hdf5::Extents shape(std::size_t(check(H5Sget_simple_extent_ndims(space))));
    check(H5Sget_simple_extent_dims(space, shape.data(), nullptr));
    return shape;
}

bool has_type(hid_t dataset, const hdf5::Type& expected)
{
    const Handle type(H5Dget_type(dataset), H5Tclose);
    return check(H5Tequal(type, expected.file)) > 0;
}

std::size_t count_stored(hid_t dataset, const hdf5::Type& type, std::uint64_t bytes_of_file,
                         const std::optional<std::int64_t>& chunks)
{
    const auto require_that = [&](bool condition, const char* what_is_wrong) {
        require(condition, fmt::format("the dataset {} {}", name_of(dataset), what_is_wrong));
    };
    require_that(has_type(dataset, type), "has another type");
    const hsize_t bytes_per_value = H5Tget_size(type.file);
    const hdf5::Extents shape = shape_of(dataset);
    const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
    const std::uint64_t most = bytes_of_file * (is_compressed(creation) ? largest_compression : 1);
    hsize_t count = 1;
    for (const hsize_t length : shape) {
        require_that(length > 0, "is empty");
        require_that(chunks || length <= most / bytes_per_value / count, "is larger than the file");
        count *= length;
    }
    require_that(is_stored(dataset, creation, shape, bytes_per_value, chunks), "lacks values");
    return count;
}

std::string dataset_checksum(hid_t dataset, std::uint64_t bytes_of_file)
{
    const hdf5::Extents shape = shape_of(dataset);
    const auto checksum = [&](const auto& values) {
        const std::uint64_t seed = XXH64(shape.data(), shape.size() * sizeof shape[0], 0);
        return fmt::format(
            "{:016x}", std::uint64_t(XXH64(values.data(), values.size() * sizeof values[0], seed)));
    };
    return has_type(dataset, hdf5::Type::of(char()))
               ? checksum(read_all<char>(dataset, bytes_of_file))
           : has_type(dataset, hdf5::Type::of(std::uint8_t()))
               ? checksum(read_all<std::uint8_t>(dataset, bytes_of_file))
               : checksum(read_all<double>(dataset, bytes_of_file));
}

} // namespace overturn
