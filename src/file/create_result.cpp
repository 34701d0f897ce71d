#include "overturn/file/result_writer.hpp"

#include "coordinate_variables.hpp"
#include "layout.hpp"
#include "netcdf.hpp"
#include "own_dataset.hpp"
#include "tile_layout.hpp"
#include "working_file.hpp"

#include "overturn/sweep/boundary.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/mapped.hpp"

#include <fmt/ranges.h>

#include <fstream>
#include <iterator>
#include <limits>

namespace overturn {

using hdf5::check;
using hdf5::Handle;
using hdf5::write_attribute;
using layout::in_run_group;
using namespace netcdf;

namespace {

/// The values of the flags, in the type of the field, and their meanings.
void write_flags(hid_t dataset, Field field)
{
    const FieldTraits& traits = traits_of(field);
    const std::vector<std::uint32_t> values = mapped(traits.flags, &FieldFlag::value);
    const std::vector<std::string_view> meanings = mapped(traits.flags, &FieldFlag::meaning);
    if (!values.empty()) {
        write_attribute(dataset, traits.has_bits ? "flag_masks" : "flag_values",
                        {layout::type_of(field).file, H5T_NATIVE_UINT32}, {values.size()},
                        values.data());
        write_attribute(dataset, "flag_meanings", fmt::format("{}", fmt::join(meanings, " ")));
    }
}

/// What is known of a field in a result: of a boundary along another quantity than the strength,
/// the unit of this, and texts that do not mention strengths.
FieldTraits traits_in(const Problem& problem, Field field)
{
    FieldTraits traits = traits_of(field);
    const Boundaries* boundaries = problem.product.boundaries();
    if (boundaries == nullptr || boundaries->along == nullptr) {
        return traits;
    }
    if (field == Field::flip_value) {
        traits.units = boundaries->along->units;
    } else if (field == Field::region_below) {
        traits.comment = "if there is no flip, the first entry along `crossing` has the region at "
                         "the first value of the scan";
    } else if (field == Field::unsafe_share) {
        traits.long_name = "share of values that overturn";
    } else if (field == Field::undecided_share) {
        traits.long_name = "share of values without verdict";
    }
    return traits;
}

void write_field_attributes(hid_t dataset, Field field, const Problem& problem,
                            const std::string& coordinates)
{
    const Scene& scene = problem.scene;
    const FieldTraits traits = traits_in(problem, field);
    write_attribute(dataset, "long_name", scene.worded(traits.long_name));
    write_attribute(dataset, "units", traits.units);
    // Readers interpret NaN as missing, so it can be declared; a fill value declared on an integer
    // field would make them convert codes to floats.
    std::visit(
        [&]<class Value>(Value value) {
            if constexpr (std::floating_point<Value>) {
                write_attribute(dataset, "_FillValue", value);
            }
        },
        fill_value(field));
    if (field == Field::flip_amplitude || field == Field::flip_value) {
        const FlipSearch search = flip_search(scene, problem.grid.may_slip());
        write_attribute(dataset, "width", search.flip_width);
        write_attribute(dataset, "finest_step", search.finest_step);
    }
    write_flags(dataset, field);
    write_attribute(dataset, "comment", scene.worded(traits.comment));
    write_attribute(dataset, "coordinates", coordinates);
}

/// coordinates: names of the auxiliary ones.
void add_field(hid_t file, Field field, const Problem& problem, const std::string& coordinates)
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
               fill_value(field));
    const Handle dataset =
        create_dataset(file, std::string(name_of(field)), type.file,
                       stored_dimensions_of(field, stored_dimensions(problem), crossing), creation);
    write_field_attributes(dataset, field, problem, coordinates);
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

/// All but the tiles.
void write_skeleton(hid_t file, const Job& job)
{
    const Problem& problem = job.problem;
    const Numerics& numerics = problem.numerics;
    if (problem.product.has_settings()) { // a boundary settles every verdict
        write_attribute(file, "method", name_of(numerics.method));
        write_attribute(file, "tolerance", numerics.tolerance);
        write_attribute(file, "resolve", numerics.resolve ? "true" : "false");
        if (const auto audit = problem.product.audit()) {
            write_attribute(file, "fill", "true");
            write_attribute(file, "audit", *audit);
        }
    }
    // The token is the first dataset, so that it is within any limit of file sizes.
    write_attribute(add_numbers(file, layout::run_token, {}, "random number of the ranks, or 0"),
                    "comment", "used by the ranks to check at the start that they share the file");
    const std::string auxiliary = add_coordinates(file, job);
    for (const Field field : problem.fields) {
        add_field(file, field, problem, auxiliary);
    }
}

/// Marks a file without tiles as that of a part. It then contains its own former bytes, to which
/// merge() adds the tiles of all parts.
void add_part(const std::string& path, const JobPart& part)
{
    std::ifstream stream(path, std::ios::binary);
    const std::vector<std::uint8_t> skeleton{std::istreambuf_iterator<char>(stream), {}};
    Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, hdf5::file_access()), H5Fclose);
    write_attribute(file, layout::part_number, part.number);
    write_attribute(file, layout::part_count, part.count);
    const std::string name = in_run_group(layout::skeleton);
    const StoredDimension bytes{name + "_length", std::int64_t(skeleton.size())};
    add_bare_dimension(file, bytes);
    add_variable(file, {name, {bytes}, skeleton, "the file of all parts without its tiles"});
    const Handle dataset = hdf5::open_dataset(file, name);
    write_attribute(dataset, layout::skeleton_checksum, dataset_checksum(dataset, skeleton.size()));
    file.close();
}

/// Upper bound. Values, coordinates and texts are counted exactly; the overhead of HDF5 was
/// measured: 18 KB per file, 1 KB per field, 0.6 KB per coordinate and each of its dimensions.
long double bytes_of_skeleton(const Job& job)
{
    using Count = long double;
    Count bytes = 20480 + 1200 * Count(job.problem.fields.size());
    for (const CoordinateVariable& coordinate : coordinate_variables_of(job)) {
        const netcdf::Variable& variable = coordinate.variable;
        Count bytes_of_values =
            std::visit([](const auto& values) { return Count(sizeof values[0]); }, variable.values);
        for (const StoredDimension& dimension : variable.dimensions) {
            bytes_of_values *= Count(dimension.size);
        }
        bytes += 600 + 600 * Count(variable.dimensions.size()) + bytes_of_values;
    }
    for (const RecordedMotion& motion : job.motions) {
        bytes += Count(record_text(motion).size());
    }
    for (const std::string& setting : job.overrides) {
        bytes += Count(setting.size() + 1);
    }
    return bytes + Count(2 * job.title.size() + job.given.size() + job.resolved.size());
}

} // namespace

long double result_bytes(const Job& job, const std::optional<JobPart>& part)
{
    return bytes_of_skeleton(job) * (part ? 2 : 1) + // a part contains its skeleton
           bytes_of_tiles(tile_layout_of(job.problem), part);
}

void create_result(const std::string& path, const Job& job, const std::optional<JobPart>& part,
                   const BetweenTiles& between_tiles)
{
    create_in_place(path, [&](const std::string& temporary) {
        expect_space(path, result_bytes(job, part),
                     "Free some space, choose another disk with -o, or reduce the number of points "
                     "or fields.");
        write_file(temporary, job, kind_of(job.problem.product),
                   [&](hid_t file) { write_skeleton(file, job); });
        if (part) {
            add_part(temporary, *part);
        }
        // The values of points that are not computed: a run only overwrites existing values.
        const TileLayout tiles = tile_layout_of(job.problem);
        add_tiles(temporary, tiles, part, [&](const StoredField& stored) -> ChunkOfTile {
            return [&between_tiles,
                    nothing = not_computed(stored.field, tiles.points_of_chunk(stored.field))](
                       const Tile&) -> const FieldValues& {
                between_tiles();
                return nothing;
            };
        });
    });
}

} // namespace overturn
