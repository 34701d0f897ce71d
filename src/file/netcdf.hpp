// What every result file has in common: HDF5 that is valid netCDF-4 as well, and says where it
// comes from.
#pragma once

#include "attributes.hpp"
#include "hdf5_handles.hpp"

#include "overturn/job/job.hpp"

#include <hdf5_hl.h>

#include <string>
#include <vector>

namespace overturn::netcdf {

using DatasetShape = std::vector<hsize_t>;

hdf5::Handle file_creation();
hdf5::Handle dataset_creation();
hdf5::Handle create_dataset(hid_t file, const char* name, hid_t type, const DatasetShape& shape,
                            hid_t creation);

/// Values over dimensions that are not attached yet.
void add_numbers(hid_t file, const char* name, const DatasetShape& shape,
                 const std::vector<double>& values, const char* long_name, const char* units);

/// Makes the named variable the coordinate of the dimension of its name.
void make_dimension(hid_t file, const char* name);

/// A dimension without a variable, in the words of netCDF-4. Its dataset takes no space.
void add_bare_dimension(hid_t file, const std::string& name, std::int64_t length);

/// Names the dimensions of a dataset, slowest first.
template <class Names>
void attach_dimensions(hid_t file, hid_t dataset, const Names& names)
{
    unsigned position = 0;
    for (const char* name : names) {
        const hdf5::Handle scale(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
        hdf5::check(H5DSattach_scale(dataset, scale, position++));
    }
}

/// Variables, because a compact attribute ends at 64 KiB and lists can be longer; arrays of
/// characters, because HDF5 1.10 crashes when it reads a damaged heap of variable-length strings.
/// An empty text is left out.
void add_text(hid_t file, const std::string& name, const std::string& text, const char* long_name);

/// The job as given, the settings laid over it, and as resolved.
void add_job(hid_t file, const Job& job);

/// Attributes of the file: what it is, which program made it, and the scene.
void write_origin(hid_t file, const Job& job, const char* kind);

} // namespace overturn::netcdf
