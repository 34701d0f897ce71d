#include "overturn/file/stored_result.hpp"

#include "attributes.hpp"
#include "dataset_checksum.hpp"
#include "layout.hpp"
#include "operating_system.hpp"
#include "own_dataset.hpp"
#include "tile_access.hpp"

#include "overturn/mechanics/region.hpp"
#include "overturn/text/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <sstream>

namespace overturn {

using hdf5::check;
using hdf5::Handle;

struct StoredResult::Open {
    std::string path;
    Handle file;
    FileOrigin origin;
    TilesSummary tiles;
    std::vector<std::uint64_t> checksums; ///< by tile number
    std::vector<AuditCount> audits;       ///< the same, if the spectrum is filled

    Tiling tiling() const
    {
        Shape shape;
        for (const AxisSummary& axis : tiles.axes) {
            shape.push_back(axis.size);
        }
        return {std::move(shape), tiles.tile_shape};
    }

    /// The dimensions of a field, and the place of `crossing` among those of the points.
    std::vector<AxisSummary> axes_of(Field field) const
    {
        return stored_dimensions_of(field, tiles.axes, crossing());
    }
    std::size_t crossing() const
    {
        return std::size_t(std::ranges::find(tiles.axes, flip_dimension, &AxisSummary::name) -
                           tiles.axes.begin());
    }
};

namespace {

/// Whether all values are stored. This also reads the whole chunk index, so that a damaged index is
/// found, or crashes HDF5, before the file is used.
bool is_stored_as_a_whole(hid_t dataset, const std::vector<hsize_t>& shape, hsize_t bytes_per_value)
{
    const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
    hsize_t expected = bytes_per_value;
    std::vector<hsize_t> chunk(shape.size(), 1);
    if (H5Pget_layout(creation) == H5D_CHUNKED) {
        check(H5Pget_chunk(creation, int(chunk.size()), chunk.data()));
    }
    for (std::size_t i = 0; i < shape.size(); ++i) {
        demand(chunk[i] >= 1, "a field has empty chunks");
        expected *= (shape[i] + chunk[i] - 1) / chunk[i] * chunk[i];
    }
    const bool is_compressed = check(H5Pget_nfilters(creation)) > 0;
    return H5Dget_storage_size(dataset) == expected || is_compressed;
}

std::string read_text(hid_t file, const std::string& name, std::uint64_t bytes)
{
    const Handle dataset = open_own_dataset(file, name);
    std::string text(length_of_list(dataset, H5T_C_S1, bytes, "a text is malformed"), '\0');
    check(H5Dread(dataset, H5T_C_S1, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()));
    return text;
}

AxisSummary read_axis(hid_t file, const std::string& name, std::uint64_t bytes)
{
    constexpr const char* malformed = "an axis is malformed";
    const Handle dataset = open_own_dataset(file, name);
    std::vector<double> values(length_of_list(dataset, H5T_IEEE_F64LE, bytes, malformed));
    demand(!values.empty(), malformed);
    check(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
    return {name, std::int64_t(values.size()), values.front(), values.back(),
            hdf5::read_text_attribute(dataset, "units")};
}

/// The coordinates that are stored as single values.
std::vector<AxisSummary> read_coordinate_numbers(hid_t file)
{
    std::vector<AxisSummary> numbers;
    for (const Quantity& quantity : all_quantities()) {
        const std::string name(quantity.name);
        if (!quantity.is_coordinate() || quantity.role == Role::motion ||
            check(H5Lexists(file, name.c_str(), H5P_DEFAULT)) == 0) {
            continue;
        }
        const Handle dataset = open_own_dataset(file, name);
        if (shape_of(dataset).empty() && has_type(dataset, H5T_IEEE_F64LE)) {
            double value = 0;
            check(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value));
            numbers.push_back({name, 1, value, value, hdf5::read_text_attribute(dataset, "units")});
        }
    }
    return numbers;
}

/// The fields in the order of their creation, which is that of the job.
std::vector<Field> read_fields(hid_t file)
{
    const std::vector<std::string_view> names = field_names();
    H5G_info_t group = {};
    check(H5Gget_info(file, &group));
    std::vector<Field> fields;
    for (hsize_t i = 0; i < group.nlinks; ++i) {
        std::string name(64, '\0');
        const auto length = check(H5Lget_name_by_idx(file, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, i,
                                                     name.data(), name.size(), H5P_DEFAULT));
        name.resize(std::min(std::size_t(length), name.size()));
        const auto found = std::find(names.begin(), names.end(), name);
        if (found != names.end()) {
            fields.push_back(Field(found - names.begin()));
        }
    }
    demand(!fields.empty(), "there are no fields");
    return fields;
}

void check_field(hid_t file, Field field, const std::vector<AxisSummary>& axes, std::uint64_t bytes)
{
    const Handle dataset = open_own_dataset(file, std::string(name_of(field)));
    const std::vector<hsize_t> shape = shape_of(dataset);
    demand(shape.size() == axes.size() && has_type(dataset, layout::stored_as(field).file),
           "a field is malformed");
    std::uint64_t room = bytes / bytes_per_point(field);
    for (std::size_t i = 0; i < shape.size(); ++i) {
        demand(shape[i] == hsize_t(axes[i].size), "a field does not fit the axes");
        demand(shape[i] <= room, "a field is larger than the file");
        room /= shape[i];
    }
    demand(is_stored_as_a_whole(dataset, shape, bytes_per_point(field)),
           "values of a field are missing");
}

/// Numbers of the group `run`, one per tile.
std::vector<std::uint64_t> read_numbers_of_tiles(hid_t file, const char* name, std::int64_t tiles,
                                                 std::uint64_t bytes)
{
    constexpr const char* foreign = "the numbers of the tiles do not fit the tiles";
    const Handle dataset = open_own_dataset(file, layout::in_run_group(name));
    demand(length_of_list(dataset, H5T_STD_U64LE, bytes, foreign) == hsize_t(tiles), foreign);
    return read_numbers(dataset);
}

/// The metadata of a file of any kind.
FileOrigin read_origin(hid_t file, const std::string& path)
{
    FileOrigin origin;
    origin.bytes = std::filesystem::file_size(path);
    const std::string kind = hdf5::read_text_attribute(file, "kind");
    const auto* found = std::find(layout::kinds.begin(), layout::kinds.end(), kind);
    if (found == layout::kinds.end()) {
        throw Error(exit_code::output, "\"{}\" is an HDF5 file, but not a result of overturn{}.",
                    path, kind.empty() ? "" : fmt::format(": its kind is \"{}\"", kind));
    }
    origin.kind = FileKind(found - layout::kinds.begin());
    origin.format = hdf5::has_attribute(file, layout::format_version)
                        ? hdf5::read_integer_attribute(file, layout::format_version)
                        : 1;
    if (origin.format < layout::oldest_format || origin.format > layout::newest_format) {
        throw Error(exit_code::output,
                    "\"{}\" has format version {}, but this program reads the versions "
                    "{} and {}. Use {} program.",
                    path, origin.format, layout::oldest_format, layout::newest_format,
                    origin.format > layout::newest_format ? "a newer" : "an older");
    }
    origin.title = hdf5::read_text_attribute(file, "title");
    origin.program_version = hdf5::read_text_attribute(file, "program_version");
    origin.program_commit = hdf5::read_text_attribute(file, "program_commit");
    origin.resolved_job = read_text(file, layout::in_run_group(layout::job_resolved), origin.bytes);
    return origin;
}

Handle open_file(const std::string& path)
{
    std::error_code reason;
    if (!std::filesystem::is_regular_file(path, reason)) {
        throw Error(exit_code::output, "cannot read \"{}\": {}.", path,
                    reason ? in_sentence(reason.message())
                           : std::string("it is not a regular file"));
    }
    hdf5::start();
    if (check(H5Fis_hdf5(path.c_str())) == 0) {
        throw Error(exit_code::output, "\"{}\" is not an HDF5 file.", path);
    }
    return hdf5::open_to_read(path);
}

} // namespace

StoredResult::StoredResult(const std::string& path) : open_(std::make_unique<Open>())
{
    open_->path = path;
    or_refused(path, [&] {
        open_->file = open_file(path);
        open_->origin = read_origin(open_->file, path);
        if (open_->origin.has_tiles()) {
            read_tiles();
        }
    });
}

StoredResult::~StoredResult() = default;
StoredResult::StoredResult(StoredResult&&) noexcept = default;
StoredResult& StoredResult::operator=(StoredResult&&) noexcept = default;

/// Throws Hdf5Error, which the constructor converts.
void StoredResult::read_tiles()
{
    const std::uint64_t bytes = open_->origin.bytes;
    TilesSummary& summary = open_->tiles;
    const Handle dataset = open_own_dataset(open_->file, layout::in_run_group(layout::checksum));
    std::istringstream words(hdf5::read_text_attribute(dataset, layout::dimensions));
    const std::vector<std::string> names{std::istream_iterator<std::string>(words), {}};
    demand(names.size() <= H5S_MAX_RANK, "the dimensions are malformed");
    for (const std::string& name : names) {
        summary.axes.push_back(read_axis(open_->file, name, bytes));
    }
    summary.numbers = read_coordinate_numbers(open_->file);
    summary.fields = read_fields(open_->file);
    for (const Field field : summary.fields) {
        check_field(open_->file, field, open_->axes_of(field), bytes);
    }
    if (!names.empty()) {
        summary.tile_shape = hdf5::read_integers_attribute(dataset, layout::tile_shape);
    }
    demand(summary.tile_shape.size() == summary.axes.size() &&
               std::ranges::all_of(summary.tile_shape, [](auto size) { return size >= 1; }),
           "the tiles are malformed");
    summary.tiles = open_->tiling().size();
    const auto numbers = [&](const char* name) {
        return read_numbers_of_tiles(open_->file, name, summary.tiles, bytes);
    };
    open_->checksums = numbers(layout::checksum);
    summary.tiles_done =
        summary.tiles - std::ranges::count(open_->checksums, not_computed_checksum);
    if (std::ranges::count(summary.fields, Field::evaluated) == 0) {
        return;
    }
    const std::vector<std::uint64_t> checked = numbers(layout::audit_checked);
    const std::vector<std::uint64_t> wrong = numbers(layout::audit_wrong);
    summary.audit = AuditCount{};
    for (std::size_t tile = 0; tile < checked.size(); ++tile) {
        open_->audits.push_back({std::int64_t(checked[tile]), std::int64_t(wrong[tile])});
        if (open_->checksums[tile] != not_computed_checksum) {
            summary.audit->checked += open_->audits.back().checked;
            summary.audit->wrong += open_->audits.back().wrong;
        }
    }
}

const std::string& StoredResult::path() const
{
    return open_->path;
}

const FileOrigin& StoredResult::origin() const
{
    return open_->origin;
}

const TilesSummary& StoredResult::tiles() const
{
    if (!open_->origin.has_tiles()) {
        throw Error(exit_code::output,
                    "\"{}\" is an HDF5 file, but not a spectrum of overturn: its kind is "
                    "\"{}\".",
                    open_->path, layout::name_of(open_->origin.kind));
    }
    return open_->tiles;
}

bool StoredResult::has_coordinate_checksums() const
{
    return open_->origin.format == layout::newest_format;
}

std::vector<std::string> StoredResult::damaged_coordinates() const
{
    if (!has_coordinate_checksums()) {
        return {};
    }
    return or_refused(open_->path, [&] {
        const std::uint64_t bytes = open_->origin.bytes;
        std::istringstream lines(
            read_text(open_->file, layout::in_run_group(layout::coordinate_checksums), bytes));
        std::vector<std::string> damaged;
        for (std::string name, checksum; lines >> name >> checksum;) {
            if (dataset_checksum(open_own_dataset(open_->file, name), bytes) != checksum) {
                damaged.push_back(name);
            }
        }
        return damaged;
    });
}

/// Calls `use` with every computed tile and its values of the given fields.
template <class Use>
void StoredResult::for_each_computed_tile(const std::vector<Field>& fields,
                                          const std::function<void()>& between_tiles,
                                          const Use& use) const
{
    const Tiling tiling = open_->tiling();
    try {
        std::vector<Handle> datasets;
        for (const Field field : fields) {
            datasets.push_back(hdf5::open_dataset(open_->file, name_of(field)));
        }
        for (std::int64_t number = 0; number < tiling.size(); ++number) {
            between_tiles();
            if (open_->checksums[std::size_t(number)] == not_computed_checksum) {
                continue;
            }
            const Tile tile = tiling[number];
            std::vector<FieldValues> values;
            for (std::size_t i = 0; i < fields.size(); ++i) {
                values.push_back(read_tile(
                    datasets[i], stored_tile_of(fields[i], tile, open_->crossing()), fields[i]));
            }
            use(tile, values);
        }
    } catch (const hdf5::Hdf5Error& error) {
        throw Error(exit_code::output, "cannot read the values in \"{}\": {}.", open_->path,
                    error.what());
    }
}

std::vector<std::int64_t>
StoredResult::damaged_tiles(const std::function<void()>& between_tiles) const
{
    std::vector<std::int64_t> damaged;
    for_each_computed_tile(tiles().fields, between_tiles,
                           [&](const Tile& tile, const std::vector<FieldValues>& values) {
                               const auto number = std::size_t(tile.number);
                               const auto audit = open_->tiles.audit
                                                      ? std::optional(open_->audits[number])
                                                      : std::nullopt;
                               if (tile_checksum(values, audit) != open_->checksums[number]) {
                                   damaged.push_back(tile.number);
                               }
                           });
    return damaged;
}

BoundaryLines StoredResult::count_lines() const
{
    BoundaryLines lines;
    lines.has_shares = std::ranges::count(tiles().fields, Field::unsafe_share) > 0;
    std::vector<Field> fields{Field::region_below, Field::region_above};
    if (lines.has_shares) {
        fields.insert(fields.end(), line_fields.begin(), line_fields.end());
    }
    const auto count = [&](const Tile& tile, const std::vector<FieldValues>& values) {
        const auto& below = std::get<std::vector<std::uint8_t>>(values[0]);
        const auto& above = std::get<std::vector<std::uint8_t>>(values[1]);
        // A tile has one line.
        const auto is_undecided = [](std::uint8_t code) {
            return Region(code) == Region::undecided;
        };
        demand(tile.points() == tile.count[open_->crossing()], "a tile has several lines");
        ++lines.computed;
        lines.undecided +=
            std::ranges::any_of(below, is_undecided) || std::ranges::any_of(above, is_undecided);
        lines.unsafe_at_first += is_unsafe(Region(below[0]));
        if (lines.has_shares) {
            lines.unsafe_share += std::get<std::vector<double>>(values[2])[0];
            lines.undecided_share += std::get<std::vector<double>>(values[3])[0];
        }
    };
    for_each_computed_tile(
        fields, [] {}, count);
    const auto computed = double(std::max<std::int64_t>(1, lines.computed));
    lines.unsafe_share /= computed;
    lines.undecided_share /= computed;
    return lines;
}

} // namespace overturn
