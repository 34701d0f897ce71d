#include "hdf5_handles.hpp"

#include "operating_system.hpp"

namespace overturn::hdf5 {

namespace {

herr_t take_first(unsigned position, const H5E_error2_t* error, void* description)
{
    if (position == 0 && error->desc != nullptr) {
        *static_cast<std::string*>(description) = error->desc;
    }
    return 0;
}

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

void start()
{
    H5dont_atexit();
    check(H5open());
    check(H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr));
}

std::string innermost_cause()
{
    std::string description;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &description);
    // HDF5 quotes messages of the system, "error message = 'No space left on device'", and of MPI.
    const std::string cause =
        quoted_after("error message = '", quoted_after("MPI error string is '", description));
    if (cause.empty()) {
        return "HDF5 gave no reason";
    }
    return in_sentence(cause);
}

Handle file_access()
{
    Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    check(H5Pset_file_locking(access, false, true));
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

} // namespace overturn::hdf5
