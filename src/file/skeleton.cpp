// The file of which no tile is computed yet.

#include "attributes.hpp"
#include "coordinates.hpp"
#include "field_attributes.hpp"
#include "hdf5_handles.hpp"
#include "layout.hpp"
#include "netcdf.hpp"
#include "part_file.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/file/spectrum_file.hpp"

#include <fmt/format.h>
#include <hdf5_hl.h>

namespace overturn {

namespace {

using hdf5::check;
using hdf5::Handle;
using hdf5::write_attribute;
using namespace netcdf;

void add_coordinates(hid_t file, const std::vector<Coordinate>& coordinates)
{
    for (const Coordinate& coordinate : coordinates) {
        add_numbers(file, coordinate.name, coordinate.shape, coordinate.values,
                    coordinate.long_name, coordinate.units);
        if (coordinate.is_dimension()) {
            make_dimension(file, coordinate.name);
        } else {
            const Handle dataset(H5Dopen2(file, coordinate.name, H5P_DEFAULT), H5Dclose);
            attach_dimensions(file, dataset, coordinate.dimensions);
        }
    }
}

/// In the words of CF, of the variables that have them beside their dimensions.
std::string names_of_auxiliary(const std::vector<Coordinate>& coordinates)
{
    std::string names;
    for (const Coordinate& coordinate : coordinates) {
        if (!coordinate.is_dimension()) {
            names += names.empty() ? "" : " ";
            names += coordinate.name;
        }
    }
    return names;
}

/// Allocates and fills every chunk at once: all that a run does later is to overwrite values.
void add_field(hid_t file, Field field, const Job& job, const Tiling& tiling,
               const std::string& coordinates)
{
    const Plane& plane = job.plane;
    const layout::StoredAs stored = layout::stored_as(field);
    const Shape shape{hsize_t(plane.slenderness.size()), hsize_t(plane.restitution.size()),
                      hsize_t(plane.amplitude.size()), hsize_t(plane.frequency.size())};
    const Shape chunk{1, 1, hsize_t(tiling.amplitude_extent()), hsize_t(tiling.frequency_extent())};

    const Handle creation = dataset_creation();
    check(H5Pset_chunk(creation, int(chunk.size()), chunk.data()));
    check(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY));
    check(H5Pset_fill_time(creation, H5D_FILL_TIME_ALLOC));
    std::visit([&](auto fill) { check(H5Pset_fill_value(creation, stored.memory, &fill)); },
               stored.fill);
    const Handle dataset =
        create_dataset(file, name_of(field).data(), stored.file, shape, creation);
    attach_dimensions(file, dataset, layout::dimensions_of(job.product));
    write_field_attributes(dataset, field, coordinates);
}

void add_checksums(hid_t file, const Tiling& tiling)
{
    const Handle creation = dataset_creation();
    check(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY));
    check(H5Pset_fill_time(creation, H5D_FILL_TIME_ALLOC));
    const Handle dataset =
        create_dataset(file, layout::checksum, H5T_STD_U64LE, {hsize_t(tiling.size())}, creation);
    attach_dimensions(file, dataset, std::array{layout::tile});
    write_attribute(dataset, "long_name", "checksum of the tile, 0 where it is not computed yet");
    write_attribute(dataset, "algorithm",
                    "xxHash64, seed 0, over the stored values of the tile, field by field in the "
                    "order of the variables; a hash of 0 is stored as 1");
    write_attribute(dataset, "numbering",
                    "tiles are rectangles of the last two dimensions at one slenderness and one "
                    "restitution, smaller at the far edges; the last dimension counts fastest");
    write_attribute(dataset, layout::amplitude_extent, tiling.amplitude_extent());
    write_attribute(dataset, layout::frequency_extent, tiling.frequency_extent());
}

void write_skeleton(const std::string& path, const Job& job, const Tiling& tiling)
{
    Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, file_creation(), hdf5::file_access()),
                H5Fclose);
    write_origin(file, job, layout::kind_of(job.product));
    if (job.product == Product::spectrum) { // a boundary settles every verdict
        write_attribute(file, "method", name_of(job.numerics.method));
        write_attribute(file, "tolerance", job.numerics.tolerance);
        write_attribute(file, "resolve", job.numerics.resolve ? "true" : "false");
    }
    const std::vector<Coordinate> coordinates = coordinates_of(job);
    add_coordinates(file, coordinates);
    const Handle restitution(H5Dopen2(file, "restitution", H5P_DEFAULT), H5Dclose);
    write_attribute(restitution, "of", name_of(job.plane.restitution_of));
    add_bare_dimension(file, layout::tile, tiling.size());
    for (const Field field : job.fields) {
        add_field(file, field, job, tiling, names_of_auxiliary(coordinates));
    }
    add_checksums(file, tiling);
    add_job(file, job);
    file.close();
}

} // namespace

void remove_half_made_file(const std::string& path)
{
    const PartFile removed(path);
}

void create_spectrum_file(const std::string& path, const Job& job, const Tiling& tiling)
{
    PartFile part(path);
    const long double needed = spectrum_file_bytes(job, tiling);
    const std::uint64_t available = part.available_bytes();
    if (needed > static_cast<long double>(available)) {
        throw FileError(
            fmt::format("cannot create \"{}\": it takes {:.0f} bytes, and {} are available. "
                        "Free some, choose another disk with -o, or ask for fewer "
                        "points or fields.",
                        path, needed, available));
    }
    try {
        hdf5::start();
        write_skeleton(part.path(), job, tiling);
    } catch (const hdf5::Hdf5Error& error) {
        throw FileError(
            fmt::format("cannot create \"{}\" of {:.0f} bytes: {}. Choose another name with "
                        "-o.",
                        path, needed, error.what()));
    }
    part.move_into_place();
}

} // namespace overturn
