// The layout of result files: names, dimensions and types, shared by writers and readers.
#pragma once

#include "hdf5_handles.hpp"

#include "overturn/file/spectrum_summary.hpp"
#include "overturn/sweep/fields.hpp"

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

/// Global attribute: the version of the layout. Files without it are of version 1: they have four
/// dimensions and the attributes amplitude_extent and frequency_extent.
inline constexpr char format_version[] = "format_version";
inline constexpr std::int64_t newest_format = 3;

/// The group of what is neither a coordinate nor a field: how the file was computed. Readers that
/// open the root group, such as xarray.open_dataset(), do not see it.
inline constexpr char run_group[] = "run";

/// The place of an object of the group `run`, which earlier formats had in the root group.
inline std::string in_run_group(const std::string& name, std::int64_t format = newest_format)
{
    return format < 3 ? name : std::string(run_group) + "/" + name;
}

// In the group `run`.
inline constexpr char scan_prefix[] = "scan_"; ///< followed by amplitude, scale or pga
inline constexpr char run_token[] = "run_token";
inline constexpr char checksum[] = "checksum";
inline constexpr char tile[] = "tile";
inline constexpr char job_resolved[] = "job_resolved";

// Attributes of the checksums.
inline constexpr char dimensions[] = "dimensions"; ///< of every field, slowest first
inline constexpr char tile_shape[] = "tile_shape";

/// The types of a field in the file and in memory, and the value of a point not computed yet.
struct StoredAs {
    hid_t file;
    hid_t memory;
    const char* name;
    std::variant<std::uint8_t, std::uint16_t, std::uint32_t, double> fill;
};

inline StoredAs stored_as(Field field)
{
    const StoredAs by_type[std::variant_size_v<FieldValues>] = {
        {H5T_STD_U8LE, H5T_NATIVE_UINT8, "uint8", status::not_computed},
        {H5T_STD_U16LE, H5T_NATIVE_UINT16, "uint16", impact_count::not_computed},
        {H5T_STD_U32LE, H5T_NATIVE_UINT32, "uint32", step_count::not_computed},
        {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, "float64", std::numeric_limits<double>::quiet_NaN()}};
    return by_type[make_field_values(field, 0).index()];
}

} // namespace overturn::layout
