#include "overturn/file/spectrum_file.hpp"

#include "hdf5_handles.hpp"
#include "layout.hpp"
#include "own_dataset.hpp"
#include "tile_access.hpp"
#include "working_file.hpp"

#include "overturn/text/error.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <random>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

namespace overturn {

using hdf5::check;
using hdf5::Handle;
using Clock = std::chrono::steady_clock;

// Turns off the messages of HDF5, and the closing of files at exit, which would wait for other
// ranks.
void start_hdf5()
{
    H5dont_atexit();
    check(H5open());
    check(H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr));
}

struct SpectrumFile::Open {
    std::string path;
    Handle file;
    std::vector<StoredField> fields;
    Handle checksums;
    Handle audit_checked; ///< only if the spectrum is filled
    Handle audit_wrong;
    bool is_filled;
    Durability durability;
    struct stat as_opened = {};
    Clock::time_point last_seen;

    /// Does not close the file.
    ~Open() { file.release(); }

    /// Syncs the file if it is to survive a power failure.
    void sync_if_durable() const
    {
        // A write by MPI-IO has been passed to the system when it returns. The sync of MPI-IO would
        // be collective.
        if (durability == Durability::on_disk && !sync(path)) {
            throw hdf5::Hdf5Error("syncing to the disk failed");
        }
    }

    /// Stores the counts of a filled tile.
    void write_audit(const Tile& tile, const AuditCount& audit)
    {
        write_number(audit_checked, tile.number, std::uint64_t(audit.checked));
        write_number(audit_wrong, tile.number, std::uint64_t(audit.wrong));
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
        struct statvfs disk = {};
        if (statvfs(path.c_str(), &disk) == 0 && disk.f_bavail == 0) {
            reason = ENOSPC;
        }
        return Error(exit_code::output,
                     "cannot write tile {} of \"{}\": {}. {} the same command again to resume.",
                     tile.number, dataset, reason != 0 ? system_reason(reason) : error.what(),
                     reason == ENOSPC || reason == EDQUOT ? "Free some space and run" : "Run");
    }
};

namespace {

/// A random number that rank 0 writes and all ranks read.
struct Token {
    std::uint64_t number = 0;
    std::int64_t place = 0; ///< in the file [byte]
};

std::int64_t place_of_token(const std::string& path)
{
    const Handle file = hdf5::open_to_read(path);
    const Handle dataset = hdf5::open_dataset(file, layout::in_run_group(layout::run_token));
    const haddr_t place = H5Dget_offset(dataset);
    if (place == HADDR_UNDEF) {
        throw hdf5::Hdf5Error("its run_token is not stored");
    }
    return std::int64_t(place);
}

void write(const std::string& path, const Token& token)
{
    errno = 0;
    std::fstream stream(path, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(token.place);
    stream.write(reinterpret_cast<const char*>(&token.number), sizeof token.number);
    stream.close(); // makes the number visible to other hosts over NFS
    if (!stream) {
        throw Error(exit_code::output, "cannot open \"{}\" for writing: {}.", path,
                    system_reason(errno));
    }
}

bool holds(const std::string& path, const Token& token)
{
    std::uint64_t found = 0;
    std::ifstream stream(path, std::ios::binary);
    stream.seekg(token.place);
    stream.read(reinterpret_cast<char*>(&found), sizeof found);
    return stream && found == token.number;
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

void demand_path_for_mpi([[maybe_unused]] const std::string& path)
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
    int rank = 0;
    int ranks = 1;
    MPI_Comm_rank(communicator, &rank);
    MPI_Comm_size(communicator, &ranks);
    Token token;
    if (rank == 0) {
        try {
            std::random_device random;
            token = {random() + (std::uint64_t(random()) << 32), place_of_token(path)};
        } catch (const hdf5::Hdf5Error& error) {
            throw Error(exit_code::output, "cannot open \"{}\": {}.", path, error.what());
        }
        write(path, token);
    }
    MPI_Bcast(&token, int(sizeof token), MPI_BYTE, 0, communicator);
    const int other = holds(path, token) ? ranks : rank;
    int first = ranks;
    MPI_Reduce(&other, &first, 1, MPI_INT, MPI_MIN, 0, communicator);
    if (rank == 0) {
        write(path, {.number = 0, .place = token.place});
    }
    MPI_Bcast(&first, 1, MPI_INT, 0, communicator);
    return first < ranks ? std::optional(first) : std::nullopt;
}

SpectrumFile::SpectrumFile(const std::string& path, MPI_Comm communicator, const Problem& problem,
                           Durability durability)
    : open_(std::make_unique<Open>())
{
    open_->path = path;
    open_->durability = durability;
    open_->is_filled = problem.numerics.fill;
    if (access(path.c_str(), R_OK | W_OK) != 0) {
        // The message of MPI-IO would be "invalid access mode".
        throw Error(exit_code::output, "cannot open \"{}\" for writing: {}.", path,
                    system_reason(errno));
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
            return hdf5::open_dataset(open_->file, layout::in_run_group(name));
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
        throw Error(exit_code::output, "cannot open \"{}\" for writing: {}.", path, error.what());
    }
}

SpectrumFile::~SpectrumFile() = default;

std::vector<std::int64_t> SpectrumFile::missing_tiles()
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

void SpectrumFile::forget(const Tile& tile)
{
    try {
        for (const StoredField& stored : open_->fields) {
            write_tile(stored, tile, not_computed(stored.field, stored.part_of(tile).points()));
        }
        if (open_->is_filled) {
            open_->write_audit(tile, {});
        }
        write_number(open_->checksums, tile.number, not_computed_checksum);
    } catch (const hdf5::Hdf5Error& error) {
        throw Error(exit_code::output, "cannot clear the damaged tile {} of \"{}\": {}.",
                    tile.number, open_->path, error.what());
    }
}

void SpectrumFile::write(const Tile& tile, const TileFields& fields)
{
    assert(fields.values.size() == open_->fields.size());
    constexpr std::chrono::seconds between_looks{1};
    if (const auto now = Clock::now(); now - open_->last_seen >= between_looks) {
        open_->last_seen = now;
        open_->expect_in_place();
    }
    std::string_view dataset;
    try {
        errno = 0;
        for (std::size_t i = 0; i < open_->fields.size(); ++i) {
            dataset = name_of(open_->fields[i].field);
            write_tile(open_->fields[i], tile, fields.values[i]);
        }
        if (open_->is_filled) {
            dataset = layout::audit_checked;
            open_->write_audit(tile, fields.audit);
        }
        open_->sync_if_durable(); // a failure is that of the last dataset
        dataset = layout::checksum;
        const auto audit = open_->is_filled ? std::optional(fields.audit) : std::nullopt;
        write_number(open_->checksums, tile.number, tile_checksum(fields.values, audit));
    } catch (const hdf5::Hdf5Error& error) {
        const Error failure = open_->cannot_write(tile, dataset, error);
        open_->expect_in_place(); // throws if this is the reason
        throw failure;
    }
}

void SpectrumFile::close()
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
