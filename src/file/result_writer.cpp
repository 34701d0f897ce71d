#include "overturn/file/result_writer.hpp"

#include "layout.hpp"
#include "own_dataset.hpp"
#include "tile_access.hpp"
#include "working_file.hpp"

#include "overturn/text/error.hpp"
#include "overturn/text/mapped.hpp"

#include <cassert>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <random>
#include <sys/stat.h>
#include <unistd.h>

namespace overturn {

using hdf5::check;
using hdf5::Handle;
using layout::in_run_group;
using Clock = std::chrono::steady_clock;

// Turns off the messages of HDF5, and the closing of files at exit, which would wait for other
// ranks.
void start_hdf5()
{
    H5dont_atexit();
    check(H5open());
    check(H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr));
}

struct ResultWriter::Open {
    std::string path;
    Handle file;
    std::vector<StoredField> fields;
    Handle checksums;
    std::optional<TileChecksums> checksum_of_tile; ///< once the job is read
    Handle audit_checked;                          ///< only if the spectrum is filled
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
        const std::vector<char> job =
            read_all<char>(open(layout::job_resolved), open_->as_opened.st_size);
        open_->checksum_of_tile.emplace(std::string_view(job.data(), job.size()));
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
    open_->store(tile, fields, open_->checksum_of_tile->of(tile.number, fields.values, audit));
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
