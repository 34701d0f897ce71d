// What every result file has in common: HDF5 that is valid netCDF-4 as well, and says where it
// comes from.
#pragma once

#include "attributes.hpp"
#include "hdf5_handles.hpp"

#include "overturn/file/spectrum_summary.hpp"
#include "overturn/job/job.hpp"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace overturn::netcdf {

using DatasetShape = std::vector<hsize_t>;

/// Numbers over named dimensions.
struct Variable {
    std::string name;
    std::vector<std::string> dimensions; ///< slowest first; its own name: it is a dimension itself
    DatasetShape shape;
    std::vector<double> values; ///< in `units`
    std::string long_name;
    std::string units;

    bool is_dimension() const { return dimensions.front() == name; }
};

/// Its dimensions are in the file already, unless it is one itself.
void add_variable(hid_t file, const Variable& variable);

/// A variable of codes, which count the names from 0, along one dimension.
void add_codes(hid_t file, const char* name, const char* dimension,
               const std::vector<std::uint8_t>& codes, const char* long_name,
               std::span<const std::string_view> names);

/// A dimension without a variable, in the words of netCDF-4. Its dataset takes no space.
void add_bare_dimension(hid_t file, const std::string& name, std::int64_t length);

/// For a dataset of another type: to be followed by attach_dimensions().
hdf5::Handle dataset_creation();
hdf5::Handle create_dataset(hid_t file, const std::string& name, hid_t type,
                            const DatasetShape& shape, hid_t creation);

/// Names the dimensions of a dataset, slowest first.
void attach_dimensions(hid_t file, hid_t dataset, const std::vector<std::string>& names);

/// Makes a file of this kind (its attribute `kind`): what it is, which program made it and the
/// scene, as attributes; what `write` puts into it; and the job as given, the settings laid over
/// it, and as resolved. Throws Hdf5Error.
void make_file(const std::string& path, const Job& job, FileKind kind,
               const std::function<void(hid_t file)>& write);

} // namespace overturn::netcdf
