#include "hdf5_handles.hpp"

#include "working_file.hpp"

namespace overturn::hdf5 {

namespace {

/// The text between `mark` and the next quote; the whole description if it does not contain `mark`.
std::string quoted_after(const std::string& mark, const std::string& description)
{
    const std::size_t begin = description.find(mark);
    if (begin == std::string::npos) {
        return description;
    }
    const std::size_t end = description.find('\'', begin + mark.size());
    return description.substr(begin + mark.size(), end - begin - mark.size());
}

} // namespace

std::string innermost_cause()
{
    std::string description;
    const auto take_first = [](unsigned position, const H5E_error2_t* error, void* taken) {
        if (position == 0 && error->desc != nullptr) {
            *static_cast<std::string*>(taken) = error->desc;
        }
        return herr_t(0);
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &description);
    // HDF5 quotes messages of the system, "error message = 'No space left on device'", and of MPI.
    const std::string cause =
        quoted_after("error message = '", quoted_after("MPI error string is '", description));
    return cause.empty() ? "HDF5 gave no reason" : in_sentence(cause);
}

Handle file_access()
{
    Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    check(H5Pset_file_locking(access, false, true));
    // The cache of the index of chunks is limited by its size in the file; in memory, an entry
    // takes four times as much. By default it may grow to 32 MiB, which are 140 MB in each rank.
    H5AC_cache_config_t cache = {};
    cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
    check(H5Pget_mdc_config(access, &cache));
    cache.max_size = cache.initial_size;
    cache.flash_incr_mode = H5C_flash_incr__off;
    check(H5Pset_mdc_config(access, &cache));
    return access;
}

Handle open_to_read(const std::string& path)
{
    return Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, file_access()), H5Fclose);
}

Handle open_dataset(hid_t file, std::string_view name)
{
    return Handle(H5Dopen2(file, std::string(name).c_str(), H5P_DEFAULT), H5Dclose);
}

Handle space_of(const Extents& shape)
{
    return Handle(H5Screate_simple(int(shape.size()), shape.data(), nullptr), H5Sclose);
}

void write_attribute(hid_t object, const char* name, const Type& type, const Extents& shape,
                     const void* values)
{
    const Handle attribute(
        H5Acreate2(object, name, type.file, space_of(shape), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    check(H5Awrite(attribute, type.memory, values));
}

void write_attribute(hid_t object, const char* name, std::string_view text)
{
    if (!text.empty()) {
        const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
        check(H5Tset_size(type, text.size()));
        check(H5Tset_strpad(type, H5T_STR_NULLPAD));
        check(H5Tset_cset(type, H5T_CSET_UTF8));
        write_attribute(object, name, {type, type}, {}, text.data());
    }
}

std::string read_text_attribute(hid_t object, const char* name)
{
    if (check(H5Aexists(object, name)) == 0) {
        return {};
    }
    const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    const Handle space(H5Aget_space(attribute), H5Sclose);
    if (H5Tget_class(type) != H5T_STRING || check(H5Tis_variable_str(type)) > 0 ||
        check(H5Sget_simple_extent_npoints(space)) != 1) {
        return {};
    }
    std::string text(H5Tget_size(type), '\0');
    check(H5Aread(attribute, type, text.data()));
    return text;
}

std::vector<std::int64_t> read_integers_attribute(hid_t object, const char* name)
{
    if (check(H5Aexists(object, name)) == 0) {
        return {};
    }
    const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
    const Handle space(H5Aget_space(attribute), H5Sclose);
    const hssize_t count = check(H5Sget_simple_extent_npoints(space));
    if (count > H5S_MAX_RANK) {
        throw Hdf5Error("the attribute " + std::string(name) + " is too long");
    }
    std::vector<std::int64_t> values(static_cast<std::size_t>(count));
    check(H5Aread(attribute, H5T_NATIVE_INT64, values.data()));
    return values;
}

} // namespace overturn::hdf5
