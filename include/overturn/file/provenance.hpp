// The provenance of a result. Program version and commit, which determine its bits, are stored in
// the result file; what varies from run to run is stored next to it, see text_outputs.hpp.
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

} // namespace overturn
