#include "overturn/file/result_writer.hpp"

#include "coordinate_variables.hpp"
#include "layout.hpp"
#include "netcdf.hpp"
#include "own_dataset.hpp"
#include "tile_access.hpp"
#include "working_file.hpp"

#include "overturn/sweep/boundary.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/mapped.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <limits>
#include <random>
#include <sys/stat.h>
#include <unistd.h>

namespace overturn {

using hdf5::check;
using hdf5::Handle;
using hdf5::write_attribute;
using layout::in_run_group;
using namespace netcdf;
using Clock = std::chrono::steady_clock;

// Turns off the messages of HDF5, and the closing of files at exit, which would wait for other
// ranks.
void start_hdf5()
{
    H5dont_atexit();
    check(H5open());
    check(H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr));
}

namespace {

/// Writes the value of points that are not computed to every chunk, so that a run only overwrites
/// existing values.
void write_not_computed(const StoredField& stored, const Problem& problem, const std::string& path,
                        const BetweenTiles& between_tiles)
{
    const Tiling tiling = tiling_of(problem);
    const std::int64_t count =
        count_points(stored_dimensions_of(stored.field, tiling.tile_shape(), stored.crossing));
    const std::int64_t bytes = count * std::int64_t(bytes_per_point(stored.field));
    const std::int64_t tiles_between_syncs = std::max<std::int64_t>(1, most_unsynced_bytes / bytes);
    const FieldValues values = not_computed(stored.field, count); // of a whole chunk
    for (std::int64_t number = 0; number < tiling.size(); ++number) {
        between_tiles();
        write_chunk(stored, tiling[number], values);
        if ((number + 1) % tiles_between_syncs == 0 && !sync(path)) {
            throw hdf5::Hdf5Error(system_reason(errno));
        }
    }
}

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
    if (traits.type == FieldType::float64) {
        write_attribute(dataset, "_FillValue", std::numeric_limits<double>::quiet_NaN());
    }
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
               fill_value(field));
    Handle dataset =
        create_dataset(file, std::string(name_of(field)), type.file,
                       stored_dimensions_of(field, stored_dimensions(problem), crossing), creation);
    write_field_attributes(dataset, field, problem, coordinates);
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
                                problem.product.audit() ? ", audit_checked and audit_wrong" : ""));
    write_attribute(dataset, "numbering",
                    "tiles are boxes of tile_shape, smaller at the far edges, in the order of "
                    "`dimensions`; the last varies fastest");
    if (!tiling.shape().empty()) {
        const auto names = mapped(stored_dimensions(problem), &StoredDimension::name);
        write_attribute(dataset, layout::dimensions, fmt::format("{}", fmt::join(names, " ")));
        write_attribute(dataset, layout::tile_shape, tiling.tile_shape());
    }
    if (problem.product.audit()) {
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

void expect_space(const std::string& path, const std::string& part, const Job& job)
{
    const long double needed = result_bytes(job);
    std::error_code unknown; // then it is the largest number
    const auto available = std::filesystem::space(part, unknown).available;
    if (needed > static_cast<long double>(available)) {
        throw Error(exit_code::output,
                    "cannot create \"{}\": it takes {:.0f} bytes, but {} are available. Free some "
                    "space, choose another disk with -o, or reduce the number of points or fields.",
                    path, needed, available);
    }
}

void write_skeleton(hid_t file, const std::string& path, const Job& job,
                    const BetweenTiles& between_tiles)
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
long double result_bytes(const Job& job)
{
    const Problem& problem = job.problem;
    const Tiling tiling = tiling_of(problem);
    using Count = long double;
    const auto tiles = Count(tiling.size());
    // Tiles at the far edges occupy whole chunks.
    const Count points = tiles * Count(tiling.points_of_tile());

    Count bytes = 20480 + (problem.product.audit() ? 3 * tiles : tiles) * sizeof(double);
    if (problem.product.audit()) {
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
    for (const RecordedMotion& motion : job.motions) {
        bytes += Count(record_text(motion).size());
    }
    const auto rank = Count(tiling.shape().size());
    const auto nodes = tiling.size() / 55 + 2;
    const Count node = 24 + 64 * 8 + 65 * (8 + 8 * (rank + 1));
    for (const Field field : problem.fields) {
        bytes += 1200 + node * Count(nodes) + points * Count(bytes_per_point(field));
    }
    for (const std::string& setting : job.overrides) {
        bytes += Count(setting.size() + 1);
    }
    return bytes + Count(2 * job.title.size() + job.given.size() + job.resolved.size());
}

void create_result(const std::string& path, const Job& job, const BetweenTiles& between_tiles)
{
    make_file(path, job, kind_of(job.problem.product), [&](hid_t file, const std::string& part) {
        expect_space(path, part, job);
        write_skeleton(file, part, job, between_tiles);
    });
}

struct ResultWriter::Open {
    std::string path;
    Handle file;
    std::vector<StoredField> fields;
    Handle checksums;
    Handle audit_checked; ///< only if the spectrum is filled
    Handle audit_wrong;
    bool is_filled;
    bool is_durable;
    struct stat as_opened = {};
    Clock::time_point last_seen;

    /// Does not close the file.
    ~Open() { file.release(); }

    void sync_if_durable() const
    {
        // A write by MPI-IO has been passed to the system when it returns. The sync of MPI-IO would
        // be collective.
        if (is_durable && !sync(path)) {
            throw hdf5::Hdf5Error("syncing to the disk failed");
        }
    }

    void store(const Tile& tile, const TileFields& tile_fields, std::uint64_t checksum)
    {
        assert(tile_fields.values.size() == fields.size());
        constexpr std::chrono::seconds between_looks{1};
        if (const auto now = Clock::now(); now - last_seen >= between_looks) {
            last_seen = now;
            expect_in_place();
        }
        std::string_view dataset;
        try {
            errno = 0;
            for (std::size_t i = 0; i < fields.size(); ++i) {
                dataset = name_of(fields[i].field);
                write_tile(fields[i], tile, tile_fields.values[i]);
            }
            if (is_filled) {
                dataset = layout::audit_checked;
                write_number(audit_checked, tile.number, std::uint64_t(tile_fields.audit.checked));
                write_number(audit_wrong, tile.number, std::uint64_t(tile_fields.audit.wrong));
            }
            sync_if_durable(); // a failure is that of the last dataset
            dataset = layout::checksum;
            write_number(checksums, tile.number, checksum);
        } catch (const hdf5::Hdf5Error& error) {
            const Error failure = cannot_write(tile, dataset, error);
            expect_in_place(); // throws if this is the reason
            throw Error(failure);
        }
    }

    /// Throws Error if the path no longer names the opened file, or the file was truncated:
    /// writing to a removed or truncated file reports no error.
    void expect_in_place() const
    {
        struct stat found = {};
        const bool is_found = stat(path.c_str(), &found) == 0;
        if (!is_found && errno != ENOENT) {
            return; // inconclusive: a write will report the error
        }
        if (!is_found || found.st_dev != as_opened.st_dev || found.st_ino != as_opened.st_ino) {
            throw Error(exit_code::output,
                        "\"{}\" was removed, moved or replaced during the run. If it was moved, "
                        "move it back and run the same command again to resume.",
                        path);
        }
        if (found.st_size < as_opened.st_size) {
            throw Error(exit_code::output,
                        "\"{}\" was truncated from {} to {} bytes during the run. Remove the file "
                        "and recompute it.",
                        path, as_opened.st_size, found.st_size);
        }
    }

    Error cannot_write(const Tile& tile, std::string_view dataset,
                       const hdf5::Hdf5Error& error) const
    {
        // MPI-IO does not report the reason of a failed write: the last system error is the best
        // guess, and a full disk can be detected.
        int reason = errno;
        std::error_code unknown; // then it is the largest number
        if (std::filesystem::space(path, unknown).available == 0) {
            reason = ENOSPC;
        }
        return Error(exit_code::output,
                     "cannot write tile {} of \"{}\": {}. {} the same command again to resume.",
                     tile.number, dataset, reason != 0 ? system_reason(reason) : error.what(),
                     reason == ENOSPC || reason == EDQUOT ? "Free some space and run" : "Run");
    }
};

namespace {

[[noreturn]] void refuse_to_open(const std::string& path, std::string_view reason)
{
    throw Error(exit_code::output, "cannot open \"{}\" for writing: {}.", path, reason);
}

/// Closes the file, which makes the token visible to other hosts over NFS.
void write_token(const std::string& path, std::uint64_t token)
{
    try {
        Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, hdf5::file_access()), H5Fclose);
        check(H5Dwrite(hdf5::open_dataset(file, in_run_group(layout::run_token)), H5T_NATIVE_UINT64,
                       H5S_ALL, H5S_ALL, H5P_DEFAULT, &token));
        file.close();
    } catch (const hdf5::Hdf5Error& error) {
        refuse_to_open(path, error.what());
    }
}

bool contains_token(const std::string& path, std::uint64_t token)
{
    try {
        const Handle file = hdf5::open_to_read(path);
        const Handle dataset = open_own_dataset(file, in_run_group(layout::run_token));
        return read_all<std::uint64_t>(dataset, sizeof token) == std::vector{token};
    } catch (const hdf5::Hdf5Error&) {
        return false;
    }
}

/// Each write is passed to the system before it returns. A single rank does not use MPI-IO for
/// that, because MPI-IO would create and remove temporary files next to this one.
Handle unbuffered_access(MPI_Comm communicator)
{
    Handle access = hdf5::file_access();
    int ranks = 1;
    MPI_Comm_size(communicator, &ranks);
    if (ranks == 1) {
        check(H5Pset_cache(access, 0, 0, 0, 0));
        check(H5Pset_sieve_buf_size(access, 0));
    } else {
        check(H5Pset_fapl_mpio(access, communicator, MPI_INFO_NULL));
    }
    return access;
}

} // namespace

void expect_path_for_mpi([[maybe_unused]] const std::string& path)
{
#ifndef OMPI_MAJOR_VERSION // MPICH and its derivatives use ROMIO
    if (path.find(':') != std::string::npos) {
        throw Error(exit_code::output,
                    "\"{}\" has a colon, but this MPI library interprets the text before a colon "
                    "as a type of file system. Choose another path with -o.",
                    path);
    }
#endif
}

std::optional<int> rank_with_another_file(const std::string& path, MPI_Comm communicator)
{
    start_hdf5();
    int rank = 0;
    int ranks = 1;
    MPI_Comm_rank(communicator, &rank);
    MPI_Comm_size(communicator, &ranks);
    std::uint64_t token = 0;
    if (rank == 0) {
        std::random_device random;
        token = random() + (std::uint64_t(random()) << 32);
        write_token(path, token);
    }
    MPI_Bcast(&token, 1, MPI_UINT64_T, 0, communicator);
    const int other = contains_token(path, token) ? ranks : rank;
    int first = ranks;
    MPI_Reduce(&other, &first, 1, MPI_INT, MPI_MIN, 0, communicator);
    if (rank == 0) {
        write_token(path, 0);
    }
    MPI_Bcast(&first, 1, MPI_INT, 0, communicator);
    return first < ranks ? std::optional(first) : std::nullopt;
}

ResultWriter::ResultWriter(const std::string& path, MPI_Comm communicator, const Problem& problem,
                           bool durable)
    : open_(std::make_unique<Open>())
{
    open_->path = path;
    open_->is_durable = durable;
    open_->is_filled = problem.product.audit().has_value();
    if (access(path.c_str(), R_OK | W_OK) != 0) {
        // The message of MPI-IO would be "invalid access mode".
        refuse_to_open(path, system_reason(errno));
    }
    try {
        start_hdf5();
        open_->file =
            Handle(H5Fopen(path.c_str(), H5F_ACC_RDWR, unbuffered_access(communicator)), H5Fclose);
        for (const Field field : problem.fields) {
            open_->fields.push_back({field, hdf5::open_dataset(open_->file, name_of(field)),
                                     place_of_crossing(problem)});
        }
        const auto open = [&](const char* name) {
            return hdf5::open_dataset(open_->file, in_run_group(name));
        };
        open_->checksums = open(layout::checksum);
        if (open_->is_filled) {
            open_->audit_checked = open(layout::audit_checked);
            open_->audit_wrong = open(layout::audit_wrong);
        }
        if (stat(path.c_str(), &open_->as_opened) != 0) {
            throw hdf5::Hdf5Error(system_reason(errno));
        }
    } catch (const hdf5::Hdf5Error& error) {
        refuse_to_open(path, error.what());
    }
}

ResultWriter::~ResultWriter() = default;

std::vector<std::int64_t> ResultWriter::missing_tiles()
{
    try {
        std::vector<std::int64_t> missing;
        const auto checksums = read_all<std::uint64_t>(open_->checksums, open_->as_opened.st_size);
        for (std::size_t tile = 0; tile < checksums.size(); ++tile) {
            if (checksums[tile] == not_computed_checksum) {
                missing.push_back(std::int64_t(tile));
            }
        }
        return missing;
    } catch (const hdf5::Hdf5Error& error) {
        throw Error(exit_code::output, "cannot read which tiles of \"{}\" are missing: {}.",
                    open_->path, error.what());
    }
}

void ResultWriter::reset(const Tile& tile)
{
    const auto nothing_in = [&](const StoredField& stored) {
        return not_computed(stored.field, stored.part_of(tile).points());
    };
    open_->store(tile, {.values = mapped(open_->fields, nothing_in)}, not_computed_checksum);
}

void ResultWriter::write(const Tile& tile, const TileFields& fields)
{
    const auto audit = open_->is_filled ? std::optional(fields.audit) : std::nullopt;
    open_->store(tile, fields, tile_checksum(fields.values, audit));
}

void ResultWriter::close()
{
    open_->expect_in_place();
    try {
        open_->fields.clear();
        open_->checksums.close();
        open_->audit_checked.close();
        open_->audit_wrong.close();
        check(H5Fflush(open_->file, H5F_SCOPE_GLOBAL));
        open_->file.close();
        open_->sync_if_durable();
    } catch (const hdf5::Hdf5Error& error) {
        throw Error(exit_code::output,
                    "cannot write all of \"{}\" to the disk: {}. Its content may be damaged: "
                    "remove the file and recompute it.",
                    open_->path, error.what());
    }
}

} // namespace overturn
