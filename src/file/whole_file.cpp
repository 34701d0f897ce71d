#include "whole_file.hpp"

#include "layout.hpp"
#include "working_file.hpp"

#include "overturn/text/error.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace overturn {

void expect_room_for(const std::string& path, FileKind kind)
{
    static_cast<void>(PartFile(path)); // throws if the folder is missing or not writable
    if (!std::filesystem::exists(path)) {
        return;
    }
    hdf5::start();
    std::string found;
    try {
        found = hdf5::read_text_attribute(hdf5::open_to_read(path), "kind");
    } catch (const hdf5::Hdf5Error&) {
        found = "";
    }
    if (found != layout::name_of(kind)) {
        throw Error(exit_code::output,
                    "\"{}\" exists but its kind is not \"{}\". Remove it, or "
                    "choose another name with -o.",
                    path, layout::name_of(kind));
    }
}

void write_whole_file(const std::string& path, FileKind kind, const Job& job,
                      const std::function<void(hid_t file)>& write)
{
    expect_room_for(path, kind);
    PartFile part(path);
    try {
        netcdf::make_file(part.path(), job, kind, write);
    } catch (const hdf5::Hdf5Error& error) {
        throw Error(exit_code::output, "cannot create \"{}\": {}. Choose another name with -o.",
                    path, error.what());
    }
    part.move_into_place();
}

} // namespace overturn
