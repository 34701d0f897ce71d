// The result file of a run, a spectrum or a boundary: HDF5 that is also valid netCDF-4, one chunk
// per tile. Rank 0 makes the whole file first, then all ranks write tiles into it, in any order;
// equal jobs give equal bytes.
// A tile's checksum is written after its values: it marks the tile as done.
#pragma once

#include "overturn/file/file_error.hpp"
#include "overturn/job/job.hpp"
#include "overturn/sweep/sweep_tile.hpp"

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace overturn {

/// To be called before MPI_Init. HDF5 started later closes its files when MPI ends, and crashes on
/// one that a full disk has left half made.
void start_hdf5();

/// What stands at the output path before a run.
enum class Existing { nothing, unfinished, complete };

/// Whether the job can start, resume or has ended already. Throws FileError if something stands at
/// the path that this program, with this job and tiling, must not touch. Serial.
Existing examine(const std::string& path, const Job& job, const Tiling& tiling);

/// Size of the job's result file [byte], rounded up: the file itself is at most 3 % + 32 KiB
/// smaller. In floating point, which cannot overflow here.
long double spectrum_file_bytes(const Job& job, const Tiling& tiling);

/// Called between tiles; what it throws ends the work on all of them.
using BetweenTiles = std::function<void()>;

/// Makes the file of which no tile is computed yet, under a name of its own, and renames it into
/// place when it is safe on the disk. For one rank alone. Throws FileError, and leaves nothing
/// behind, if the folder is missing or not writable, or if the file does not fit.
void create_spectrum_file(
    const std::string& path, const Job& job, const Tiling& tiling,
    const BetweenTiles& between_tiles = [] {});

/// Throws FileError if MPI would not open the file of this absolute path.
void demand_path_for_mpi(const std::string& path);

/// The first rank for which the path names another file than for rank 0, or none; the same on all
/// ranks. Collective, before the file is opened. Rank 0 stores a random number in the file, which
/// all ranks read, and then 0 as before. Throws FileError on rank 0 if it cannot.
std::optional<int> rank_with_another_file(const std::string& path, MPI_Comm communicator);

/// When a tile counts as done: once its values are in the file, which outlasts the death of any
/// process; or once they are on the disk, which outlasts a loss of power as well.
enum class Durability { written, on_disk };

/// The file while it is written, opened by all ranks of a communicator.
///
/// Opening and closing are collective. For that reason the destructor does not close: a rank that
/// unwinds alone would wait for the others forever. Who leaves without close() ends all ranks.
class SpectrumFile {
public:
    /// The file must have been examined or created for the same job. Throws FileError.
    SpectrumFile(const std::string& path, MPI_Comm communicator, const Job& job,
                 Durability durability = Durability::written);
    ~SpectrumFile();
    SpectrumFile(const SpectrumFile&) = delete;
    SpectrumFile& operator=(const SpectrumFile&) = delete;

    /// Numbers of the tiles that are not computed yet, ascending. For any rank.
    std::vector<std::int64_t> missing_tiles();

    /// Makes a damaged tile one that is not computed, its values first. For one rank.
    void forget(const Tile& tile);

    /// Stores a tile, its checksum last. Each rank at its own time.
    void write(const Tile& tile, const TileFields& fields);

    /// Collective. Returns when everything is in the file, or on the disk.
    void close();

private:
    struct Open;
    std::unique_ptr<Open> open_;
};

} // namespace overturn
