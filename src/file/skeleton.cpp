// Creates a file in which no tile is computed, and computes its size.

#include "coordinate_variables.hpp"
#include "layout.hpp"
#include "netcdf.hpp"
#include "own_dataset.hpp"
#include "tile_access.hpp"
#include "working_file.hpp"

#include "overturn/file/spectrum_file.hpp"
#include "overturn/sweep/boundary.hpp"
#include "overturn/text/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <limits>

namespace overturn {

namespace {

using hdf5::check;
using hdf5::Handle;
using hdf5::write_attribute;
using layout::in_run_group;
using namespace netcdf;

/// Writes the value of points that are not computed to every chunk, so that a run only overwrites
/// existing values.
void write_not_computed(const StoredField& stored, const Problem& problem, const std::string& path,
                        const BetweenTiles& between_tiles)
{
    // Syncing regularly keeps the amount of unsynced data, and thus each wait for the disk, small.
    constexpr std::int64_t most_in_memory = 1 << 23; // [bytes]
    const Tiling tiling = tiling_of(problem);
    const std::int64_t count =
        count_points(stored_dimensions_of(stored.field, tiling.tile_shape(), stored.crossing));
    const std::int64_t bytes = count * std::int64_t(bytes_per_point(stored.field));
    const std::int64_t tiles_in_memory = std::max<std::int64_t>(1, most_in_memory / bytes);
    const FieldValues values = not_computed(stored.field, count); // of a whole chunk
    for (std::int64_t number = 0; number < tiling.size(); ++number) {
        between_tiles();
        write_chunk(stored, tiling[number], values);
        if ((number + 1) % tiles_in_memory == 0 && !sync(path)) {
            throw hdf5::Hdf5Error(system_reason(errno));
        }
    }
}

/// The values of the flags, in the type of the field, and their meanings.
void write_flags(hid_t dataset, Field field)
{
    const FieldTraits& traits = traits_of(field);
    if (traits.flags.empty()) {
        return;
    }
    std::visit(
        [&]<class Value>(Value) {
            std::vector<Value> values;
            for (const FieldFlag& flag : traits.flags) {
                values.push_back(Value(flag.value));
            }
            write_attribute(dataset, traits.has_bits ? "flag_masks" : "flag_values", values);
        },
        layout::fill_value(field));
    std::vector<std::string_view> meanings;
    for (const FieldFlag& flag : traits.flags) {
        meanings.push_back(flag.meaning);
    }
    write_attribute(dataset, "flag_meanings", fmt::format("{}", fmt::join(meanings, " ")));
}

void write_field_attributes(hid_t dataset, Field field, const Scene& scene,
                            const std::string& coordinates)
{
    const FieldTraits& traits = traits_of(field);
    write_attribute(dataset, "long_name", traits.long_name);
    write_attribute(dataset, "units", traits.units);
    // Readers interpret NaN as missing, so it can be declared; a fill value declared on an integer
    // field would make them convert codes to floats.
    if (traits.type == FieldType::float64) {
        write_attribute(dataset, "_FillValue", std::numeric_limits<double>::quiet_NaN());
    }
    if (field == Field::flip_amplitude) {
        const FlipSearch search = flip_search(scene);
        write_attribute(dataset, "width", search.flip_width);
        write_attribute(dataset, "finest_step", search.finest_step);
    }
    write_flags(dataset, field);
    write_attribute(dataset, "comment", traits.comment);
    write_attribute(dataset, "coordinates", coordinates);
}

/// coordinates: names of the auxiliary ones.
StoredField add_field(hid_t file, Field field, const Problem& problem,
                      const std::string& coordinates)
{
    const std::size_t crossing = place_of_crossing(problem);
    const Shape tile = stored_dimensions_of(field, tiling_of(problem).tile_shape(), crossing);
    const hdf5::Extents chunk(tile.begin(), tile.end());
    const Handle creation = dataset_creation();
    if (chunk.empty()) { // a single value
        check(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY));
    } else {
        check(H5Pset_chunk(creation, int(chunk.size()), chunk.data()));
    }
    const hdf5::Type type = layout::type_of(field);
    std::visit([&](auto value) { check(H5Pset_fill_value(creation, type.memory, &value)); },
               layout::fill_value(field));
    Handle dataset =
        create_dataset(file, std::string(name_of(field)), type.file,
                       stored_dimensions_of(field, stored_dimensions(problem), crossing), creation);
    write_field_attributes(dataset, field, problem.scene, coordinates);
    return {field, std::move(dataset), crossing};
}

/// Numbers of the group `run`, all 0.
Handle add_numbers(hid_t file, const char* name, const Dimensions& along, const char* long_name)
{
    const Handle creation = dataset_creation();
    check(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY));
    check(H5Pset_fill_time(creation, H5D_FILL_TIME_ALLOC));
    Handle dataset = create_dataset(file, in_run_group(name), H5T_STD_U64LE, along, creation);
    write_attribute(dataset, "long_name", long_name);
    return dataset;
}

void add_checksums(hid_t file, const Problem& problem)
{
    const Tiling tiling = tiling_of(problem);
    const StoredDimension tiles{in_run_group("tile"), tiling.size()};
    add_bare_dimension(file, tiles);
    const Handle dataset =
        add_numbers(file, layout::checksum, {tiles}, "checksum of the tile, 0 if not computed");
    write_attribute(dataset, "algorithm",
                    fmt::format("xxHash64, seed 0, over the stored values of the tile, field by "
                                "field in the order of the variables{}; a hash of 0 is stored as 1",
                                problem.numerics.fill ? ", audit_checked and audit_wrong" : ""));
    write_attribute(dataset, "numbering",
                    "tiles are boxes of tile_shape, smaller at the far edges, in the order of "
                    "`dimensions`; the last varies fastest");
    if (!tiling.shape().empty()) {
        std::vector<std::string> names;
        for (const StoredDimension& dimension : stored_dimensions(problem)) {
            names.push_back(dimension.name);
        }
        write_attribute(dataset, layout::dimensions, fmt::format("{}", fmt::join(names, " ")));
        write_attribute(dataset, layout::tile_shape, tiling.tile_shape());
    }
    if (problem.numerics.fill) {
        add_numbers(file, layout::audit_checked, {tiles},
                    "number of filled points of the tile that were integrated as well");
        add_numbers(file, layout::audit_wrong, {tiles},
                    "number of checked points whose integrated value differs from the filled one; "
                    "if there is one, all points of the tile were integrated");
    }
}

/// Adds the coordinates and their checksums. Returns the names of those that are not dimensions
/// ("auxiliary" in the CF conventions).
std::string add_coordinates(hid_t file, const Job& job)
{
    std::vector<std::string> auxiliary;
    std::string checksums;
    constexpr std::uint64_t any_size = std::numeric_limits<std::uint64_t>::max();
    for (CoordinateVariable& coordinate : coordinate_variables_of(job)) {
        netcdf::Variable& variable = coordinate.variable;
        variable.values = coordinate.values();
        add_variable(file, variable);
        checksums +=
            fmt::format("{} {}\n", variable.name,
                        dataset_checksum(hdf5::open_dataset(file, variable.name), any_size));
        if (!variable.is_dimension()) {
            auxiliary.push_back(variable.name);
        }
    }
    add_text(file, in_run_group(layout::coordinate_checksums), checksums,
             "checksums of the coordinates, XXH64 of shape and values");
    return fmt::format("{}", fmt::join(auxiliary, " "));
}

void write_skeleton(hid_t file, const std::string& path, const Job& job,
                    const BetweenTiles& between_tiles)
{
    const Problem& problem = job.problem;
    const Numerics& numerics = problem.numerics;
    if (problem.product == Product::spectrum) { // a boundary settles every verdict
        write_attribute(file, "method", name_of(numerics.method));
        write_attribute(file, "tolerance", numerics.tolerance);
        write_attribute(file, "resolve", numerics.resolve ? "true" : "false");
        if (numerics.fill) {
            write_attribute(file, "fill", "true");
            write_attribute(file, "audit", numerics.audit);
        }
    }
    // The token is the first dataset, so that it is within any limit of file sizes.
    write_attribute(add_numbers(file, layout::run_token, {}, "random number of the ranks, or 0"),
                    "comment", "used by the ranks to check at the start that they share the file");
    const std::string auxiliary = add_coordinates(file, job);
    for (const Field field : problem.fields) {
        write_not_computed(add_field(file, field, problem, auxiliary), problem, path,
                           between_tiles);
    }
    add_checksums(file, problem);
}

} // namespace

// Values, coordinates, checksums and texts are counted exactly. The overhead of HDF5 was measured
// on files of 1 to 390625 tiles: 18 KB per file, 1 KB per field, 0.6 KB per coordinate and each of
// its dimensions, and in the chunk index of a field one node per 56 tiles (rounded up here). A node
// is a B-tree of 64 children: a header of 24 bytes, 64 addresses, and 65 keys with a size, a mask
// and a number per dimension and one more, which are 3656 bytes for four dimensions.
long double spectrum_file_bytes(const Job& job)
{
    const Problem& problem = job.problem;
    const Tiling tiling = tiling_of(problem);
    using Count = long double;
    const auto tiles = Count(tiling.size());
    // Tiles at the far edges occupy whole chunks.
    const Count points = tiles * Count(tiling.points_of_tile());

    Count bytes = 20480 + (problem.numerics.fill ? 3 * tiles : tiles) * sizeof(double);
    if (problem.numerics.fill) {
        bytes += 1200;
    }
    for (const CoordinateVariable& coordinate : coordinate_variables_of(job)) {
        const netcdf::Variable& variable = coordinate.variable;
        Count bytes_of_values =
            std::visit([](const auto& values) { return Count(sizeof values[0]); }, variable.values);
        for (const StoredDimension& dimension : variable.dimensions) {
            bytes_of_values *= Count(dimension.size);
        }
        bytes += 600 + 600 * Count(variable.dimensions.size()) + bytes_of_values;
    }
    for (const Motion& motion : job.motions) {
        bytes += Count(record_text(motion).size());
    }
    const auto rank = Count(tiling.shape().size());
    const Count node = 24 + 64 * 8 + 65 * (8 + 8 * (rank + 1));
    for (const Field field : problem.fields) {
        bytes +=
            1200 + node * Count(tiling.size() / 55 + 2) + points * Count(bytes_per_point(field));
    }
    for (const std::string& setting : job.overrides) {
        bytes += Count(setting.size() + 1);
    }
    return bytes + Count(2 * job.title.size() + job.given.size() + job.resolved.size());
}

void create_spectrum_file(const std::string& path, const Job& job,
                          const BetweenTiles& between_tiles)
{
    PartFile part(path);
    const long double needed = spectrum_file_bytes(job);
    const std::uint64_t available = part.available_bytes();
    if (needed > static_cast<long double>(available)) {
        throw Error(exit_code::output,
                    "cannot create \"{}\": it takes {:.0f} bytes, but {} are available. "
                    "Free some space, choose another disk with -o, or reduce the number of "
                    "points or fields.",
                    path, needed, available);
    }
    try {
        make_file(part.path(), job, FileKind(job.problem.product),
                  [&](hid_t file) { write_skeleton(file, part.path(), job, between_tiles); });
    } catch (const hdf5::Hdf5Error& error) {
        throw Error(exit_code::output,
                    "cannot create \"{}\" of {:.0f} bytes: {}. Choose another name with "
                    "-o.",
                    path, needed, error.what());
    }
    part.move_into_place();
}

} // namespace overturn
