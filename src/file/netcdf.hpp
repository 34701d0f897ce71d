// The parts that all result files have in common: HDF5 that is also valid netCDF-4, and the
// provenance of the file.
#pragma once

#include "attributes.hpp"
#include "hdf5_handles.hpp"

#include "overturn/file/stored_result.hpp"
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
    /// Slowest first; its own name if it is a dimension; empty for a single value.
    std::vector<std::string> dimensions;
    DatasetShape shape;
    std::vector<double> values; ///< in `units`
    std::string long_name;      ///< at most 40 characters: plots take it as the label of an axis
    std::string units;
    std::string comment = {};

    bool is_dimension() const { return !dimensions.empty() && dimensions.front() == name; }
};

/// Adds a variable. Its dimensions must exist in the file, unless the variable is itself a
/// dimension.
void add_variable(hid_t file, const Variable& variable);

/// Adds a variable of codes along one dimension. A code is the index of its name in `names`.
void add_codes(hid_t file, const char* name, const char* dimension,
               const std::vector<std::uint8_t>& codes, const char* long_name,
               std::span<const std::string_view> names);

/// Adds a variable of names along one dimension, or a single one if `dimension` is empty, as an
/// array of characters filled up with NUL.
void add_names(hid_t file, const std::string& name, const std::string& dimension,
               const std::vector<std::string>& names, const char* long_name);

/// Adds a group. The names of its variables and dimensions begin with its name and a slash.
void add_group(hid_t file, const char* name);

/// Adds a netCDF-4 dimension without a variable. Its dataset takes no space.
void add_bare_dimension(hid_t file, const std::string& name, std::int64_t length);

/// Create a dataset of any type; to be followed by attach_dimensions().
hdf5::Handle dataset_creation();
hdf5::Handle create_dataset(hid_t file, const std::string& name, hid_t type,
                            const DatasetShape& shape, hid_t creation);

/// Names the dimensions of a dataset, slowest first.
void attach_dimensions(hid_t file, hid_t dataset, const std::vector<std::string>& names);

/// Stores a text as a variable, because a compact attribute is limited to 64 KiB. An empty text is
/// left out.
void add_text(hid_t file, const std::string& name, const std::string& text, const char* long_name);

/// The file, components and header lines of a record, as stored.
std::string record_text(const Motion& motion);

/// Creates a file of this kind: kind, program version and scene as attributes; the content that
/// `write` adds; and in the group `run` the job as given, its overrides, and as resolved. Throws
/// Hdf5Error.
void make_file(const std::string& path, const Job& job, FileKind kind,
               const std::function<void(hid_t file)>& write);

} // namespace overturn::netcdf
