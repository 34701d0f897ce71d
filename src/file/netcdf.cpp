#include "netcdf.hpp"

#include "layout.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/problem/coordinates.hpp"

#include <fmt/format.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <numeric>

namespace overturn::netcdf {

using hdf5::check;
using hdf5::Handle;
using hdf5::write_attribute;

namespace {

// netCDF-4 readers need attributes and links in the order of their creation. Times are not tracked,
// because they would differ between equal runs.
Handle ordered_creation(hid_t of_what)
{
    Handle creation(H5Pcreate(of_what), H5Pclose);
    const unsigned ordered = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;
    check(H5Pset_link_creation_order(creation, ordered));
    check(H5Pset_attr_creation_order(creation, ordered));
    check(H5Pset_obj_track_times(creation, false));
    return creation;
}

void write_origin(hid_t file, const Job& job, FileKind kind)
{
    write_attribute(file, "Conventions", "CF-1.8");
    write_attribute(file, layout::format_version, layout::newest_format);
    write_attribute(file, "title", job.title);
    write_attribute(file, "kind", layout::name_of(kind));
    write_attribute(file, "source", fmt::format("overturn {}", program_version()));
    write_attribute(file, "program_version", program_version());
    write_attribute(file, "program_commit", program_commit());
    write_attribute(file, "references",
                    "A. E. Charalampakis, G. C. Tsiatas, P. Tsopelas: Rocking of rigid blocks: "
                    "Analytical solution and exact energy-based overturning criteria");
    const Scene& scene = job.problem.scene;
    if (scene.is_recorded()) {
        const std::size_t count = job.motions.size();
        write_attribute(file, "record",
                        count == 1 ? job.motions.front().file : fmt::format("{} records", count));
    } else {
        write_attribute(file, "pulse", name_of(scene.pulse));
        for (const auto& [name, number] : shape_numbers) {
            if (has_number(scene.pulse, number)) {
                write_attribute(file, name.data(), scene.shape.*number);
            }
        }
    }
    write_attribute(file, "theory", name_of(scene.theory));
    if (Coordinates(scene, job.problem.grid).has("frequency_parameter")) {
        write_attribute(file, "gravity", scene.gravity);
    }
}

void add_job(hid_t file, const Job& job)
{
    using layout::in_run_group;
    add_text(file, in_run_group("job_given"), job.given, "job file as given");
    add_text(file, in_run_group("job_overrides"), fmt::format("{}", fmt::join(job.overrides, "\n")),
             "overrides of the job file, one per line");
    add_text(file, in_run_group(layout::job_resolved), job.resolved, "job with all defaults");
    std::string records;
    for (const Motion& motion : job.motions) {
        records += record_text(motion);
    }
    add_text(file, in_run_group("records"), records,
             "files of the recorded ground motions, with their headers");
}

/// A name without that of its group.
std::string in_its_group(const std::string& name)
{
    return name.substr(name.rfind('/') + 1);
}

/// Makes the dataset a dimension if it has the name of one, else attaches its dimensions.
void attach_or_make_dimension(hid_t file, hid_t dataset, const std::string& name,
                              const std::vector<std::string>& dimensions)
{
    if (!dimensions.empty() && dimensions.front() == name) {
        check(H5DSset_scale(dataset, in_its_group(name).c_str()));
    } else {
        attach_dimensions(file, dataset, dimensions);
    }
}

} // namespace

// As an array of characters, because HDF5 1.10 crashes when it reads a damaged heap of
// variable-length strings.
void add_text(hid_t file, const std::string& name, const std::string& text, const char* long_name)
{
    if (text.empty()) {
        return;
    }
    const std::string dimension = name + "_length";
    add_bare_dimension(file, dimension, std::int64_t(text.size()));
    const Handle dataset = create_dataset(file, name, H5T_C_S1, {text.size()}, dataset_creation());
    check(H5Dwrite(dataset, H5T_C_S1, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()));
    attach_dimensions(file, dataset, {dimension});
    write_attribute(dataset, "long_name", long_name);
    write_attribute(dataset, "_Encoding", "utf-8");
}

std::string record_text(const Motion& motion)
{
    std::string text = motion.file;
    text += motion.component.empty() ? "" : ", component " + motion.component;
    text += motion.vertical.empty() ? "" : ", vertical " + motion.vertical;
    for (const std::string& line : motion.header) {
        text += "\n    " + line;
    }
    return text + "\n";
}

Handle dataset_creation()
{
    Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    check(H5Pset_attr_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED));
    check(H5Pset_obj_track_times(creation, false));
    return creation;
}

Handle create_dataset(hid_t file, const std::string& name, hid_t type, const DatasetShape& shape,
                      hid_t creation)
{
    const Handle space(H5Screate_simple(int(shape.size()), shape.data(), nullptr), H5Sclose);
    return Handle(H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                  H5Dclose);
}

void attach_dimensions(hid_t file, hid_t dataset, const std::vector<std::string>& names)
{
    unsigned position = 0;
    for (const std::string& name : names) {
        check(H5DSattach_scale(dataset, hdf5::open_dataset(file, name), position++));
    }
}

void add_variable(hid_t file, const Variable& variable)
{
    const Handle dataset =
        create_dataset(file, variable.name, H5T_IEEE_F64LE, variable.shape, dataset_creation());
    check(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                   variable.values.data()));
    write_attribute(dataset, "long_name", variable.long_name);
    write_attribute(dataset, "units", variable.units);
    write_attribute(dataset, "comment", variable.comment);
    attach_or_make_dimension(file, dataset, variable.name, variable.dimensions);
}

void add_codes(hid_t file, const char* name, const char* dimension,
               const std::vector<std::uint8_t>& codes, const char* long_name,
               std::span<const std::string_view> names)
{
    std::vector<std::uint8_t> all(names.size());
    std::iota(all.begin(), all.end(), std::uint8_t(0));
    const Handle dataset =
        create_dataset(file, name, H5T_STD_U8LE, {codes.size()}, dataset_creation());
    check(H5Dwrite(dataset, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, codes.data()));
    write_attribute(dataset, "long_name", long_name);
    write_attribute(dataset, "flag_values", all);
    write_attribute(dataset, "flag_meanings", fmt::format("{}", fmt::join(names, " ")));
    attach_or_make_dimension(file, dataset, name, {dimension});
}

void add_names(hid_t file, const std::string& name, const std::string& dimension,
               const std::vector<std::string>& names, const char* long_name)
{
    std::size_t longest = 1;
    for (const std::string& text : names) {
        longest = std::max(longest, text.size());
    }
    std::string letters;
    for (const std::string& text : names) {
        letters += text + std::string(longest - text.size(), '\0');
    }
    add_bare_dimension(file, name + "_length", std::int64_t(longest));
    DatasetShape shape{longest};
    std::vector<std::string> dimensions{name + "_length"};
    if (!dimension.empty()) {
        shape.insert(shape.begin(), names.size());
        dimensions.insert(dimensions.begin(), dimension);
    }
    const Handle dataset = create_dataset(file, name, H5T_C_S1, shape, dataset_creation());
    check(H5Dwrite(dataset, H5T_C_S1, H5S_ALL, H5S_ALL, H5P_DEFAULT, letters.data()));
    attach_dimensions(file, dataset, dimensions);
    write_attribute(dataset, "long_name", long_name);
    write_attribute(dataset, "_Encoding", "utf-8");
}

void add_group(hid_t file, const char* name)
{
    const Handle creation = ordered_creation(H5P_GROUP_CREATE);
    Handle(H5Gcreate2(file, name, H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose).close();
}

void add_bare_dimension(hid_t file, const std::string& name, std::int64_t length)
{
    const Handle creation = dataset_creation();
    check(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_LATE));
    const Handle dataset = create_dataset(file, name, H5T_IEEE_F32BE, {hsize_t(length)}, creation);
    const std::string mark =
        fmt::format("This is a netCDF dimension but not a netCDF variable.{:10}", length);
    check(H5DSset_scale(dataset, mark.c_str()));
}

void make_file(const std::string& path, const Job& job, FileKind kind,
               const std::function<void(hid_t file)>& write)
{
    hdf5::start();
    Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, ordered_creation(H5P_FILE_CREATE),
                          hdf5::file_access()),
                H5Fclose);
    write_origin(file, job, kind);
    add_group(file, layout::run_group);
    write(file);
    add_job(file, job);
    file.close();
}

} // namespace overturn::netcdf
