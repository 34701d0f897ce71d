#include "overturn/file/stored_result.hpp"

#include "layout.hpp"
#include "own_dataset.hpp"
#include "tile_access.hpp"
#include "working_file.hpp"

#include "overturn/file/spectrum_file.hpp"
#include "overturn/mechanics/region.hpp"
#include "overturn/text/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <new>
#include <sstream>

namespace overturn {

using hdf5::check;
using hdf5::Handle;

namespace {

/// Returns the result of `read`; converts its errors to an Error that names the file.
template <class Read>
auto or_refused(const std::string& path, const Read& read)
{
    try {
        return read();
    } catch (const hdf5::Hdf5Error& error) {
        throw Error(exit_code::output, "\"{}\" cannot be read or is damaged: {}.", path,
                    error.what());
    } catch (const std::bad_alloc&) {
        throw Error(exit_code::output, "\"{}\" is damaged: it contains an impossible size.", path);
    }
}

std::string read_text(hid_t file, const char* name, std::uint64_t bytes)
{
    const Handle dataset = open_own_dataset(file, layout::in_run_group(name));
    const std::vector<char> text = read_all<char>(dataset, bytes);
    return {text.begin(), text.end()};
}

AxisSummary read_axis(hid_t dataset, const std::string& name, std::uint64_t bytes)
{
    const std::vector<double> values = read_all<double>(dataset, bytes);
    return {name, std::int64_t(values.size()), values.front(), values.back(),
            hdf5::read_text_attribute(dataset, "units")};
}

/// The coordinates that are stored as single values.
std::vector<AxisSummary> read_coordinate_numbers(hid_t file, std::uint64_t bytes)
{
    std::vector<AxisSummary> numbers;
    for (const Quantity& quantity : all_quantities()) {
        const std::string name(quantity.name);
        if (!quantity.is_coordinate() || quantity.role == Role::motion ||
            check(H5Lexists(file, name.c_str(), H5P_DEFAULT)) == 0) {
            continue;
        }
        const Handle dataset = open_own_dataset(file, name);
        if (shape_of(dataset).empty() && has_type(dataset, hdf5::Type::of(double()))) {
            numbers.push_back(read_axis(dataset, name, bytes));
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
    demand(std::ranges::equal(shape_of(dataset), axes, {}, {},
                              [](const AxisSummary& axis) { return hsize_t(axis.size); }),
           "a field does not fit the axes");
    count_stored(dataset, layout::type_of(field), bytes);
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
    const auto format = hdf5::read_integers_attribute(file, layout::format_version);
    origin.format = format.empty() ? 1 : format.front();
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
    origin.resolved_job = read_text(file, layout::job_resolved, origin.bytes);
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
    start_hdf5();
    if (check(H5Fis_hdf5(path.c_str())) == 0) {
        throw Error(exit_code::output, "\"{}\" is not an HDF5 file.", path);
    }
    return hdf5::open_to_read(path);
}

} // namespace

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

    /// The place of `crossing` among the axes; any place if there is none.
    std::size_t crossing() const
    {
        return std::size_t(std::ranges::find(tiles.axes, flip_dimension, &AxisSummary::name) -
                           tiles.axes.begin());
    }

    void read_tiles()
    {
        const std::uint64_t bytes = origin.bytes;
        const auto open_number = [&](const char* name) {
            return open_own_dataset(file, layout::in_run_group(name));
        };
        const Handle dataset = open_number(layout::checksum);
        std::istringstream words(hdf5::read_text_attribute(dataset, layout::dimensions));
        const std::vector<std::string> names{std::istream_iterator<std::string>(words), {}};
        demand(names.size() <= H5S_MAX_RANK, "the dimensions are malformed");
        for (const std::string& name : names) {
            const Handle axis = open_own_dataset(file, name);
            demand(shape_of(axis).size() == 1, "an axis is malformed");
            tiles.axes.push_back(read_axis(axis, name, bytes));
        }
        tiles.numbers = read_coordinate_numbers(file, bytes);
        tiles.fields = read_fields(file);
        for (const Field field : tiles.fields) {
            demand(!is_of_line(field) || crossing() < tiles.axes.size(),
                   "the dimension `crossing` is missing");
            check_field(file, field, stored_dimensions_of(field, tiles.axes, crossing()), bytes);
        }
        tiles.tile_shape = hdf5::read_integers_attribute(dataset, layout::tile_shape);
        demand(tiles.tile_shape.size() == tiles.axes.size() &&
                   std::ranges::all_of(tiles.tile_shape, [](auto size) { return size >= 1; }),
               "the tiles are malformed");
        tiles.tiles = tiling().size();
        const auto read_numbers = [&](hid_t numbers) {
            demand(shape_of(numbers) == hdf5::Extents{hsize_t(tiles.tiles)},
                   "the numbers of the tiles do not fit the tiles");
            return read_all<std::uint64_t>(numbers, bytes);
        };
        checksums = read_numbers(dataset);
        tiles.tiles_done = tiles.tiles - std::ranges::count(checksums, not_computed_checksum);
        if (std::ranges::count(tiles.fields, Field::evaluated) == 0) {
            return;
        }
        const std::vector<std::uint64_t> checked = read_numbers(open_number(layout::audit_checked));
        const std::vector<std::uint64_t> wrong = read_numbers(open_number(layout::audit_wrong));
        tiles.audit = AuditCount{};
        for (std::size_t tile = 0; tile < checked.size(); ++tile) {
            audits.push_back({std::int64_t(checked[tile]), std::int64_t(wrong[tile])});
            if (checksums[tile] != not_computed_checksum) {
                tiles.audit->checked += audits.back().checked;
                tiles.audit->wrong += audits.back().wrong;
            }
        }
    }

    /// Calls use(tile, values) with every computed tile and its values of the given fields.
    template <class Use>
    void for_each_computed_tile(const std::vector<Field>& fields,
                                const std::function<void()>& between_tiles, const Use& use) const
    {
        const Tiling all = tiling();
        or_refused(path, [&] {
            std::vector<StoredField> stored;
            for (const Field field : fields) {
                stored.push_back({field, hdf5::open_dataset(file, name_of(field)), crossing()});
            }
            for (std::int64_t number = 0; number < all.size(); ++number) {
                between_tiles();
                if (checksums[std::size_t(number)] == not_computed_checksum) {
                    continue;
                }
                const Tile tile = all[number];
                std::vector<FieldValues> values;
                for (const StoredField& field : stored) {
                    values.push_back(read_tile(field, tile));
                }
                use(tile, values);
            }
        });
    }
};

StoredResult::StoredResult(const std::string& path) : open_(std::make_shared<Open>())
{
    open_->path = path;
    or_refused(path, [&] {
        open_->file = open_file(path);
        open_->origin = read_origin(open_->file, path);
        if (open_->origin.has_tiles()) {
            open_->read_tiles();
        }
    });
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
        std::istringstream lines(read_text(open_->file, layout::coordinate_checksums, bytes));
        std::vector<std::string> damaged;
        for (std::string name, checksum; lines >> name >> checksum;) {
            if (dataset_checksum(open_own_dataset(open_->file, name), bytes) != checksum) {
                damaged.push_back(name);
            }
        }
        return damaged;
    });
}

std::vector<std::int64_t>
StoredResult::damaged_tiles(const std::function<void()>& between_tiles) const
{
    std::vector<std::int64_t> damaged;
    const auto check_tile = [&](const Tile& tile, const std::vector<FieldValues>& values) {
        const auto number = std::size_t(tile.number);
        const auto audit = open_->tiles.audit ? std::optional(open_->audits[number]) : std::nullopt;
        if (tile_checksum(values, audit) != open_->checksums[number]) {
            damaged.push_back(tile.number);
        }
    };
    open_->for_each_computed_tile(tiles().fields, between_tiles, check_tile);
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
    open_->for_each_computed_tile(
        fields, [] {}, count);
    const auto computed = double(std::max<std::int64_t>(1, lines.computed));
    lines.unsafe_share /= computed;
    lines.undecided_share /= computed;
    return lines;
}

} // namespace overturn
