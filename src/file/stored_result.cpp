#include "overturn/file/stored_result.hpp"

#include "layout.hpp"
#include "own_dataset.hpp"
#include "tile_access.hpp"
#include "working_file.hpp"

#include "overturn/file/result_writer.hpp"
#include "overturn/mechanics/region.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/is_one_of.hpp"
#include "overturn/text/mapped.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace overturn {

using hdf5::check;
using hdf5::Handle;

namespace {

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

std::int64_t format_of(hid_t file)
{
    const auto format = hdf5::read_integers_attribute(file, layout::format_version);
    return format.empty() ? 1 : format.front();
}

/// Of the fields, in a file of this format.
std::string stored_name(Field field, std::int64_t format)
{
    return format == layout::former_format && field == Field::friction_demand
               ? "friction"
               : std::string(name_of(field));
}

/// The precision in which a field is stored; that of its type if there is no such choice.
Precision stored_precision(hid_t file, const std::string& name, const FieldTraits& traits)
{
    return traits.type == FieldType::float64 &&
                   has_type(open_own_dataset(file, name), hdf5::Type::of(float()))
               ? Precision::single_precision
               : Precision::double_precision;
}

/// The fields in the order of their creation, which is that of the job.
std::vector<Field> read_fields(hid_t file)
{
    const std::int64_t format = format_of(file);
    H5G_info_t group = {};
    check(H5Gget_info(file, &group));
    std::vector<Field> fields;
    for (hsize_t i = 0; i < group.nlinks; ++i) {
        std::string name(64, '\0');
        const auto length = check(H5Lget_name_by_idx(file, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, i,
                                                     name.data(), name.size(), H5P_DEFAULT));
        name.resize(std::min(std::size_t(length), name.size()));
        for (const FieldTraits& each : all_fields()) {
            if (stored_name({each.name}, format) == name) {
                fields.push_back({each.name, stored_precision(file, name, each)});
            }
        }
    }
    require(!fields.empty(), "there are no fields");
    return fields;
}

/// axes: of this field. chunks: the number that is stored; nullopt: all.
void check_field(hid_t file, Field field, const std::vector<AxisSummary>& axes, std::uint64_t bytes,
                 const std::optional<std::int64_t>& chunks)
{
    const Handle dataset = open_own_dataset(file, stored_name(field, format_of(file)));
    require(std::ranges::equal(shape_of(dataset), axes, {}, {},
                               [](const AxisSummary& axis) { return hsize_t(axis.size); }),
            "a field does not fit the axes");
    count_stored(dataset, layout::type_of(field), bytes, chunks);
}

/// nullopt: the file is that of all tiles.
std::optional<JobPart> read_part(hid_t file, std::int64_t tiles)
{
    const auto number = hdf5::read_integers_attribute(file, layout::part_number);
    const auto count = hdf5::read_integers_attribute(file, layout::part_count);
    if (number.empty() && count.empty()) {
        return std::nullopt;
    }
    require(number.size() == 1 && count.size() == 1 && 1 <= number[0] && number[0] <= count[0] &&
                count[0] <= tiles,
            "the number of the part is malformed");
    return JobPart{number[0], count[0]};
}

FileOrigin read_origin(hid_t file, const std::string& path)
{
    FileOrigin origin;
    origin.bytes = std::filesystem::file_size(path);
    const std::string name = hdf5::read_text_attribute(file, "kind");
    const auto kind = enumerator_named<FileKind>(name);
    if (!kind) {
        throw Error(exit_code::output, "\"{}\" is an HDF5 file, but not a result of overturn{}.",
                    path, name.empty() ? "" : fmt::format(": its kind is \"{}\"", name));
    }
    origin.kind = *kind;
    const std::int64_t version = origin.format = format_of(file);
    if (version != layout::format && version != layout::former_format) {
        throw Error(
            exit_code::output,
            "\"{}\" has format version {}, but this program reads versions {} and {}. Use {}.",
            path, version, layout::former_format, layout::format,
            version > layout::format ? "a newer program"
                                     : "an older program, or compute the file again");
    }
    origin.title = hdf5::read_text_attribute(file, "title");
    origin.motion_of =
        enumerator_named<MotionOf>(hdf5::read_text_attribute(file, layout::motion_of))
            .value_or(origin.motion_of);
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
    Handle file;
    TilesSummary tiles;
    std::vector<std::uint64_t> checksums; ///< by tile number
    std::vector<AuditCount> audits;       ///< the same, if the spectrum is filled

    Tiling tiling() const { return {mapped(tiles.axes, &AxisSummary::size), tiles.tile_shape}; }

    void read_tiles(std::uint64_t bytes)
    {
        const auto open_number = [&](const char* name) {
            return open_own_dataset(file, layout::in_run_group(name));
        };
        const Handle dataset = open_number(layout::checksum);
        std::istringstream words(hdf5::read_text_attribute(dataset, layout::dimensions));
        const std::vector<std::string> names{std::istream_iterator<std::string>(words), {}};
        require(names.size() <= H5S_MAX_RANK, "the dimensions are malformed");
        for (const std::string& name : names) {
            const Handle axis = open_own_dataset(file, name);
            require(shape_of(axis).size() == 1, "an axis is malformed");
            tiles.axes.push_back(read_axis(axis, name, bytes));
        }
        tiles.numbers = read_coordinate_numbers(file, bytes);
        tiles.tile_shape = hdf5::read_integers_attribute(dataset, layout::tile_shape);
        require(tiles.tile_shape.size() == tiles.axes.size() &&
                    std::ranges::all_of(tiles.tile_shape, [](auto size) { return size >= 1; }),
                "the tiles are malformed");
        tiles.tiles_of_job = tiling().size();
        tiles.part = read_part(file, tiles.tiles_of_job);
        const TilesOfPart own(tiles.tiles_of_job, tiles.part);
        tiles.tiles = own.size();
        tiles.fields = read_fields(file);
        const std::size_t crossing = place_of_crossing(tiles.axes);
        for (const Field field : tiles.fields) {
            require(traits_of(field).of != FieldOf::line || crossing < tiles.axes.size(),
                    "the dimension `crossing` is missing");
            check_field(file, field, stored_dimensions_of(field, tiles.axes, crossing), bytes,
                        tiles.part ? std::optional(tiles.tiles) : std::nullopt);
        }
        const auto read_numbers = [&](hid_t numbers) {
            require(shape_of(numbers) == hdf5::Extents{hsize_t(tiles.tiles_of_job)},
                    "the numbers of the tiles do not fit the tiles");
            return read_all<std::uint64_t>(numbers, bytes);
        };
        checksums = read_numbers(dataset);
        for (std::int64_t tile = 0; tile < tiles.tiles_of_job; ++tile) {
            if (checksums[std::size_t(tile)] != not_computed_checksum) {
                require(own.contains(tile), "a part has tiles of other parts");
                ++tiles.tiles_done;
            }
        }
        if (!is_one_of(Field::evaluated, tiles.fields)) {
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
    void for_each_computed_tile(const std::vector<Field>& fields, const BetweenTiles& between_tiles,
                                const Use& use) const
    {
        const Tiling all = tiling();
        const std::vector<StoredField> stored = mapped(fields, [&](Field field) {
            const std::string name = stored_name(field, format_of(file));
            return StoredField{field, hdf5::open_dataset(file, name),
                               place_of_crossing(tiles.axes)};
        });
        for (std::int64_t number = 0; number < all.size(); ++number) {
            if (checksums[std::size_t(number)] == not_computed_checksum) {
                continue;
            }
            between_tiles();
            const Tile tile = all[number];
            use(tile, mapped(stored, [&](const StoredField& f) { return read_tile(f, tile); }));
        }
    }
};

StoredResult::StoredResult(const std::string& path) : path_(path), open_(std::make_shared<Open>())
{
    or_refused(path, [&] {
        open_->file = open_file(path);
        origin_ = read_origin(open_->file, path);
        if (origin_.has_tiles()) {
            open_->read_tiles(origin_.bytes);
        }
    });
}

const TilesSummary& StoredResult::tiles() const
{
    if (!origin_.has_tiles()) {
        throw Error(exit_code::output,
                    "\"{}\" is an HDF5 file, but not a spectrum of overturn: its kind is \"{}\".",
                    path_, name_of(origin_.kind));
    }
    return open_->tiles;
}

std::string StoredResult::coordinate_checksums() const
{
    return or_refused(
        path_, [&] { return read_text(open_->file, layout::coordinate_checksums, origin_.bytes); });
}

std::vector<std::string> StoredResult::damaged_coordinates() const
{
    return or_refused(path_, [&] {
        const std::uint64_t bytes = origin_.bytes;
        std::istringstream lines(coordinate_checksums());
        std::vector<std::string> damaged;
        for (std::string name, checksum; lines >> name >> checksum;) {
            if (dataset_checksum(open_own_dataset(open_->file, name), bytes) != checksum) {
                damaged.push_back(name);
            }
        }
        if (tiles().part) {
            const std::string name = layout::in_run_group(layout::skeleton);
            const Handle skeleton = open_own_dataset(open_->file, name);
            if (dataset_checksum(skeleton, bytes) !=
                hdf5::read_text_attribute(skeleton, layout::skeleton_checksum)) {
                damaged.push_back(name);
            }
        }
        return damaged;
    });
}

std::vector<std::int64_t> StoredResult::damaged_tiles(const BetweenTiles& between_tiles) const
{
    std::vector<std::int64_t> damaged;
    const TileChecksums checksums = origin_.format == layout::former_format
                                        ? TileChecksums::of_former_format()
                                        : TileChecksums(origin_.resolved_job);
    const auto check_tile = [&](const Tile& tile, const std::vector<FieldValues>& values) {
        const auto number = std::size_t(tile.number);
        const auto audit = open_->tiles.audit ? std::optional(open_->audits[number]) : std::nullopt;
        if (checksums.of(tile.number, values, audit) != open_->checksums[number]) {
            damaged.push_back(tile.number);
        }
    };
    const std::vector<Field>& fields = tiles().fields;
    or_refused(path_, [&] { open_->for_each_computed_tile(fields, between_tiles, check_tile); });
    return damaged;
}

BoundaryLines StoredResult::count_lines() const
{
    BoundaryLines lines;
    lines.has_shares = is_one_of(Field::unsafe_share, tiles().fields);
    std::vector<Field> fields{Field::region_below, Field::region_above};
    if (lines.has_shares) {
        fields.insert(fields.end(), {Field::unsafe_share, Field::undecided_share});
    }
    const auto count = [&](const Tile& tile, const std::vector<FieldValues>& values) {
        const auto& below = std::get<std::vector<std::uint8_t>>(values[0]);
        const auto& above = std::get<std::vector<std::uint8_t>>(values[1]);
        // A tile has one line.
        const auto is_undecided = [](std::uint8_t code) {
            return Region(code) == Region::undecided;
        };
        require(tile.points() == tile.count[place_of_crossing(open_->tiles.axes)],
                "a tile has several lines");
        ++lines.computed;
        lines.undecided +=
            std::ranges::any_of(below, is_undecided) || std::ranges::any_of(above, is_undecided);
        lines.unsafe_at_first += is_unsafe(Region(below[0]));
        if (lines.has_shares) {
            lines.unsafe_share += std::get<std::vector<double>>(values[2])[0];
            lines.undecided_share += std::get<std::vector<double>>(values[3])[0];
        }
    };
    or_refused(path_, [&] {
        open_->for_each_computed_tile(
            fields, [] {}, count);
    });
    const auto computed = double(std::max<std::int64_t>(1, lines.computed));
    lines.unsafe_share /= computed;
    lines.undecided_share /= computed;
    return lines;
}

void clear_open_mark(const std::string& path)
{
    constexpr std::streamoff place = 20; // in a superblock of version 0
    std::ifstream file(path, std::ios::binary);
    file.seekg(place);
    if (file.get() != 0) {
        const hid_t opened = H5Fopen(path.c_str(), H5F_ACC_RDWR, hdf5::file_access());
        if (opened >= 0) {
            H5Fclose(opened);
        }
    }
}

} // namespace overturn
