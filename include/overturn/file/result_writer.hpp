// The result file of a run, a spectrum or a boundary: HDF5 that is also valid netCDF-4, one chunk
// per tile. Rank 0 creates the whole file first, then all ranks write tiles in any order; equal
// jobs give equal bytes. The checksum of a tile is written after its values and marks the tile as
// done.
#pragma once

#include "overturn/file/stored_result.hpp"
#include "overturn/job/job.hpp"
#include "overturn/problem/job_part.hpp"
#include "overturn/sweep/compute_tile.hpp"

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace overturn {

/// Initialises HDF5; calling it again has no effect. Whatever opens a file calls it, but a program
/// that writes tiles must call it before MPI_Init: if HDF5 is initialised later, it closes its
/// files in MPI_Finalize, and crashes on a file that is incomplete because the disk was full.
void start_hdf5();

/// Upper bound of the size of the result file of the job, or of a part of it [byte]; the file is at
/// most 3 % + 32 KiB (a part: 64 KiB) smaller. In floating point, which cannot overflow here.
long double result_bytes(const Job& job, const std::optional<JobPart>& part = {});

/// Creates the file of the job, or of a part of it, with no tile computed, under a temporary name,
/// and renames it once it is synced to the disk. The fields of a part have the chunks of its tiles
/// only. To be called by one rank. Throws Error, and leaves no file behind, if the folder is
/// missing or not writable, or if there is not enough space.
void create_result(
    const std::string& path, const Job& job, const std::optional<JobPart>& part = {},
    const BetweenTiles& between_tiles = [] {});

/// Throws Error if MPI cannot open files of this absolute path.
void expect_path_for_mpi(const std::string& path);

/// The first rank on which the path names a different file than on rank 0, or nullopt; returned on
/// all ranks. Collective, before the file is opened. Rank 0 stores a random number in the file, all
/// ranks read it, and rank 0 resets it to 0. Throws Error on rank 0 if that fails.
std::optional<int> rank_with_another_file(const std::string& path, MPI_Comm communicator);

/// A result file opened for writing by all ranks of a communicator.
///
/// Opening and closing are collective. The destructor therefore does not close the file: a rank
/// that throws would wait for the others forever. A rank that does not call close() must abort all
/// ranks.
class ResultWriter {
public:
    /// The file must be one of this problem. A tile is marked as done once its values are written,
    /// so that they survive if a process is killed; if the file is to be durable, once they are
    /// synced to the disk, so that they also survive a power failure. Throws Error.
    ResultWriter(const std::string& path, MPI_Comm communicator, const Problem& problem,
                 bool durable = false);
    ~ResultWriter();

    /// Numbers of the tiles that are not computed yet, ascending. Not collective.
    std::vector<std::int64_t> missing_tiles();

    /// Resets a damaged tile to "not computed", its values first. To be called by one rank.
    void reset(const Tile& tile);

    /// Stores a tile, its checksum last. Not collective.
    void write(const Tile& tile, const TileFields& fields);

    /// Collective. Returns when everything is written, or synced to the disk.
    void close();

private:
    struct Open;
    std::unique_ptr<Open> open_;
};

} // namespace overturn
