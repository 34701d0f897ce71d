// Where a result comes from. What decides the bits (program version and commit) stands in the
// result file; what varies from run to run goes into a sidecar beside it, OUT.h5.json.
#pragma once

#include "overturn/file/file_error.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// As in "0.1.0".
std::string_view program_version();

/// The commit that the program was built from, with "-dirty" if the sources differed from it;
/// "unknown" if they were not in a git repository.
std::string_view program_commit();

/// Of the HDF5 library in use, as in "1.10.8".
std::string hdf5_version();

/// One rank's share of a run.
struct RankRecord {
    std::string host;
    std::int64_t tiles = 0; ///< computed in this run
    double compute_seconds = 0;
    double write_seconds = 0;
};

/// One run, or the part of it since it was last resumed.
struct RunRecord {
    std::chrono::system_clock::time_point start;
    double wall_seconds = 0; ///< from the program's start
    std::string kernel;
    std::int64_t requests = 0;     ///< for tiles, from the other ranks to rank 0
    double dealing_seconds = 0;    ///< that rank 0 took to answer them
    std::vector<RankRecord> ranks; ///< by rank number
};

/// Throws FileError if something else than a sidecar stands in the place of this spectrum's, or if
/// its name is too long. To be called before anything is computed.
void demand_place_for_sidecar(const std::string& spectrum_path);

/// Writes the record to spectrum_path + ".json", together with the compiler and the versions of
/// HDF5 and MPI. Replaces an older sidecar in one step. Throws FileError.
void write_sidecar(const std::string& spectrum_path, const RunRecord& record);

} // namespace overturn
