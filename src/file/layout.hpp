// The layout of result files: names, dimensions and types, shared by writers and readers.
#pragma once

#include "hdf5_handles.hpp"

#include "overturn/file/stored_result.hpp"
#include "overturn/problem/fields.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <variant>

namespace overturn::layout {

/// Values of the global attribute `kind`, in the order of FileKind.
inline constexpr std::array<const char*, 4> kinds{"overturning spectrum", "overturning boundary",
                                                  "rocking history", "accuracy study"};

inline constexpr const char* name_of(FileKind kind)
{
    return kinds[std::size_t(kind)];
}

/// Global attribute: the version of the layout. Files of format 3, in which every quantity is a
/// dimension and coordinates have no checksums, can be read but not resumed.
inline constexpr char format_version[] = "format_version";
inline constexpr std::int64_t newest_format = 4;
inline constexpr std::int64_t oldest_format = 3;

/// The group of what is neither a coordinate nor a field: how the file was computed. Readers that
/// open the root group, such as xarray.open_dataset(), do not see it.
inline constexpr char run_group[] = "run";

/// The place of an object of the group `run`.
inline std::string in_run_group(const std::string& name)
{
    return std::string(run_group) + "/" + name;
}

// In the group `run`.
inline constexpr char scan_prefix[] = "scan_"; ///< followed by amplitude, scale or pga
inline constexpr char run_token[] = "run_token";
inline constexpr char checksum[] = "checksum";
inline constexpr char tile[] = "tile";
inline constexpr char audit_checked[] = "audit_checked"; ///< of a filled spectrum, as the next
inline constexpr char audit_wrong[] = "audit_wrong";
inline constexpr char job_resolved[] = "job_resolved";
inline constexpr char coordinate_checksums[] = "coordinate_checksums"; ///< lines "NAME CHECKSUM"

// Attributes of the checksums.
inline constexpr char dimensions[] = "dimensions"; ///< of every field, slowest first
inline constexpr char tile_shape[] = "tile_shape";

/// The types of a field in the file and in memory, and the value of a point not computed yet.
struct StoredAs {
    hid_t file;
    hid_t memory;
    std::variant<std::uint8_t, std::uint16_t, std::uint32_t, double> fill;
};

inline StoredAs stored_as(Field field)
{
    const StoredAs by_type[std::variant_size_v<FieldValues>] = {
        {H5T_STD_U8LE, H5T_NATIVE_UINT8, status::not_computed},
        {H5T_STD_U16LE, H5T_NATIVE_UINT16, impact_count::not_computed},
        {H5T_STD_U32LE, H5T_NATIVE_UINT32, step_count::not_computed},
        {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, std::numeric_limits<double>::quiet_NaN()}};
    return by_type[std::size_t(traits_of(field).type)];
}

} // namespace overturn::layout
