// The file of which no tile is computed yet.

#include "attributes.hpp"
#include "field_attributes.hpp"
#include "hdf5_handles.hpp"
#include "layout.hpp"
#include "netcdf.hpp"
#include "part_file.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/file/spectrum_file.hpp"

#include <fmt/format.h>
#include <hdf5_hl.h>

#include <numbers>

namespace overturn {

namespace {

using hdf5::check;
using hdf5::Handle;
using hdf5::write_attribute;
using namespace netcdf;

void add_axes(hid_t file, const Job& job)
{
    const Plane& plane = job.plane;
    const auto add = [&](const char* name, const Axis& axis, const char* long_name,
                         const char* units) {
        add_numbers(file, name, {hsize_t(axis.size())}, axis.values(), long_name, units);
        make_dimension(file, name);
    };
    add("slenderness", plane.slenderness, "slenderness of the block, arctan(b/h)", "rad");
    const bool relative = plane.restitution_of == RestitutionOf::maximum;
    add("restitution", plane.restitution,
        relative ? "energy ratio at an impact, over the largest one of the block"
                 : "energy ratio at an impact",
        "1");
    if (job.product == Product::boundary) {
        add("crossing", plane.amplitude, "flips of the verdict along the amplitude, from 0", "1");
        add(layout::scan, job.scan, "amplitudes that were looked at to find the flips", "1");
    } else {
        add("amplitude", plane.amplitude,
            job.scene.theory == Theory::linear ? "peak ground acceleration, over g alpha"
                                               : "peak ground acceleration, over g tan(alpha)",
            "1");
    }
    add("frequency", plane.frequency, "pulse frequency, over the block's frequency parameter p",
        "1");

    const Handle restitution(H5Dopen2(file, "restitution", H5P_DEFAULT), H5Dclose);
    write_attribute(restitution, "of", name_of(plane.restitution_of));
}

void add_restitution_ratio(hid_t file, const Plane& plane)
{
    std::vector<double> values;
    for (std::int64_t i = 0; i < plane.slenderness.size(); ++i) {
        for (std::int64_t j = 0; j < plane.restitution.size(); ++j) {
            values.push_back(plane.restitution_ratio(i, j));
        }
    }
    const Shape shape{hsize_t(plane.slenderness.size()), hsize_t(plane.restitution.size())};
    add_numbers(file, layout::restitution_ratio, shape, values, "energy ratio at an impact, r",
                "1");
    const Handle dataset(H5Dopen2(file, layout::restitution_ratio, H5P_DEFAULT), H5Dclose);
    attach_dimensions(file, dataset, std::array{"slenderness", "restitution"});
}

/// Of a job that names its block in metres: coordinates in seconds and in g.
void add_dimensional_coordinates(hid_t file, const Job& job)
{
    const Plane& plane = job.plane;
    const double p = frequency_parameter(*plane.block);
    std::vector<double> periods;
    for (const double frequency : plane.frequency.values()) {
        periods.push_back(2 * std::numbers::pi / (frequency * p));
    }
    const auto add = [&](const char* name, const char* dimension, const std::vector<double>& values,
                         const char* long_name, const char* units) {
        add_numbers(file, name, {values.size()}, values, long_name, units);
        const Handle dataset(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
        attach_dimensions(file, dataset, std::array{dimension});
    };
    add(layout::pulse_period, "frequency", periods,
        "period of the pulse, 2 pi / omega_p, where g is 9.81 m/s2", "s");
    if (job.product == Product::boundary) {
        return; // it has no amplitudes but the flips
    }
    const double alpha = plane.slenderness.first();
    const double threshold = job.scene.theory == Theory::linear
                                 ? uplift_acceleration<Theory::linear>(alpha)
                                 : uplift_acceleration<Theory::nonlinear>(alpha);
    std::vector<double> accelerations;
    for (const double amplitude : plane.amplitude.values()) {
        accelerations.push_back(amplitude * threshold);
    }
    add(layout::peak_ground_acceleration, "amplitude", accelerations,
        "peak ground acceleration, over g", "1");
}

std::string coordinates_of(const Job& job)
{
    std::string names = layout::restitution_ratio;
    if (job.plane.block) {
        names += std::string(" ") + layout::pulse_period;
        if (job.product == Product::spectrum) {
            names += std::string(" ") + layout::peak_ground_acceleration;
        }
    }
    return names;
}

/// Allocates and fills every chunk at once: all that a run does later is to overwrite values.
void add_field(hid_t file, Field field, const Job& job, const Tiling& tiling)
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
    write_field_attributes(dataset, field, coordinates_of(job));
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
    add_axes(file, job);
    add_bare_dimension(file, layout::tile, tiling.size());
    add_restitution_ratio(file, job.plane);
    if (job.plane.block) {
        add_dimensional_coordinates(file, job);
    }
    for (const Field field : job.fields) {
        add_field(file, field, job, tiling);
    }
    add_checksums(file, tiling);
    add_job(file, job);
    file.close();
}

} // namespace

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
