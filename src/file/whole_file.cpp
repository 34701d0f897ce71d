#include "whole_file.hpp"

#include "working_file.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace overturn {

using hdf5::Handle;

void expect_room_for(const std::string& path, const char* kind)
{
    static_cast<void>(PartFile(path)); // which throws if there is no folder, or none to write in
    if (!std::filesystem::exists(path)) {
        return;
    }
    hdf5::start();
    std::string found;
    try {
        const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, hdf5::file_access()), H5Fclose);
        found = hdf5::read_text_attribute(file, "kind");
    } catch (const hdf5::Hdf5Error&) {
        found = "";
    }
    if (found != kind) {
        throw FileError(fmt::format("\"{}\" exists and is no {}. Remove it, or choose another name "
                                    "with -o.",
                                    path, kind));
    }
}

void write_whole_file(const std::string& path, const char* kind, const Job& job,
                      const std::function<void(hid_t file)>& write)
{
    expect_room_for(path, kind);
    PartFile part(path);
    try {
        hdf5::start();
        Handle file(H5Fcreate(part.path().c_str(), H5F_ACC_TRUNC, netcdf::file_creation(),
                              hdf5::file_access()),
                    H5Fclose);
        netcdf::write_origin(file, job, kind);
        write(file);
        netcdf::add_job(file, job);
        file.close();
    } catch (const hdf5::Hdf5Error& error) {
        throw FileError(fmt::format("cannot create \"{}\": {}. Choose another name with -o.", path,
                                    error.what()));
    }
    part.move_into_place();
}

} // namespace overturn
