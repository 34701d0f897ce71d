// The parts that all result files have in common: HDF5 that is also valid netCDF-4, and the
// provenance of the file.
#pragma once

#include "hdf5_handles.hpp"

#include "overturn/file/stored_result.hpp"
#include "overturn/job/job.hpp"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace overturn::netcdf {

/// Slowest first.
using Dimensions = std::vector<StoredDimension>;

/// Numbers, codes or characters, row by row.
using Values = std::variant<std::vector<double>, std::vector<std::uint8_t>, std::string>;

struct Variable {
    std::string name;
    /// Its own name if it is a dimension; of characters, the last one is NAME_length.
    Dimensions dimensions;
    Values values;         ///< in `units`
    std::string long_name; ///< at most 40 characters: plots take it as the label of an axis
    std::string units = {};
    std::string comment = {};
    std::span<const std::string_view> code_names = {}; ///< by code

    bool is_dimension() const { return !dimensions.empty() && dimensions.front().name == name; }
};

/// A variable that contains a member of each item of a list.
template <class Item>
struct MemberVariable {
    const char* name;
    const char* long_name;
    const char* units;
    double Item::*value;
    const char* comment = "";
};

/// Adds a variable. Its dimensions must exist in the file, except its own one and NAME_length.
void add_variable(hid_t file, const Variable& variable);

/// Stores a text as a variable, because a compact attribute is limited to 64 KiB. An empty text is
/// left out.
void add_text(hid_t file, const std::string& name, const std::string& text,
              const std::string& long_name);

/// Adds numbers of the group `run`, all 0.
hdf5::Handle add_numbers(hid_t file, const char* name, const Dimensions& along,
                         const char* long_name);

/// Adds a group. The names of its variables and dimensions begin with its name and a slash.
void add_group(hid_t file, const char* name);

/// Adds a netCDF-4 dimension without a variable. Its dataset takes no space.
void add_bare_dimension(hid_t file, const StoredDimension& dimension);

hdf5::Handle dataset_creation();
hdf5::Handle create_dataset(hid_t file, const std::string& name, hid_t type,
                            const Dimensions& dimensions, hid_t creation);

/// The file, components and header lines of a record, as stored.
std::string record_text(const RecordedMotion& motion);

/// Adds the content to a file under construction.
using WriteContent = std::function<void(hid_t file)>;

/// Writes a file of this kind: kind, program version and scene as attributes; the content that
/// `write` adds; and in the group `run` the job as given, its overrides, and as resolved. Throws
/// Hdf5Error.
void write_file(const std::string& path, const Job& job, FileKind kind, const WriteContent& write);

/// Creates or replaces a file, which appears when it is complete. `write` writes it under a
/// temporary path. Throws Error, and leaves no file behind.
void create_in_place(const std::string& path,
                     const std::function<void(const std::string& temporary)>& write);

/// Creates or replaces a file of this kind with both.
void make_file(const std::string& path, const Job& job, FileKind kind, const WriteContent& write);

} // namespace overturn::netcdf
