// Datasets of a result file that may be damaged or malicious.
#pragma once

#include "hdf5_handles.hpp"

#include "overturn/text/error.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <new>
#include <string>
#include <vector>

namespace overturn {

/// Throws Hdf5Error unless the condition holds.
void demand(bool condition, const char* what_is_wrong);

/// Opens a dataset that is stored in the file itself, under a single name. HDF5 follows links and
/// external storage into other files, which a resumed run would write to.
hdf5::Handle open_own_dataset(hid_t file, const std::string& name);

std::vector<hsize_t> shape_of(hid_t dataset);
bool has_type(hid_t dataset, hid_t expected);

/// The length of a list of this type. It is checked against the size of the file, because a damaged
/// length could exhaust the memory.
hsize_t length_of_list(hid_t dataset, hid_t type, std::uint64_t bytes_of_file,
                       const char* what_is_wrong);

/// Returns the result of `read`; converts its errors to an Error that names the file.
template <class Read>
auto or_refused(const std::string& path, const Read& read)
{
    try {
        return read();
    } catch (const hdf5::Hdf5Error& error) {
        throw Error(exit_code::output, "\"{}\" cannot be read or is damaged: {}.", path,
                    error.what());
    } catch (const std::bad_alloc&) {
        throw Error(exit_code::output, "\"{}\" is damaged: it contains an impossible size.", path);
    }
}

} // namespace overturn
