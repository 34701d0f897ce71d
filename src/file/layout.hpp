// The layout of result files: names and types, shared by writers and readers.
#pragma once

#include "hdf5_handles.hpp"

#include "overturn/problem/fields.hpp"

#include <cstdint>
#include <string>
#include <variant>

namespace overturn::layout {

/// Global attribute: the version of the layout. Other versions are refused.
inline constexpr char format_version[] = "format_version";
inline constexpr std::int64_t format = 5;
/// Read as well: the field friction_demand is called friction there.
inline constexpr std::int64_t former_format = 4;

/// The name of an object in the group of what is neither a coordinate nor a field: how the file was
/// computed. Readers that open the root group, such as xarray.open_dataset(), do not see it.
inline std::string in_run_group(const std::string& name)
{
    return "run/" + name;
}

/// Global attribute: "floor" if the motion is that of a floor; otherwise it is absent.
inline constexpr char motion_of[] = "motion_of";

/// Global attributes of a part of a job: 3 and 16 for part 3 of 16.
inline constexpr char part_number[] = "part";
inline constexpr char part_count[] = "parts";

// In the group `run`.
inline constexpr char run_token[] = "run_token";
inline constexpr char checksum[] = "checksum";
inline constexpr char audit_checked[] = "audit_checked"; ///< of a filled spectrum, like the next
inline constexpr char audit_wrong[] = "audit_wrong";
inline constexpr char job_resolved[] = "job_resolved";
inline constexpr char coordinate_checksums[] = "coordinate_checksums"; ///< lines "NAME CHECKSUM"
inline constexpr char skeleton[] = "skeleton"; ///< of a part: the bytes of the file without tiles

// Attributes of the checksums.
inline constexpr char dimensions[] = "dimensions"; ///< of every field, slowest first
inline constexpr char tile_shape[] = "tile_shape";

/// Attribute of the skeleton.
inline constexpr char skeleton_checksum[] = "checksum";

inline hdf5::Type type_of(Field field)
{
    return std::visit([](auto value) { return hdf5::Type::of(value); }, fill_value(field));
}

} // namespace overturn::layout
