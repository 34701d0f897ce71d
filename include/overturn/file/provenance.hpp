// The provenance of a result. Program version and commit, which determine its bits, are stored in
// the result file; what varies from run to run is stored next to it, in the sidecar OUT.h5.json.
#pragma once

#include <string>
#include <string_view>

namespace overturn {

/// Such as "3.0.0".
std::string_view program_version();

/// The commit from which the program was built, with "-dirty" if the sources differed from it;
/// "unknown" if they were not in a git repository.
std::string_view program_commit();

/// The compiler of the program, such as "GCC 12.2.0".
std::string compiler_version();

/// The version of the HDF5 library in use, such as "1.10.8".
std::string hdf5_version();

/// What the MPI library says of itself; the second: its name and version, "Open MPI v4.1.4".
std::string mpi_version();
std::string mpi_library();

/// The beginning of every sidecar, which tells it from other files called OUT.h5.json.
inline constexpr std::string_view sidecar_beginning = "{\n  \"program_version\": ";

/// Throws Error if the sidecar cannot be written, because another kind of file has its name or
/// the name is too long. To be called before the computation.
void expect_place_for_sidecar(const std::string& spectrum_path);

/// Whether a file that is replaced is the old or the new one after a power failure, too. Syncing
/// may wait for what other programs have written.
enum class Syncing { no, yes };

/// Writes the sidecar file spectrum_path + ".json". Replaces an older one atomically. Throws Error.
void write_sidecar(const std::string& spectrum_path, std::string_view text,
                   Syncing syncing = Syncing::yes);

} // namespace overturn
