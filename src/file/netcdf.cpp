#include "netcdf.hpp"

#include "layout.hpp"
#include "working_file.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/file/result_writer.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/mapped.hpp"

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
    write_attribute(file, layout::format_version, layout::format);
    write_attribute(file, "title", job.title);
    write_attribute(file, "kind", name_of(kind));
    write_attribute(file, "source", fmt::format("overturn {}", program_version()));
    write_attribute(file, "program_version", program_version());
    write_attribute(file, "program_commit", program_commit());
    write_attribute(file, "references",
                    "A. E. Charalampakis, G. C. Tsiatas, P. Tsopelas: Rocking of rigid blocks: "
                    "Analytical solution and exact energy-based overturning criteria");
    const Scene& scene = job.problem.scene;
    if (const auto pulse = scene.named_pulse()) {
        write_attribute(file, "pulse", pulse->name);
        for (const auto& [name, value] : pulse->numbers) {
            write_attribute(file, std::string(name).c_str(), value);
        }
    } else {
        const std::size_t count = job.motions.size();
        write_attribute(file, "record",
                        count == 1 ? job.motions.front().file : fmt::format("{} records", count));
        if (const auto raw = std::ranges::count_if(job.motions, &RecordedMotion::is_uncorrected)) {
            write_attribute(file, "record_processing",
                            count == 1 ? "not corrected"
                                       : fmt::format("{} of {} not corrected", raw, count));
        }
    }
    if (scene.motion_of != Scene().motion_of) {
        write_attribute(file, layout::motion_of, name_of(scene.motion_of));
    }
    write_attribute(file, "theory", name_of(scene.theory));
    if (Coordinates(scene, job.problem.grid).has("frequency_parameter")) {
        write_attribute(file, "gravity", scene.gravity);
    }
}

/// The rows as they are integrated.
void add_shape(hid_t file, const ShapeTable& table)
{
    const StoredDimension rows{layout::in_run_group("shape_phase"), table.shape->samples()};
    add_variable(
        file, {rows.name, {rows}, table.shape->phases(), "phase of the rows of the pulse", "rad"});
    add_variable(file,
                 {layout::in_run_group("shape_value"),
                  {rows},
                  table.shape->horizontal(),
                  "ground acceleration over its peak",
                  "1",
                  fmt::format("of the pulse; values of the table divided by {}", table.peak)});
}

void add_job(hid_t file, const Job& job)
{
    using layout::in_run_group;
    add_text(file, in_run_group("job_given"), job.given, "job file as given");
    add_text(file, in_run_group("job_overrides"), fmt::format("{}", fmt::join(job.overrides, "\n")),
             "overrides of the job file, one per line");
    add_text(file, in_run_group(layout::job_resolved), job.resolved, "job with all defaults");
    if (job.shape) {
        add_shape(file, *job.shape);
    }
    std::string records;
    for (const RecordedMotion& motion : job.motions) {
        records += record_text(motion);
    }
    add_text(file, in_run_group("records"), records,
             job.problem.scene.worded("files of the recorded ground motions, with their headers"));
}

/// Creates a dataset that is not a dimension yet and has none.
Handle create_values(hid_t file, const std::string& name, hid_t type, const Dimensions& dimensions,
                     hid_t creation)
{
    const hdf5::Extents shape =
        mapped(dimensions, [](const StoredDimension& each) { return hsize_t(each.size); });
    return Handle(H5Dcreate2(file, name.c_str(), type, hdf5::space_of(shape), H5P_DEFAULT, creation,
                             H5P_DEFAULT),
                  H5Dclose);
}

} // namespace

Handle dataset_creation()
{
    Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    check(H5Pset_attr_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED));
    check(H5Pset_obj_track_times(creation, false));
    return creation;
}

Handle create_dataset(hid_t file, const std::string& name, hid_t type, const Dimensions& dimensions,
                      hid_t creation)
{
    Handle dataset = create_values(file, name, type, dimensions, creation);
    if (!dimensions.empty() && dimensions.front().name == name) {
        const std::string name_in_its_group = name.substr(name.rfind('/') + 1);
        check(H5DSset_scale(dataset, name_in_its_group.c_str()));
        return dataset;
    }
    unsigned position = 0;
    for (const StoredDimension& dimension : dimensions) {
        check(H5DSattach_scale(dataset, hdf5::open_dataset(file, dimension.name), position++));
    }
    return dataset;
}

void add_bare_dimension(hid_t file, const StoredDimension& dimension)
{
    const Handle creation = dataset_creation();
    check(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_LATE));
    const Handle dataset =
        create_values(file, dimension.name, H5T_IEEE_F32BE, {dimension}, creation);
    const std::string mark =
        fmt::format("This is a netCDF dimension but not a netCDF variable.{:10}", dimension.size);
    check(H5DSset_scale(dataset, mark.c_str()));
}

// Texts are arrays of characters, because HDF5 1.10 crashes when it reads a damaged heap of
// variable-length strings.
void add_variable(hid_t file, const Variable& variable)
{
    const bool is_text = std::holds_alternative<std::string>(variable.values);
    if (is_text) {
        add_bare_dimension(file, variable.dimensions.back());
    }
    const Handle dataset = std::visit(
        [&]<class List>(const List& values) {
            const hdf5::Type type = hdf5::Type::of(typename List::value_type());
            Handle created = create_dataset(file, variable.name, type.file, variable.dimensions,
                                            dataset_creation());
            check(H5Dwrite(created, type.memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
            return created;
        },
        variable.values);
    write_attribute(dataset, "long_name", variable.long_name);
    write_attribute(dataset, "units", variable.units);
    write_attribute(dataset, "comment", variable.comment);
    write_attribute(dataset, "_Encoding", is_text ? "utf-8" : "");
    if (!variable.code_names.empty()) {
        std::vector<std::uint8_t> codes(variable.code_names.size());
        std::iota(codes.begin(), codes.end(), std::uint8_t(0));
        write_attribute(dataset, "flag_values", codes);
        write_attribute(dataset, "flag_meanings",
                        fmt::format("{}", fmt::join(variable.code_names, " ")));
    }
}

void add_text(hid_t file, const std::string& name, const std::string& text,
              const std::string& long_name)
{
    if (!text.empty()) {
        add_variable(file,
                     {name, {{name + "_length", std::int64_t(text.size())}}, text, long_name});
    }
}

Handle add_numbers(hid_t file, const char* name, const Dimensions& along, const char* long_name)
{
    const Handle creation = dataset_creation();
    check(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY));
    check(H5Pset_fill_time(creation, H5D_FILL_TIME_ALLOC));
    Handle dataset =
        create_dataset(file, layout::in_run_group(name), H5T_STD_U64LE, along, creation);
    write_attribute(dataset, "long_name", long_name);
    return dataset;
}

void add_group(hid_t file, const char* name)
{
    const Handle creation = ordered_creation(H5P_GROUP_CREATE);
    Handle(H5Gcreate2(file, name, H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose).close();
}

std::string record_text(const RecordedMotion& motion)
{
    std::string text = motion.file;
    text += motion.component.empty() ? "" : ", component " + motion.component;
    text += motion.second.empty() ? "" : ", second component " + motion.second;
    text += motion.vertical.empty() ? "" : ", vertical " + motion.vertical;
    text += motion.is_uncorrected ? ", not corrected" : "";
    for (const std::string& line : motion.header) {
        text += "\n    " + line;
    }
    return text + "\n";
}

void write_file(const std::string& path, const Job& job, FileKind kind, const WriteContent& write)
{
    Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, ordered_creation(H5P_FILE_CREATE),
                          hdf5::file_access()),
                H5Fclose);
    write_origin(file, job, kind);
    add_group(file, "run");
    write(file);
    add_job(file, job);
    file.close();
}

void create_in_place(const std::string& path,
                     const std::function<void(const std::string& temporary)>& write)
{
    PartFile part(path);
    start_hdf5();
    try {
        write(part.path());
    } catch (const hdf5::Hdf5Error& error) {
        throw Error(exit_code::output, "cannot create \"{}\": {}. Choose another name with -o.",
                    path, error.what());
    }
    part.move_into_place();
}

void make_file(const std::string& path, const Job& job, FileKind kind, const WriteContent& write)
{
    create_in_place(path,
                    [&](const std::string& temporary) { write_file(temporary, job, kind, write); });
}

} // namespace overturn::netcdf
