// The file of which no tile is computed yet.

#include "attributes.hpp"
#include "field_attributes.hpp"
#include "hdf5_handles.hpp"
#include "layout.hpp"
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

using Shape = std::vector<hsize_t>;

// Readers of netCDF-4 want attributes and links in order of creation; times would make equal runs
// differ.
Handle file_creation()
{
    Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    const unsigned ordered = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;
    check(H5Pset_link_creation_order(creation, ordered));
    check(H5Pset_attr_creation_order(creation, ordered));
    check(H5Pset_obj_track_times(creation, false));
    return creation;
}

Handle dataset_creation()
{
    Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    check(H5Pset_attr_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED));
    check(H5Pset_obj_track_times(creation, false));
    return creation;
}

Handle create_dataset(hid_t file, const char* name, hid_t type, const Shape& shape, hid_t creation)
{
    const Handle space(H5Screate_simple(int(shape.size()), shape.data(), nullptr), H5Sclose);
    return Handle(H5Dcreate2(file, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                  H5Dclose);
}

void add_numbers(hid_t file, const char* name, const Shape& shape,
                 const std::vector<double>& values, const char* long_name, const char* units)
{
    const Handle dataset = create_dataset(file, name, H5T_IEEE_F64LE, shape, dataset_creation());
    check(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
    write_attribute(dataset, "long_name", long_name);
    write_attribute(dataset, "units", units);
}

/// Makes the named variable the coordinate of the dimension of its name.
void make_dimension(hid_t file, const char* name)
{
    const Handle dataset(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
    check(H5DSset_scale(dataset, name));
}

/// Names the dimensions of a dataset, slowest first.
template <class Names>
void attach_dimensions(hid_t file, hid_t dataset, const Names& names)
{
    unsigned position = 0;
    for (const char* name : names) {
        const Handle scale(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
        check(H5DSattach_scale(dataset, scale, position++));
    }
}

void add_axes(hid_t file, const Plane& plane, Theory theory)
{
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
    add("amplitude", plane.amplitude,
        theory == Theory::linear ? "peak ground acceleration, over g alpha"
                                 : "peak ground acceleration, over g tan(alpha)",
        "1");
    add("frequency", plane.frequency, "pulse frequency, over the block's frequency parameter p",
        "1");

    const Handle restitution(H5Dopen2(file, "restitution", H5P_DEFAULT), H5Dclose);
    write_attribute(restitution, "of", name_of(plane.restitution_of));
}

/// A dimension without a variable, in the words of netCDF-4. Its dataset takes no space.
void add_bare_dimension(hid_t file, const std::string& name, std::int64_t length)
{
    const Handle creation = dataset_creation();
    check(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_LATE));
    const Handle dataset =
        create_dataset(file, name.c_str(), H5T_IEEE_F32BE, {hsize_t(length)}, creation);
    const std::string mark =
        fmt::format("This is a netCDF dimension but not a netCDF variable.{:10}", length);
    check(H5DSset_scale(dataset, mark.c_str()));
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

/// Allocates and fills every chunk at once: all that a run does later is to overwrite values.
void add_field(hid_t file, Field field, const Plane& plane, const Tiling& tiling)
{
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
    attach_dimensions(file, dataset, layout::dimensions);
    write_field_attributes(dataset, field);
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
                    "tiles are rectangles of amplitude and frequency at one slenderness and one "
                    "restitution, smaller at the far edges; frequency counts fastest, then "
                    "amplitude, restitution, slenderness");
    write_attribute(dataset, layout::amplitude_extent, tiling.amplitude_extent());
    write_attribute(dataset, layout::frequency_extent, tiling.frequency_extent());
}

/// Variables, because a compact attribute ends at 64 KiB and lists can be longer; arrays of
/// characters, because HDF5 1.10 crashes when it reads a damaged heap of variable-length strings.
/// An empty text is left out.
void add_text(hid_t file, const std::string& name, const std::string& text, const char* long_name)
{
    if (text.empty()) {
        return;
    }
    const std::string dimension = name + "_length";
    add_bare_dimension(file, dimension, std::int64_t(text.size()));
    const Handle dataset =
        create_dataset(file, name.c_str(), H5T_C_S1, {text.size()}, dataset_creation());
    check(H5Dwrite(dataset, H5T_C_S1, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()));
    attach_dimensions(file, dataset, std::array{dimension.c_str()});
    write_attribute(dataset, "long_name", long_name);
    write_attribute(dataset, "_Encoding", "utf-8");
}

void add_global_attributes(hid_t file, const Job& job)
{
    write_attribute(file, "Conventions", "CF-1.8");
    write_attribute(file, "title", job.title);
    write_attribute(file, "kind", layout::kind);
    write_attribute(file, "source", fmt::format("overturn {}", program_version()));
    write_attribute(file, "program_version", program_version());
    write_attribute(file, "program_commit", program_commit());
    write_attribute(file, "references",
                    "A. E. Charalampakis, G. C. Tsiatas, P. Tsopelas: Rocking of rigid blocks: "
                    "Analytical solution and exact energy-based overturning criteria");
    write_attribute(file, "pulse", name_of(job.scene.pulse));
    if (has_window(job.scene.pulse)) {
        write_attribute(file, "window", job.scene.window);
    }
    write_attribute(file, "theory", name_of(job.scene.theory));
    write_attribute(file, "method", name_of(job.numerics.method));
    write_attribute(file, "tolerance", job.numerics.tolerance);
    if (job.plane.block) {
        write_attribute(file, "half_width", job.plane.block->half_width);
        write_attribute(file, "half_height", job.plane.block->half_height);
        write_attribute(file, "comment", "half_width and half_height of the block are in metres");
    }
}

void write_skeleton(const std::string& path, const Job& job, const Tiling& tiling)
{
    Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, file_creation(), hdf5::file_access()),
                H5Fclose);
    add_global_attributes(file, job);
    add_axes(file, job.plane, job.scene.theory);
    add_bare_dimension(file, layout::tile, tiling.size());
    add_restitution_ratio(file, job.plane);
    for (const Field field : job.fields) {
        add_field(file, field, job.plane, tiling);
    }
    add_checksums(file, tiling);
    add_text(file, layout::job_given, job.given, "job file as given");
    add_text(file, layout::job_overrides, fmt::format("{}", fmt::join(job.overrides, "\n")),
             "settings laid over the job file, one per line");
    add_text(file, layout::job_resolved, job.resolved, "job as resolved, with every default");
    file.close();
}

} // namespace

void create_spectrum_file(const std::string& path, const Job& job, const Tiling& tiling)
{
    PartFile part(path);
    const std::uint64_t needed = spectrum_file_bytes(job, tiling);
    const std::uint64_t available = part.available_bytes();
    if (needed > available) {
        throw FileError(
            fmt::format("cannot create \"{}\": it takes {} bytes, and {} are available. "
                        "Free some, choose another disk with -o, or ask for fewer "
                        "points or fields.",
                        path, needed, available));
    }
    try {
        hdf5::start();
        write_skeleton(part.path(), job, tiling);
    } catch (const hdf5::Hdf5Error& error) {
        throw FileError(
            fmt::format("cannot create \"{}\" of {} bytes: {}. Choose another name with "
                        "-o.",
                        path, needed, error.what()));
    }
    part.move_into_place();
}

} // namespace overturn
