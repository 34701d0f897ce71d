// Creates a file in which no tile is computed, and computes its size.

#include "attributes.hpp"
#include "coordinates.hpp"
#include "field_attributes.hpp"
#include "hdf5_handles.hpp"
#include "layout.hpp"
#include "netcdf.hpp"
#include "operating_system.hpp"
#include "tile_access.hpp"
#include "working_file.hpp"

#include "overturn/file/spectrum_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>

namespace overturn {

namespace {

using hdf5::check;
using hdf5::Handle;
using hdf5::write_attribute;
using namespace netcdf;

std::vector<std::string> names_of(const std::vector<Dimension>& dimensions)
{
    std::vector<std::string> names;
    for (const Dimension& dimension : dimensions) {
        names.push_back(dimension.name);
    }
    return names;
}

/// Variables of names along one dimension.
struct Names {
    std::string name;
    std::string dimension;
    std::vector<std::string> values;
    const char* long_name;
};

/// The files of the motions, and the texts of the table.
std::vector<Names> names_of(const Job& job)
{
    std::vector<Names> all;
    if (job.scene.is_recorded()) {
        all.push_back({"motion_name", "motion", {}, "file of the recorded ground motion"});
        for (const Motion& motion : job.motions) {
            all.back().values.push_back(motion.name);
        }
    }
    if (job.blocks) {
        for (const TableColumn& column : job.blocks->table->columns) {
            if (!column.texts.empty()) {
                all.push_back({column.name, "block", column.texts, "column of the table"});
            }
        }
    }
    return all;
}

/// The coordinates that are not dimensions ("auxiliary" in the CF conventions).
std::string names_of_auxiliary(const std::vector<Coordinate>& coordinates,
                               const std::vector<Names>& texts)
{
    std::vector<std::string> names;
    for (const Coordinate& coordinate : coordinates) {
        if (!coordinate.is_dimension()) {
            names.push_back(coordinate.name);
        }
    }
    for (const Names& text : texts) {
        names.push_back(text.name);
    }
    return fmt::format("{}", fmt::join(names, " "));
}

/// Writes fill values to every chunk, so that a run only overwrites existing values.
void fill(hid_t dataset, Field field, const Tiling& tiling, const std::string& path,
          const BetweenTiles& between_tiles)
{
    // Syncing regularly keeps the amount of unsynced data, and thus each wait for the disk, small.
    constexpr std::int64_t most_in_memory = 1 << 23; // [bytes]
    const std::int64_t count =
        is_of_line(field) ? tiling.tile_shape().back() : tiling.points_of_tile();
    const std::int64_t bytes = count * std::int64_t(bytes_per_point(field));
    const std::int64_t tiles_in_memory = std::max<std::int64_t>(1, most_in_memory / bytes);
    const FieldValues values = not_computed(field, count);
    for (std::int64_t number = 0; number < tiling.size(); ++number) {
        between_tiles();
        write_chunk(dataset, tiling[number], field, values);
        if ((number + 1) % tiles_in_memory == 0 && !sync(path)) {
            throw hdf5::Hdf5Error(system_reason(errno));
        }
    }
}

Handle add_field(hid_t file, Field field, const Job& job, const Tiling& tiling,
                 const std::string& coordinates)
{
    const layout::StoredAs stored = layout::stored_as(field);
    const auto of_field = [&](const Shape& of_points) {
        return dimensions_of(field, DatasetShape(of_points.begin(), of_points.end()));
    };
    const DatasetShape shape = of_field(tiling.shape());
    const DatasetShape chunk = of_field(tiling.tile_shape());

    const Handle creation = dataset_creation();
    check(H5Pset_chunk(creation, int(chunk.size()), chunk.data()));
    std::visit([&](auto fill) { check(H5Pset_fill_value(creation, stored.memory, &fill)); },
               stored.fill);
    Handle dataset =
        create_dataset(file, std::string(name_of(field)), stored.file, shape, creation);
    attach_dimensions(file, dataset, dimensions_of(field, names_of(dimensions_of(job))));
    write_field_attributes(dataset, field, job, coordinates);
    return dataset;
}

Handle early_allocated()
{
    Handle creation = dataset_creation();
    check(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY));
    check(H5Pset_fill_time(creation, H5D_FILL_TIME_ALLOC));
    return creation;
}

void add_run_token(hid_t file)
{
    const Handle dataset = create_dataset(file, layout::in_run_group(layout::run_token),
                                          H5T_STD_U64LE, {}, early_allocated());
    write_attribute(dataset, "long_name", "random number of the ranks, or 0");
    write_attribute(dataset, "comment",
                    "used by the ranks to check at the start that they share the file");
}

/// A number per tile, along the dimension of the checksums.
Handle add_numbers(hid_t file, const char* name, const Tiling& tiling, const char* long_name)
{
    using layout::in_run_group;
    Handle dataset = create_dataset(file, in_run_group(name), H5T_STD_U64LE,
                                    {hsize_t(tiling.size())}, early_allocated());
    attach_dimensions(file, dataset, {in_run_group(layout::tile)});
    write_attribute(dataset, "long_name", long_name);
    return dataset;
}

void add_checksums(hid_t file, const Job& job, const Tiling& tiling)
{
    using layout::in_run_group;
    add_bare_dimension(file, in_run_group(layout::tile), tiling.size());
    const Handle dataset =
        add_numbers(file, layout::checksum, tiling, "checksum of the tile, 0 if not computed");
    write_attribute(dataset, "algorithm",
                    fmt::format("xxHash64, seed 0, over the stored values of the tile, field by "
                                "field in the order of the variables{}; a hash of 0 is stored as 1",
                                job.numerics.fill ? ", audit_checked and audit_wrong" : ""));
    write_attribute(dataset, "numbering",
                    "tiles are boxes of tile_shape, smaller at the far edges, in the order of "
                    "`dimensions`; the last varies fastest");
    write_attribute(dataset, layout::dimensions,
                    fmt::format("{}", fmt::join(names_of(dimensions_of(job)), " ")));
    write_attribute(dataset, layout::tile_shape, tiling.tile_shape());
    if (job.numerics.fill) {
        add_numbers(file, layout::audit_checked, tiling,
                    "number of filled points of the tile that were integrated as well");
        add_numbers(file, layout::audit_wrong, tiling,
                    "number of checked points whose integrated value differs from the filled one; "
                    "if there is one, all points of the tile were integrated");
    }
}

void write_skeleton(hid_t file, const std::string& path, const Job& job, const Tiling& tiling,
                    const BetweenTiles& between_tiles)
{
    if (job.product == Product::spectrum) { // a boundary settles every verdict
        write_attribute(file, "method", name_of(job.numerics.method));
        write_attribute(file, "tolerance", job.numerics.tolerance);
        write_attribute(file, "resolve", job.numerics.resolve ? "true" : "false");
        if (job.numerics.fill) {
            write_attribute(file, "fill", "true");
            write_attribute(file, "audit", job.numerics.audit);
        }
    }
    add_run_token(file); // first, so that it is within any limit of file sizes
    const std::vector<Coordinate> coordinates = coordinates_of(job);
    for (const Coordinate& coordinate : coordinates) {
        add_variable(file, coordinate);
    }
    const std::vector<Names> texts = names_of(job);
    for (const Names& text : texts) {
        add_names(file, text.name, text.dimension, text.values, text.long_name);
    }
    if (!job.blocks) {
        write_attribute(hdf5::open_dataset(file, "restitution"), "of",
                        name_of(job.plane.restitution_of));
    }
    for (const Field field : job.fields) {
        fill(add_field(file, field, job, tiling, names_of_auxiliary(coordinates, texts)), field,
             tiling, path, between_tiles);
    }
    add_checksums(file, job, tiling);
}

/// The columns of the table, and at most six derived from them. A variable without its values takes
/// 600 bytes, with one more for each dimension.
long double bytes_of_blocks(const BlockTable& blocks, const BlockList& list)
{
    using Count = long double;
    const auto rows = Count(list.size);
    Count bytes = 6 * (1200 + rows * sizeof(double));
    for (const TableColumn& column : blocks.table->columns) {
        std::size_t longest = sizeof(double);
        for (const std::string& text : column.texts) {
            longest = std::max(longest, text.size());
        }
        bytes += 1800 + rows * Count(longest);
    }
    return bytes;
}

} // namespace

// Values, coordinates, checksums and texts are counted exactly. The overhead of HDF5 was measured
// on files of 1 to 390625 tiles: 18 KB per file, 1 KB per field, and in the chunk index of a field
// one node of 3656 bytes per 56 tiles (rounded up here).
long double spectrum_file_bytes(const Job& job, const Tiling& tiling)
{
    const Plane& plane = job.plane;
    using Count = long double;
    const auto tiles = Count(tiling.size());
    // Tiles at the far edges occupy whole chunks.
    const Count points = tiles * Count(tiling.points_of_tile());
    Count numbers = job.numerics.fill ? 3 * tiles : tiles;
    if (!plane.list) {
        numbers += Count(plane.slenderness.size() * plane.restitution.size());
    }
    for (const std::int64_t size : tiling.shape()) {
        numbers += Count(size);
    }

    Count bytes = 20480 + numbers * sizeof(double);
    if (job.numerics.fill) {
        bytes += 1200;
    }
    if (plane.motions > 0) {
        const Count motions(plane.motions);
        bytes +=
            9600 + (motions * (6 + Count(plane.amplitude.size())) + Count(plane.frequency.size())) *
                       sizeof(double);
        std::size_t longest = 1;
        for (const Motion& motion : job.motions) {
            bytes += Count(record_text(motion).size());
            longest = std::max(longest, motion.name.size());
        }
        bytes += motions * Count(longest);
    } else if (plane.size) {
        bytes += 2400 + (Count(plane.frequency.size()) +
                         Count(plane.slenderness.size() * plane.amplitude.size())) *
                            sizeof(double);
    }
    if (job.blocks) {
        bytes += bytes_of_blocks(*job.blocks, *plane.list);
    }
    if (job.product == Product::boundary) {
        bytes += 1200 + Count(job.scan.size()) * sizeof(double);
    }
    for (const Field field : job.fields) {
        bytes +=
            1200 + 3656 * Count(tiling.size() / 55 + 2) + points * Count(bytes_per_point(field));
    }
    for (const std::string& setting : job.overrides) {
        bytes += Count(setting.size() + 1);
    }
    return bytes + Count(2 * job.title.size() + job.given.size() + job.resolved.size());
}

void create_spectrum_file(const std::string& path, const Job& job, const Tiling& tiling,
                          const BetweenTiles& between_tiles)
{
    PartFile part(path);
    const long double needed = spectrum_file_bytes(job, tiling);
    const std::uint64_t available = part.available_bytes();
    if (needed > static_cast<long double>(available)) {
        throw FileError(
            fmt::format("cannot create \"{}\": it takes {:.0f} bytes, but {} are available. "
                        "Free some space, choose another disk with -o, or reduce the number of "
                        "points or fields.",
                        path, needed, available));
    }
    try {
        make_file(part.path(), job, FileKind(job.product), [&](hid_t file) {
            write_skeleton(file, part.path(), job, tiling, between_tiles);
        });
    } catch (const hdf5::Hdf5Error& error) {
        throw FileError(
            fmt::format("cannot create \"{}\" of {:.0f} bytes: {}. Choose another name with "
                        "-o.",
                        path, needed, error.what()));
    }
    part.move_into_place();
}

} // namespace overturn
