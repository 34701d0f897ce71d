#include "overturn/file/spectrum_file.hpp"

#include "hdf5_handles.hpp"
#include "layout.hpp"
#include "operating_system.hpp"
#include "tile_access.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cerrno>
#include <chrono>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

namespace overturn {

using hdf5::check;
using hdf5::Handle;

void start_hdf5()
{
    hdf5::start();
}

struct SpectrumFile::Open {
    std::string path;
    std::vector<Field> fields;
    Handle file;
    std::vector<Handle> datasets; ///< in the order of `fields`
    Handle checksums;
    Durability durability;
    struct stat as_opened = {};
    std::chrono::steady_clock::time_point last_seen;

    /// If a loss of power matters.
    void bring_to_disk() const;
    /// That the name still stands for the file that was opened, with all its bytes: writing into
    /// one that was removed or cut fails nowhere.
    void expect_in_place();
    void expect_in_place_now_and_then();
    FileError cannot_write(const Tile& tile, std::string_view dataset,
                           const hdf5::Hdf5Error& error) const;
};

FileError SpectrumFile::Open::cannot_write(const Tile& tile, std::string_view dataset,
                                           const hdf5::Hdf5Error& error) const
{
    // MPI-IO keeps the reason of a failed write to itself: what the system said last is the best
    // guess, and a full disk cannot be hidden.
    int reason = errno;
    struct statvfs disk = {};
    if (statvfs(path.c_str(), &disk) == 0 && disk.f_bavail == 0) {
        reason = ENOSPC;
    }
    return FileError(
        fmt::format("cannot write tile {} of \"{}\": {}. {} the same command again to resume.",
                    tile.number, dataset, reason != 0 ? system_reason(reason) : error.what(),
                    reason == ENOSPC || reason == EDQUOT ? "Free some and run" : "Run"));
}

void SpectrumFile::Open::expect_in_place()
{
    struct stat found = {};
    const bool is_found = stat(path.c_str(), &found) == 0;
    if (!is_found && errno != ENOENT) {
        return; // no news: writing tells what is wrong
    }
    if (!is_found || found.st_dev != as_opened.st_dev || found.st_ino != as_opened.st_ino) {
        throw FileError(
            fmt::format("\"{}\" was removed, moved or replaced while it was written. If "
                        "it was moved, move it back and run the same command again to "
                        "resume.",
                        path));
    }
    if (found.st_size < as_opened.st_size) {
        throw FileError(fmt::format("\"{}\" was cut from {} to {} bytes while it was written. "
                                    "Remove it, and compute it again.",
                                    path, as_opened.st_size, found.st_size));
    }
}

void SpectrumFile::Open::expect_in_place_now_and_then()
{
    constexpr std::chrono::seconds interval{1};
    const auto now = std::chrono::steady_clock::now();
    if (now - last_seen >= interval) {
        last_seen = now;
        expect_in_place();
    }
}

void SpectrumFile::Open::bring_to_disk() const
{
    // MPI-IO has handed each write to the system when it returns; its own sync would want all ranks
    // at once.
    if (durability == Durability::on_disk && !sync(path)) {
        throw hdf5::Hdf5Error("the disk did not take it");
    }
}

namespace {

/// Each write is handed to the system before it returns: a rank alone needs no MPI-IO for that,
/// which would make and remove files of its own beside this one.
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

SpectrumFile::SpectrumFile(const std::string& path, MPI_Comm communicator, const Job& job,
                           Durability durability)
    : open_(std::make_unique<Open>())
{
    open_->path = path;
    open_->durability = durability;
    open_->fields = job.fields;
    if (access(path.c_str(), R_OK | W_OK) != 0) {
        // MPI-IO would say "invalid access mode".
        throw FileError(
            fmt::format("cannot open \"{}\" for writing: {}.", path, system_reason(errno)));
    }
    try {
        hdf5::start();
        open_->file =
            Handle(H5Fopen(path.c_str(), H5F_ACC_RDWR, unbuffered_access(communicator)), H5Fclose);
        for (const Field field : job.fields) {
            open_->datasets.push_back(hdf5::open_dataset(open_->file, name_of(field)));
        }
        open_->checksums = hdf5::open_dataset(open_->file, layout::checksum);
        if (stat(path.c_str(), &open_->as_opened) != 0) {
            throw hdf5::Hdf5Error(system_reason(errno));
        }
    } catch (const hdf5::Hdf5Error& error) {
        open_->file.release();
        throw FileError(fmt::format("cannot open \"{}\" for writing: {}.", path, error.what()));
    }
}

SpectrumFile::~SpectrumFile()
{
    open_->file.release();
}

std::vector<std::int64_t> SpectrumFile::missing_tiles()
{
    try {
        std::vector<std::int64_t> missing;
        const std::vector<std::uint64_t> checksums = read_checksums(open_->checksums);
        for (std::size_t tile = 0; tile < checksums.size(); ++tile) {
            if (checksums[tile] == not_computed_checksum) {
                missing.push_back(std::int64_t(tile));
            }
        }
        return missing;
    } catch (const hdf5::Hdf5Error& error) {
        throw FileError(fmt::format("cannot read which tiles of \"{}\" are missing: {}.",
                                    open_->path, error.what()));
    }
}

void SpectrumFile::forget(const Tile& tile)
{
    try {
        for (std::size_t i = 0; i < open_->fields.size(); ++i) {
            const Field field = open_->fields[i];
            write_tile(open_->datasets[i], tile, field, not_computed(field, tile.points()));
        }
        write_checksum(open_->checksums, tile.number, not_computed_checksum);
    } catch (const hdf5::Hdf5Error& error) {
        throw FileError(fmt::format("cannot clear the damaged tile {} of \"{}\": {}.", tile.number,
                                    open_->path, error.what()));
    }
}

void SpectrumFile::write(const Tile& tile, const TileFields& fields)
{
    assert(fields.values.size() == open_->fields.size());
    open_->expect_in_place_now_and_then();
    std::string_view dataset;
    try {
        errno = 0;
        for (std::size_t i = 0; i < open_->fields.size(); ++i) {
            dataset = name_of(open_->fields[i]);
            write_tile(open_->datasets[i], tile, open_->fields[i], fields.values[i]);
        }
        open_->bring_to_disk();
        dataset = layout::checksum;
        write_checksum(open_->checksums, tile.number, tile_checksum(fields.values));
    } catch (const hdf5::Hdf5Error& error) {
        const FileError failure = open_->cannot_write(tile, dataset, error);
        open_->expect_in_place(); // which would be the reason
        throw failure;
    }
}

void SpectrumFile::close()
{
    open_->expect_in_place();
    try {
        open_->datasets.clear();
        open_->checksums.close();
        check(H5Fflush(open_->file, H5F_SCOPE_GLOBAL));
        open_->file.close();
        open_->bring_to_disk();
    } catch (const hdf5::Hdf5Error& error) {
        throw FileError(
            fmt::format("cannot bring all of \"{}\" to the disk: {}. What it holds cannot "
                        "be trusted: remove it and compute it again.",
                        open_->path, error.what()));
    }
}

} // namespace overturn
