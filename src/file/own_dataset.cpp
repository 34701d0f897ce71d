#include "own_dataset.hpp"

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

} // namespace

void demand(bool condition, const char* what_is_wrong)
{
    if (!condition) {
        throw hdf5::Hdf5Error(what_is_wrong);
    }
}

Handle open_own_dataset(hid_t file, const std::string& name)
{
    // The groups on the path, and the dataset itself.
    for (std::size_t end = name.find('/');; end = name.find('/', end + 1)) {
        H5L_info_t link = {};
        check(H5Lget_info(file, name.substr(0, end).c_str(), &link, H5P_DEFAULT));
        demand(link.type == H5L_TYPE_HARD, "a dataset is a link to another object");
        if (end == name.npos) {
            break;
        }
    }
    Handle dataset = hdf5::open_dataset(file, name);
    const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
    demand(check(H5Pget_external_count(creation)) == 0 && H5Pget_layout(creation) != H5D_VIRTUAL,
           "the values of a dataset are stored in another file");
    demand(count_names(dataset) == 1, "a dataset has two names");
    return dataset;
}

std::vector<hsize_t> shape_of(hid_t dataset)
{
    const Handle space(H5Dget_space(dataset), H5Sclose);
    std::vector<hsize_t> shape(std::size_t(check(H5Sget_simple_extent_ndims(space))));
    check(H5Sget_simple_extent_dims(space, shape.data(), nullptr));
    return shape;
}

bool has_type(hid_t dataset, hid_t expected)
{
    const Handle type(H5Dget_type(dataset), H5Tclose);
    return check(H5Tequal(type, expected)) > 0;
}

hsize_t length_of_list(hid_t dataset, hid_t type, std::uint64_t bytes_of_file,
                       const char* what_is_wrong)
{
    const std::vector<hsize_t> shape = shape_of(dataset);
    const hsize_t bytes_per_value = H5Tget_size(type);
    demand(shape.size() == 1 && shape[0] <= bytes_of_file / bytes_per_value &&
               shape[0] * bytes_per_value <= H5Dget_storage_size(dataset) &&
               has_type(dataset, type),
           what_is_wrong);
    return shape[0];
}

} // namespace overturn
