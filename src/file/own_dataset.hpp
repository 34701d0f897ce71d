// Datasets of a result file that may be damaged or malicious.
#pragma once

#include "hdf5_handles.hpp"

#include "overturn/text/error.hpp"

#include <cstdint>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

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

/// Throws Hdf5Error unless the condition holds.
void require(bool condition, std::string_view what_is_wrong);

/// Opens a dataset that is stored in the file itself, under a single name. HDF5 follows links and
/// external storage into other files, which a resumed run would write to.
hdf5::Handle open_own_dataset(hid_t file, const std::string& name);

hdf5::Extents shape_of(hid_t dataset);
bool has_type(hid_t dataset, const hdf5::Type& expected);

/// The number of values of a dataset. Throws Hdf5Error unless they have this type, are all stored,
/// and fit into the file: a damaged length could exhaust the memory. If a number of chunks is
/// given, so many must be stored, and the dataset may be larger than the file.
std::size_t count_stored(hid_t dataset, const hdf5::Type& type, std::uint64_t bytes_of_file,
                         const std::optional<std::int64_t>& chunks = {});

/// All values of a dataset, row by row. Throws Hdf5Error as count_stored() does.
template <class Value>
std::vector<Value> read_all(hid_t dataset, std::uint64_t bytes_of_file)
{
    const hdf5::Type type = hdf5::Type::of(Value());
    std::vector<Value> values(count_stored(dataset, type, bytes_of_file));
    hdf5::check(H5Dread(dataset, type.memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
    return values;
}

/// The XXH64 of shape and values of a dataset of doubles, characters or bytes, in hexadecimal
/// digits.
std::string dataset_checksum(hid_t dataset, std::uint64_t bytes_of_file);

} // namespace overturn
