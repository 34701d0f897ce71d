// The provenance of a result. Program version and commit, which determine its bits, are stored in
// the result file; what varies from run to run is stored next to it, in the sidecar OUT.h5.json.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// Such as "1.0.0".
std::string_view program_version();

/// The commit from which the program was built, with "-dirty" if the sources differed from it;
/// "unknown" if they were not in a git repository.
std::string_view program_commit();

/// The compiler of the program, such as "GCC 12.2.0".
std::string compiler_version();

/// The version of the HDF5 library in use, such as "1.10.8".
std::string hdf5_version();

/// The MPI library's name and version, such as "Open MPI v4.1.4".
std::string mpi_library();

struct RankInfo {
    std::string host;
    std::int64_t tiles = 0; ///< computed in this run
    double compute_seconds = 0;
    double write_seconds = 0;
};

/// One run, since it was started or resumed.
struct RunInfo {
    std::chrono::system_clock::time_point start;
    double wall_seconds = 0; ///< from the program's start
    std::string kernel;
    std::int64_t requests = 0;   ///< for tiles, from the other ranks to rank 0
    double dealing_seconds = 0;  ///< spent by rank 0 on the answers
    std::vector<RankInfo> ranks; ///< by rank number
};

/// Throws Error if the sidecar cannot be written, because another kind of file has its name or
/// the name is too long. To be called before the computation.
void demand_place_for_sidecar(const std::string& spectrum_path);

/// Writes the sidecar file spectrum_path + ".json", together with the compiler and the versions of
/// HDF5 and MPI. Replaces an older sidecar atomically. Throws Error.
void write_sidecar(const std::string& spectrum_path, const RunInfo& run);

} // namespace overturn
